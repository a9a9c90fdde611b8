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
  add_camera(scene, "overview", looking(dvec3(5.6, 3.4, 6.2), dvec3(1.35, 0.95, 1.1)), 36.0);
  add_camera(scene, "close", looking(dvec3(1.5, 1.2, 1.7), dvec3(0, 0.15, 0)), 40.0);
  // From behind the wall at x = 0: its shadow falls on the floor and on the other wall, and starts in the edges.
  add_sun(scene, "sun", dvec3(2, 1.5, 2), dvec3(-0.55, 0.95, 0.65), 8.0, 10.0);
  add_sun(scene, "sun-open", dvec3(2, 1.5, 2), dvec3(0.6, 0.8, 0.9), 8.0, 10.0);
  Light lamp;
  lamp.name = "lamp";
  lamp.world_from_light = looking(dvec3(1.4, 1.6, 1.2), dvec3(0.0));
  lamp.color = vec3(1.0f, 0.88f, 0.7f);
  lamp.intensity = 18.0;
  lamp.shape = PointLight{};
  scene.lights.push_back(lamp);
  return scene;
}

}  // namespace umbrameter::builtin
