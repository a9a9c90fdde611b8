#include <array>
#include <cmath>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

struct Sheets {
  const char* name;
  double thickness;
  double x;
};
constexpr std::array<Sheets, 2> kinds{{{"1 cm", 0.01, -1.5}, {"1 mm", 0.001, 1.5}}};

// A unit cube about the origin, brought to a size.
dmat4 sized(const dvec3& center, const dvec3& size) { return moved(center) * scaled(size); }

}  // namespace

Scene make_thin_leaf() {
  Scene scene;
  scene.name = "thin-leaf";
  const std::uint32_t ground = add_material(scene, "ground", vec3(0.55f, 0.52f, 0.47f));
  const std::uint32_t green = add_material(scene, "leaf", vec3(0.20f, 0.36f, 0.12f));
  place_once(scene, to_mesh("ground", box(dvec3(-3.6, -0.3, -2.6), dvec3(3.6, 0.0, 2.6)), ground));
  const std::uint32_t cube = add_mesh(scene, to_mesh("leaf", box(dvec3(-0.5), dvec3(0.5)), green));
  for (const Sheets& kind : kinds) {
    const std::string suffix = std::string(" ") + kind.name;
    const double t = kind.thickness;
    // Lying: the underside 2 cm and 30 cm above the ground. Standing: rooted in the ground, so that no light passes.
    place(scene, cube, "lying low" + suffix, sized(dvec3(kind.x, 0.02 + 0.5 * t, 1.1), dvec3(1.4, t, 0.8)));
    place(scene, cube, "lying high" + suffix, sized(dvec3(kind.x, 0.3 + 0.5 * t, -0.2), dvec3(1.4, t, 0.8)));
    place(scene, cube, "standing" + suffix, sized(dvec3(kind.x, 0.3, -1.5), dvec3(1.6, 0.8, t)));
    place(scene, cube, "edge-on" + suffix, sized(dvec3(kind.x + 1.15, 0.3, 0.3), dvec3(t, 0.8, 1.4)));
  }
  add_camera(scene, "overview", looking(dvec3(-2.4, 2.7, 5.6), dvec3(0.1, 0.05, -0.25)), 38.0);
  add_camera(scene, "behind", looking(dvec3(-3.0, 1.0, -3.6), dvec3(-1.1, 0.15, -1.2)), 40.0);
  add_camera(scene, "low", looking(dvec3(-3.4, 0.45, 2.6), dvec3(-1.3, 0.12, 0.6)), 40.0);
  // 40° high, square to the standing sheets.
  add_sun(scene, "sun", dvec3(0.0), dvec3(0.0, std::sin(degrees(40)), std::cos(degrees(40))), 8.0, 3.0);
  add_sun(scene, "sun-slanting", dvec3(0.0), dvec3(-0.7, 0.9, 0.55), 8.0, 3.0);
  scene.lights.push_back({"lamp", looking(dvec3(-0.3, 1.9, 1.0), dvec3(-0.3, 0, 0.9)), vec3(1.0f), 8.0, PointLight{}});
  return scene;
}

}  // namespace umbrameter::builtin
