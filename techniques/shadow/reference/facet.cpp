#include "techniques/shadow/reference/facet.h"

#include <algorithm>
#include <cmath>

#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

constexpr double half_ulp = 0x1p-24;

double signed_distance(const Facet& f, const dvec3& point) { return dot_of(f.normal, point - f.a); }

}  // namespace

Facet facet_of(const Scene& scene, const MapLayout& layout, std::uint32_t instance, std::uint32_t triangle) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const uvec3 v = mesh.triangles[triangle];
  const vec3 a = mesh.positions[v.x];
  const vec3 b = mesh.positions[v.y];
  const vec3 c = mesh.positions[v.z];
  const dmat4& world_from_mesh = placed.world_from_mesh;
  dmat4 light_from_mesh(0.0);
  for (int column = 0; column < 3; ++column) {
    light_from_mesh[column] = dvec4(transform_vector(layout.light_from_world, dvec3(world_from_mesh[column])), 0.0);
  }
  light_from_mesh[3] = dvec4(transform_point(layout.light_from_world, dvec3(world_from_mesh[3])), 1.0);
  Facet f;
  f.a = transform_point(light_from_mesh, dvec3(a));
  f.ab = transform_vector(light_from_mesh, dvec3(b) - dvec3(a));
  f.ac = transform_vector(light_from_mesh, dvec3(c) - dvec3(a));
  const dvec3 n = cross_of(f.ab, f.ac);
  const double area = length_of(n);
  f.normal = area > 0.0 ? n / area : dvec3(0.0);
  const bool is_turned = layout.kind == MapKind::orthographic ? f.normal.z < 0.0 : dot_of(f.normal, f.a) > 0.0;
  if (is_turned) f.normal = -f.normal;
  const dvec3 largest(glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
  dvec3 reach;
  for (int row = 0; row < 3; ++row) {
    const dvec3 x(world_from_mesh[0][row], world_from_mesh[1][row], world_from_mesh[2][row]);
    reach[row] = dot_of(glm::abs(x), largest) + std::abs(world_from_mesh[3][row]);
  }
  f.vertex_error = half_ulp * length_of(reach);
  return f;
}

dvec3 foot_on(const Facet& facet, const dvec3& position) {
  return position - facet.normal * signed_distance(facet, position);
}

dvec3 sample_on(const Facet& f, const TexelRay& ray) {
  const dvec3 p = cross_of(ray.direction, f.ac);
  const double determinant = dot_of(f.ab, p);
  const dvec3 q = cross_of(ray.origin - f.a, f.ab);
  dvec2 weight = std::abs(determinant) > 0.0
                     ? dvec2(dot_of(ray.origin - f.a, p), dot_of(ray.direction, q)) / determinant
                     : dvec2(1.0 / 3.0);
  weight = glm::max(weight, 0.0);
  weight /= std::max(1.0, weight.x + weight.y);
  return f.a + weight.x * f.ab + weight.y * f.ac;
}

}  // namespace umbrameter
