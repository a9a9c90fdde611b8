#include "scenes/flat_normals.h"

namespace umbrameter {

dvec3 area_vector(const Mesh& mesh, const uvec3& triangle) {
  const dvec3 a(mesh.positions[triangle.x]);
  return glm::cross(dvec3(mesh.positions[triangle.y]) - a, dvec3(mesh.positions[triangle.z]) - a);
}

Mesh with_flat_normals(const Mesh& mesh) {
  Mesh flat;
  flat.name = mesh.name;
  flat.material = mesh.material;
  for (const uvec3& triangle : mesh.triangles) {
    const dvec3 area = area_vector(mesh, triangle);
    const vec3 normal = area == dvec3(0.0) ? vec3(0, 1, 0) : vec3(glm::normalize(area));
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    for (int corner = 0; corner < 3; ++corner) {
      flat.positions.push_back(mesh.positions[triangle[corner]]);
      flat.normals.push_back(normal);
      if (!mesh.texcoords.empty()) flat.texcoords.push_back(mesh.texcoords[triangle[corner]]);
    }
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  return flat;
}

}  // namespace umbrameter
