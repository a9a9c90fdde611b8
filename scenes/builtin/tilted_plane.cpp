#include <array>
#include <cmath>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

constexpr double half_side = 10.0;

Mesh plane(std::uint32_t material) {
  Mesh mesh;
  mesh.name = "plane";
  mesh.material = material;
  for (const auto& [x, z] : {std::pair{-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}}) {
    mesh.positions.emplace_back(half_side * x, 0.0, half_side * z);
    mesh.normals.emplace_back(0, 1, 0);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// The light stands `tilt` degrees from the plane's normal, towards +x. The map's own y axis lies `azimuth` degrees
// from the direction in which the plane slopes away from the light.
void add_tilted_sun(Scene& scene, const std::string& name, double tilt, double azimuth) {
  const double angle = degrees(tilt);
  const dvec3 to_light{std::sin(angle), std::cos(angle), 0.0};
  const dvec3 slope{-std::cos(angle), std::sin(angle), 0.0};
  const dvec3 across{0.0, 0.0, 1.0};
  const dvec3 up = std::cos(degrees(azimuth)) * slope + std::sin(degrees(azimuth)) * across;
  add_sun(scene, name, dvec3(0.0), to_light, 20.0, 3.0, up);
}

}  // namespace

Scene make_tilted_plane() {
  Scene scene;
  scene.name = "tilted-plane";
  place_once(scene, plane(add_material(scene, "plaster", vec3(0.6f, 0.57f, 0.52f))));

  // The cameras are turned about the vertical, so that pixel rows and texel rows do not fall in step.
  constexpr double turn = 17.0;
  const dvec3 up{std::sin(degrees(turn)), 0.0, -std::cos(degrees(turn))};
  Camera top;
  top.name = "top";
  top.world_from_camera = looking(dvec3(0, 10, 0), dvec3(0.0), up);
  top.projection = OrthographicProjection{7.0, 4.0, 0.1, 20.0};
  scene.cameras.push_back(top);
  add_camera(scene, "perspective", looking(dvec3(0, 10, 0), dvec3(0.0), up), 43.0);

  struct Tilt {
    const char* name;
    double tilt, azimuth;
  };
  constexpr std::array<Tilt, 7> suns{{{"sun-60", 60, 0},
                                      {"sun-30", 30, 0},
                                      {"sun-75", 75, 0},
                                      {"sun-60-azimuth-45", 60, 45},
                                      {"sun-60-azimuth-20", 60, 20},
                                      {"sun-0", 0, 0},
                                      {"sun-85", 85, 0}}};
  for (const Tilt& sun : suns) {
    add_tilted_sun(scene, sun.name, sun.tilt, sun.azimuth);
  }
  return scene;
}

}  // namespace umbrameter::builtin
