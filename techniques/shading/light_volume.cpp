#include "techniques/shading/light_volume.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scenes/light.h"

namespace umbrameter {
namespace {

// An icosahedron divided twice has 320 triangles. Its vertices lie 1.8 % outside the enclosed sphere.
constexpr int sphere_divisions = 2;
constexpr int cone_sides = 24;
constexpr double max_cone_mesh_angle = pi / 3;

struct Shape {
  std::vector<dvec3> positions;
  std::vector<uvec3> triangles;
};

Shape icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  Shape shape;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      shape.positions.emplace_back(a, b, 0.0);
      shape.positions.emplace_back(0.0, a, b);
      shape.positions.emplace_back(b, 0.0, a);
    }
  }
  // Three vertices that are pairwise one edge (of length 2) apart are a face.
  const auto near = [&](std::size_t i, std::size_t j) {
    return glm::length(shape.positions[i] - shape.positions[j]) < 2.1;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (near(i, j) && near(j, k) && near(i, k)) shape.triangles.emplace_back(i, j, k);
      }
    }
  }
  return shape;
}

Shape divided(const Shape& shape) {
  Shape fine{shape.positions, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(fine.positions.size()));
    if (is_new) fine.positions.push_back(glm::normalize(fine.positions[i] + fine.positions[j]));
    return entry->second;
  };
  for (const uvec3& t : shape.triangles) {
    const std::uint32_t a = middle(t.x, t.y);
    const std::uint32_t b = middle(t.y, t.z);
    const std::uint32_t c = middle(t.z, t.x);
    fine.triangles.insert(fine.triangles.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
  }
  return fine;
}

// The faces nearest to the origin touch the unit sphere from outside; the others lie beyond it.
Shape enclosing_sphere() {
  Shape shape = icosahedron();
  for (dvec3& position : shape.positions) position = glm::normalize(position);
  for (int i = 0; i < sphere_divisions; ++i) shape = divided(shape);
  double nearest = 1.0;
  for (const uvec3& t : shape.triangles) {
    const dvec3& a = shape.positions[t.x];
    const dvec3 normal = glm::normalize(glm::cross(shape.positions[t.y] - a, shape.positions[t.z] - a));
    nearest = std::min(nearest, std::abs(glm::dot(normal, a)));
  }
  for (dvec3& position : shape.positions) position /= nearest;
  return shape;
}

// A pyramid with its tip at the origin and its base at z = −1. The base encloses the cone's circle and touches it at
// the midpoints of its edges.
Shape enclosing_cone(double angle) {
  Shape shape;
  const double radius = std::tan(angle) / std::cos(pi / cone_sides);
  shape.positions = {dvec3(0.0), dvec3(0.0, 0.0, -1.0)};
  for (int i = 0; i < cone_sides; ++i) {
    const double turn = 2.0 * pi * i / cone_sides;
    shape.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), -1.0);
  }
  for (std::uint32_t i = 0; i < cone_sides; ++i) {
    const std::uint32_t next = (i + 1) % cone_sides;
    shape.triangles.emplace_back(0, 2 + i, 2 + next);
    shape.triangles.emplace_back(1, 2 + next, 2 + i);
  }
  return shape;
}

}  // namespace

std::optional<LightVolume> light_volume(const Light& light) {
  const auto* spot = std::get_if<SpotLight>(&light.shape);
  const auto* point = std::get_if<PointLight>(&light.shape);
  const double range = spot != nullptr ? spot->range : point != nullptr ? point->range : 0.0;
  if (!(range > 0.0)) return std::nullopt;
  const bool is_cone = spot != nullptr && spot->outer_cone_angle <= max_cone_mesh_angle;
  const Shape shape = is_cone ? enclosing_cone(spot->outer_cone_angle) : enclosing_sphere();
  LightVolume volume;
  dvec3 inside(0.0);
  // Larger by more than the rounding to floats, so that the mesh still encloses the range.
  const double size = range * (1.0 + 1e-5);
  for (const dvec3& p : shape.positions) {
    const dvec3 world = light.position() + axes_of(light) * (size * p);
    volume.positions.emplace_back(world);
    inside += dvec3(volume.positions.back()) / static_cast<double>(shape.positions.size());
  }
  for (uvec3 t : shape.triangles) {
    const dvec3 a(volume.positions[t.x]);
    const dvec3 normal = glm::cross(dvec3(volume.positions[t.y]) - a, dvec3(volume.positions[t.z]) - a);
    if (glm::dot(normal, a - inside) < 0.0) std::swap(t.y, t.z);
    volume.triangles.push_back(t);
  }
  return volume;
}

}  // namespace umbrameter
