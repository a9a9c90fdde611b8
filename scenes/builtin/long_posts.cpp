#include <array>
#include <cmath>
#include <string>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// Four rows of posts along a straight road that runs away from the viewer, towards −z. A row has one thickness.
constexpr double spacing = 5.0;
constexpr int posts_in_row = 32;  // the last stands 155 m from the first
constexpr double post_height = 4.0;
constexpr double first_post = 0.0;
struct Row {
  int millimetres;  // across
  double x;
};
constexpr std::array<Row, 4> rows{{{200, -3.0}, {100, 3.0}, {50, 5.6}, {20, -5.6}}};
constexpr double road_half_width = 2.4;
constexpr double near_end = 14.0;
constexpr double far_end = -175.0;
constexpr double half_ground = 40.0;

// A shaft with a base and a small head, all of one width, so that the thickness is that of its name all the way up.
Shape post(double radius) {
  const std::array<dvec2, 4> shaft{dvec2(0, -0.05), dvec2(radius, -0.05), dvec2(radius, post_height),
                                   dvec2(0, post_height)};
  return lathe(shaft, 20);
}

}  // namespace

Scene make_long_posts() {
  Scene scene;
  scene.name = "long-posts";
  const std::uint32_t grass = add_material(scene, "dry grass", vec3(0.30f, 0.29f, 0.16f));
  const std::uint32_t sand = add_material(scene, "sand", vec3(0.58f, 0.51f, 0.40f));
  const std::uint32_t stone = add_material(scene, "kerb stone", vec3(0.50f, 0.48f, 0.43f));
  const std::array<std::uint32_t, 4> paints{add_material(scene, "ivory paint", vec3(0.70f, 0.66f, 0.58f)),
                                            add_material(scene, "red paint", vec3(0.50f, 0.13f, 0.08f)),
                                            add_material(scene, "weathered wood", vec3(0.23f, 0.17f, 0.12f)),
                                            add_material(scene, "blued steel", vec3(0.07f, 0.085f, 0.10f))};

  place_once(scene,
             to_mesh("ground", box(dvec3(-half_ground, -0.5, far_end), dvec3(half_ground, 0.0, near_end)), grass));
  place_once(
      scene,
      to_mesh("road", box(dvec3(-road_half_width, -0.2, far_end + 0.5), dvec3(road_half_width, 0.02, near_end - 0.01)),
              sand));
  const std::uint32_t kerb = add_mesh(
      scene, to_mesh("kerb", chamfered_box(dvec3(-0.1, -0.2, -2.49), dvec3(0.1, 0.12, 2.49), 0.015), stone, 20.0));
  for (int i = 0; i < 37; ++i) {
    for (const double side : {-1.0, 1.0}) {
      place(scene, kerb, "kerb", moved(dvec3(side * road_half_width, 0, near_end - 3.0 - spacing * i)));
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string name = "post " + std::to_string(rows[r].millimetres) + " mm";
    const std::uint32_t mesh = add_mesh(scene, to_mesh(name, post(0.0005 * rows[r].millimetres), paints[r]));
    for (int i = 0; i < posts_in_row; ++i) {
      place(scene, mesh, name + " at " + std::to_string(std::lround(spacing * i)) + " m",
            moved(dvec3(rows[r].x, 0, first_post - spacing * i)));
    }
  }

  add_camera(scene, "overview", looking(dvec3(0.9, 2.6, 8.6), dvec3(-0.3, 1.05, -8.0)), 42.0);
  add_camera(scene, "near", looking(dvec3(1.2, 1.6, 5.0), dvec3(-1.2, 0.1, -0.8)), 42.0);
  add_camera(scene, "far", looking(dvec3(0.6, 5.5, -70.0), dvec3(-0.3, 0.0, -100.0)), 24.0);
  // 16 degrees high, ahead and to the left: shadows 14 m long come towards the viewer across the road.
  const double e = degrees(16.0);
  const auto from = [&](double azimuth) {
    return dvec3(std::sin(degrees(azimuth)) * std::cos(e), std::sin(e), -std::cos(degrees(azimuth)) * std::cos(e));
  };
  add_sun(scene, "sun", dvec3(0, 0, -80), from(-38.0), 60.0, 3.0);
  add_sun(scene, "sun-behind", dvec3(0, 0, -80), from(-152.0), 60.0, 0.5);
  return scene;
}

}  // namespace umbrameter::builtin
