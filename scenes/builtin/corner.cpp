#include <array>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {

Scene make_corner() {
  Scene scene;
  scene.name = "corner";
  const std::uint32_t plaster = add_material(scene, "plaster", vec3(0.62f, 0.58f, 0.52f));
  // One solid: floor and two walls, 30 cm thick, that meet at the origin.
  constexpr double side = 4.0;
  constexpr double thick = 0.3;
  const std::array<Bounds, 3> slabs{Bounds{dvec3(-thick, -thick, -thick), dvec3(side, 0.0, side)},
                                    Bounds{dvec3(-thick, -thick, -thick), dvec3(0.0, 3.0, side)},
                                    Bounds{dvec3(-thick, -thick, -thick), dvec3(side, 3.0, 0.0)}};
  place_once(scene, to_mesh("corner", carved(slabs), plaster));
  // Plain solids, sunk a little where they would lie face on face.
  const std::uint32_t clay = add_material(scene, "clay", vec3(0.56f, 0.25f, 0.15f));
  const std::uint32_t blue = add_material(scene, "blue", vec3(0.13f, 0.24f, 0.36f));
  const std::uint32_t ochre = add_material(scene, "ochre", vec3(0.62f, 0.42f, 0.14f));
  place_once(scene, to_mesh("block", box(dvec3(-0.45, -0.005, -0.35), dvec3(0.45, 1.0, 0.35)), clay),
             moved(dvec3(0.95, 0, 1.0)) * turned(28));
  place_once(scene, to_mesh("ball", sphere(0.45, 64), blue), moved(dvec3(2.15, 0.45, 0.95)));
  const std::array<dvec2, 5> pin{dvec2(0, -0.005), dvec2(0.3, -0.005), dvec2(0.3, 0.05), dvec2(0.02, 1.25),
                                 dvec2(0, 1.25)};
  place_once(scene, to_mesh("cone", lathe(pin, 64), ochre), moved(dvec3(1.0, 0, 2.35)));
  // Its ends reach into both walls.
  const std::array<dvec3, 2> rod{dvec3(-0.05, 1.9, 1.5), dvec3(1.5, 1.9, -0.05)};
  place_once(scene, to_mesh("rod", tube(rod, std::array{0.03, 0.03}, 24), ochre));

  add_camera(scene, "overview", looking(dvec3(6.4, 3.6, 6.6), dvec3(1.6, 1.05, 1.5)), 36.0);
  add_camera(scene, "close", looking(dvec3(3.3, 1.3, 3.6), dvec3(0.9, 0.5, 0.9)), 40.0);
  add_sun(scene, "sun", dvec3(2, 1.5, 2), dvec3(1.0, 0.85, 0.25), 8.0, 3.0);
  scene.lights.push_back(
      {"lamp", looking(dvec3(2.0, 2.3, 2.2), dvec3(0.0)), vec3(1.0f, 0.88f, 0.7f), 10.0, PointLight{}});
  scene.lights.push_back({"spot", looking(dvec3(3.6, 3.4, 3.2), dvec3(1.1, 0.4, 1.0)), vec3(1.0f, 0.95f, 0.85f), 45.0,
                          SpotLight{0.0, degrees(18), degrees(26)}});
  // From behind the wall at x = 0: its shadow falls on the floor and on the other wall, and starts in the edges.
  add_sun(scene, "sun-behind", dvec3(2, 1.5, 2), dvec3(-0.55, 0.95, 0.65), 8.0, 3.0);
  return scene;
}

}  // namespace umbrameter::builtin
