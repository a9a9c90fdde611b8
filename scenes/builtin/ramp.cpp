#include <array>
#include <cmath>
#include <string>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// Slopes of 0, 5, … 85 degrees in two rows of nine, the steeper ones on a terrace behind. Each rises away from the
// viewer by the same way along its own surface.
constexpr int slopes = 18;
constexpr int columns = 9;
constexpr double step_degrees = 5.0;
constexpr double slope_length = 1.5;
constexpr double width = 0.52;
constexpr double pitch = 0.60;
constexpr double lip = 0.05;  // height of the front edge above what the ramp stands on
constexpr double terrace = 0.9;
constexpr double terrace_front = -1.85;
constexpr double peg_length = 0.2;
constexpr double peg_radius = 0.016;

// In the ramp's own frame x runs across, the front edge is z = 0 and the ground y = 0.
Shape wedge(double angle) {
  const double run = slope_length * std::cos(degrees(angle));
  const double rise = slope_length * std::sin(degrees(angle));
  constexpr double sunk = 0.006;
  const std::array<dvec2, 2> foot{dvec2(0.0, -sunk), dvec2(run, -sunk)};
  const std::array<dvec2, 2> surface{dvec2(0.0, lip), dvec2(run, lip + rise)};
  Shape shape;
  // band() draws along x and extrudes along z; here the way up is −z.
  append(shape, band(foot, surface, width), moved(dvec3(-0.5 * width, 0, 0)) * turned(90.0));
  return shape;
}

}  // namespace

Scene make_ramp() {
  Scene scene;
  scene.name = "ramp";
  const std::uint32_t stone = add_material(scene, "limestone", vec3(0.46f, 0.43f, 0.37f));
  const std::uint32_t slate = add_material(scene, "slate", vec3(0.20f, 0.205f, 0.20f));
  const std::uint32_t ivory = add_material(scene, "ivory plaster", vec3(0.66f, 0.62f, 0.54f));
  const std::uint32_t clay = add_material(scene, "terracotta", vec3(0.55f, 0.25f, 0.14f));
  const std::uint32_t steel = add_material(scene, "blued steel", vec3(0.07f, 0.085f, 0.10f));

  constexpr double half = 0.5 * columns * pitch + 0.12;
  place_once(scene, to_mesh("ground", box(dvec3(-4.6, -0.3, -5.2), dvec3(4.6, 0.0, 2.6)), slate));
  place_once(scene, to_mesh("terrace",
                            chamfered_box(dvec3(-half, -0.02, terrace_front - slope_length - 0.25),
                                          dvec3(half, terrace, terrace_front + 0.22), 0.015),
                            stone, 20.0));

  const std::array<dvec2, 5> pin{dvec2(0, -0.01), dvec2(peg_radius, -0.01), dvec2(peg_radius, peg_length - 0.004),
                                 dvec2(peg_radius - 0.004, peg_length), dvec2(0, peg_length)};
  const std::uint32_t peg = add_mesh(scene, to_mesh("peg", lathe(pin, 24), steel));
  for (int i = 0; i < slopes; ++i) {
    const double angle = step_degrees * i;
    const std::string number = std::to_string(static_cast<int>(angle));
    const bool is_behind = i >= columns;
    const dmat4 at = moved(
        dvec3(pitch * (i % columns - 0.5 * (columns - 1)), is_behind ? terrace : 0.0, is_behind ? terrace_front : 0.0));
    place_once(scene, to_mesh("slope " + number, wedge(angle), i % 3 == 0 ? clay : ivory), at);
    // Square to the surface, at a third and two thirds of it.
    for (const double share : {1.0 / 3.0, 2.0 / 3.0}) {
      const double along = share * slope_length;
      place(scene, peg, "peg " + number,
            at * moved(dvec3(0, lip + along * std::sin(degrees(angle)), -along * std::cos(degrees(angle)))) *
                turned(angle, dvec3(1, 0, 0)));
    }
  }

  add_camera(scene, "overview", looking(dvec3(-1.9, 3.5, 5.6), dvec3(0.0, 0.78, -1.0)), 32.0);
  add_camera(scene, "steep", looking(dvec3(-0.4, 2.5, 1.2), dvec3(1.1, 1.5, -1.9)), 42.0);
  add_camera(scene, "gentle", looking(dvec3(-2.6, 1.5, 2.3), dvec3(-0.7, 0.2, -0.5)), 40.0);
  // Straight down: the angle between light and normal is the slope itself.
  add_sun(scene, "zenith", dvec3(0.0, 0.0, -1.2), dvec3(0, 1, 0), 8.0, 3.0, dvec3(0, 0, -1));
  add_sun(scene, "sun", dvec3(0.0, 0.0, -1.2), dvec3(-0.85, 0.9, 0.75), 8.0, 0.7);
  return scene;
}

}  // namespace umbrameter::builtin
