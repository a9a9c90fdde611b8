#include <array>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

struct Gap {
  const char* name;
  double metres;
};
constexpr std::array<Gap, 9> gaps{{{"gap 0", 0.0},
                                   {"gap 1 mm", 0.001},
                                   {"gap 2 mm", 0.002},
                                   {"gap 5 mm", 0.005},
                                   {"gap 1 cm", 0.01},
                                   {"gap 2 cm", 0.02},
                                   {"gap 5 cm", 0.05},
                                   {"gap 10 cm", 0.1},
                                   {"gap 20 cm", 0.2}}};

}  // namespace

Scene make_contact_box() {
  Scene scene;
  scene.name = "contact-box";
  const std::uint32_t ground = add_material(scene, "ground", vec3(0.55f, 0.52f, 0.47f));
  const std::uint32_t paint = add_material(scene, "paint", vec3(0.62f, 0.24f, 0.13f));
  place_once(scene, to_mesh("ground", box(dvec3(-4.2, -0.3, -2.6), dvec3(4.2, 0.0, 2.6)), ground));
  const std::uint32_t cube = add_mesh(scene, to_mesh("box", box(dvec3(-0.3, 0, -0.3), dvec3(0.3, 0.6, 0.3)), paint));
  // Five behind, four in front between them.
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const bool behind = i < 5;
    const double x = behind ? -2.8 + 1.4 * static_cast<double>(i) : -2.1 + 1.4 * static_cast<double>(i - 5);
    place(scene, cube, gaps[i].name, moved(dvec3(x, gaps[i].metres, behind ? -0.9 : 0.7)));
  }
  add_camera(scene, "overview", looking(dvec3(1.3, 2.9, 6.1), dvec3(0.12, 0.12, 0.05)), 35.0);
  add_camera(scene, "front-row", looking(dvec3(0.9, 0.55, 3.5), dvec3(0.15, 0.3, 0.6)), 38.0);
  add_camera(scene, "back-row", looking(dvec3(-4.0, 1.15, 1.2), dvec3(-1.3, 0.2, -0.9)), 45.0);
  // 45° high; along the diagonal, so that shadows leave from two sides of each box.
  add_sun(scene, "sun", dvec3(0.0), dvec3(-0.8, 1.0, 0.6), 8.0, 3.0);
  add_sun(scene, "sun-across", dvec3(0.0), dvec3(-1.0, 1.0, 0.0), 8.0, 3.0);
  add_sun(scene, "sun-low", dvec3(0.0), dvec3(-2.4, 1.0, 1.8), 8.0, 3.0);
  return scene;
}

}  // namespace umbrameter::builtin
