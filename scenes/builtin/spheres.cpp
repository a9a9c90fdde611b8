#include <array>
#include <cmath>
#include <map>
#include <string>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// An icosahedron, each of whose edges is cut into `frequency` pieces, blown up to the sphere: 20·frequency² facets of
// nearly one size and shape.
Shape geodesic_sphere(double radius, int frequency) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  const std::array<dvec3, 12> corners{{{-1, golden, 0},
                                       {1, golden, 0},
                                       {-1, -golden, 0},
                                       {1, -golden, 0},
                                       {0, -1, golden},
                                       {0, 1, golden},
                                       {0, -1, -golden},
                                       {0, 1, -golden},
                                       {golden, 0, -1},
                                       {golden, 0, 1},
                                       {-golden, 0, -1},
                                       {-golden, 0, 1}}};
  constexpr std::array<std::array<std::uint32_t, 3>, 20> sides{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  Shape shape;
  // A point is known by how many parts it has of which corners, so that sides meet in the same points.
  std::map<std::array<std::uint32_t, 12>, std::uint32_t> known;
  const auto n = static_cast<std::uint32_t>(frequency);
  for (const auto& side : sides) {
    const auto id = [&](std::uint32_t i, std::uint32_t j) {
      std::array<std::uint32_t, 12> parts{};
      parts[side[0]] = n - i - j;
      parts[side[1]] = i;
      parts[side[2]] = j;
      const auto [found, is_new] = known.emplace(parts, static_cast<std::uint32_t>(shape.points.size()));
      if (is_new) {
        dvec3 sum(0.0);
        for (std::size_t k = 0; k < corners.size(); ++k) sum += static_cast<double>(parts[k]) * corners[k];
        shape.points.push_back(radius * glm::normalize(sum));
      }
      return found->second;
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; i + j < n; ++j) {
        shape.faces.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
        if (i + j + 1 < n) shape.faces.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
  }
  return shape;
}

// Radii double from ball to ball; the facets grow far less.
struct Ball {
  int millimetres;
  int frequency;
};
constexpr std::array<Ball, 10> series{
    {{1024, 40}, {512, 32}, {256, 24}, {128, 20}, {64, 16}, {32, 16}, {16, 12}, {8, 12}, {4, 12}, {2, 12}}};
// The same ball from ever more facets, all with smooth shading normals.
constexpr std::array<int, 4> coarse_frequencies{2, 4, 8, 16};
constexpr double coarse_radius = 0.2;
constexpr double bowl_radius = 0.4;

Shape bowl() {
  constexpr double thickness = 0.03;
  constexpr double outer = bowl_radius + thickness;
  constexpr int pieces = 40;
  std::vector<dvec2> profile{{0.0, -outer}};
  for (int i = 1; i <= pieces; ++i) {
    const double angle = 0.5 * pi * i / pieces;
    profile.emplace_back(outer * std::sin(angle), -outer * std::cos(angle));
  }
  for (int i = pieces; i >= 1; --i) {
    const double angle = 0.5 * pi * i / pieces;
    profile.emplace_back(bowl_radius * std::sin(angle), -bowl_radius * std::cos(angle));
  }
  profile.emplace_back(0.0, -bowl_radius);
  return lathe(profile, 128);
}

}  // namespace

Scene make_spheres() {
  Scene scene;
  scene.name = "spheres";
  const std::uint32_t ground = add_material(scene, "ground", vec3(0.50f, 0.47f, 0.42f));
  const std::uint32_t ivory = add_material(scene, "ivory plaster", vec3(0.68f, 0.63f, 0.54f));
  const std::uint32_t slate = add_material(scene, "blue slate", vec3(0.16f, 0.23f, 0.30f));
  const std::uint32_t clay = add_material(scene, "terracotta", vec3(0.56f, 0.25f, 0.14f));
  const std::uint32_t ochre = add_material(scene, "ochre", vec3(0.60f, 0.42f, 0.16f));
  place_once(scene, to_mesh("ground", box(dvec3(-7.0, -0.3, -6.0), dvec3(7.0, 0.0, 5.0)), ground));

  // On a spiral towards the viewer, each a little off the one before; the shadow of each falls on the next larger one.
  const std::array<std::uint32_t, 3> paints{ivory, slate, clay};
  dvec3 at(-1.1, 0.0, -0.9);
  double heading = 8.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double radius = 0.001 * series[i].millimetres;
    if (i > 0) {
      const double before = 2.0 * radius;
      // Balls on one floor touch at a distance of 2√(r·R) along it.
      const double way = 2.0 * std::sqrt(radius * before) + 0.3 * radius;
      at += way * dvec3(std::cos(degrees(heading)), 0.0, std::sin(degrees(heading)));
      heading += 10.0;
    }
    place_once(scene,
               to_mesh("ball " + std::to_string(series[i].millimetres) + " mm",
                       geodesic_sphere(radius, series[i].frequency), paints[i % paints.size()], 180.0),
               moved(at + dvec3(0, radius, 0)));
  }
  for (std::size_t i = 0; i < coarse_frequencies.size(); ++i) {
    const int frequency = coarse_frequencies[i];
    place_once(
        scene,
        to_mesh("ball " + std::to_string(20 * frequency * frequency) + " facets",
                geodesic_sphere(coarse_radius, frequency), ochre, 180.0),
        moved(dvec3(-1.55 + 0.55 * static_cast<double>(i), coarse_radius, 0.95 + 0.08 * static_cast<double>(i))));
  }
  const dvec3 hollow(1.75, bowl_radius + 0.03, -1.35);
  place_once(scene, to_mesh("bowl", bowl(), ivory, 40.0), moved(hollow));

  add_camera(scene, "overview", looking(dvec3(1.75, 1.02, 3.0), dvec3(-0.12, 0.6, -0.6)), 45.0);
  add_camera(scene, "small", looking(at + dvec3(0.075, 0.075, 0.17), at + dvec3(-0.045, 0.024, -0.01)), 34.0);
  add_camera(scene, "facets", looking(dvec3(0.1, 0.85, 2.95), dvec3(-0.7, 0.19, 1.06)), 32.0);
  add_camera(scene, "bowl", looking(hollow + dvec3(0.45, 0.85, 1.25), hollow + dvec3(-0.06, -0.1, 0)), 34.0);
  add_sun(scene, "sun", dvec3(-0.3, 0.0, 0.0), dvec3(1.0, 0.8, 0.28), 10.0, 3.0);
  add_lamp(scene, "lamp", dvec3(-2.2, 2.1, 2.2), 0.8);
  return scene;
}

}  // namespace umbrameter::builtin
