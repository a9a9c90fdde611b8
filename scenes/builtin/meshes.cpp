#include <algorithm>
#include <cmath>

#include "scenes/builtin/shapes.h"

namespace umbrameter::builtin {
namespace {

// Twice the area times the unit normal.
dvec3 face_vector(const std::vector<dvec3>& points, const uvec3& face) {
  return glm::cross(points[face.y] - points[face.x], points[face.z] - points[face.x]);
}

}  // namespace

Mesh to_mesh(const std::string& name, const Shape& shape, std::uint32_t material, double crease,
             const std::function<vec2(const dvec3&)>& texcoord) {
  Mesh mesh;
  mesh.name = name;
  mesh.material = material;
  std::vector<std::vector<std::uint32_t>> faces_at(shape.points.size());
  std::vector<dvec3> vectors;
  for (const uvec3& face : shape.faces) {
    const auto index = static_cast<std::uint32_t>(vectors.size());
    vectors.push_back(face_vector(shape.points, face));
    for (int corner = 0; corner < 3; ++corner) faces_at[face[corner]].push_back(index);
  }
  const double limit = std::cos(crease * pi / 180.0);
  std::vector<std::vector<std::uint32_t>> vertices_at(shape.points.size());
  for (std::uint32_t index = 0; index < shape.faces.size(); ++index) {
    uvec3 triangle;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t point = shape.faces[index][corner];
      dvec3 sum(0.0);
      for (const std::uint32_t other : faces_at[point]) {
        const double bend = glm::dot(glm::normalize(vectors[index]), glm::normalize(vectors[other]));
        if (bend >= limit) sum += vectors[other];
      }
      const vec3 normal = glm::normalize(vec3(glm::normalize(sum)));
      auto& candidates = vertices_at[point];
      const auto same = std::ranges::find_if(
          candidates, [&](std::uint32_t vertex) { return glm::dot(mesh.normals[vertex], normal) > 0.999999f; });
      if (same != candidates.end()) {
        triangle[corner] = *same;
        continue;
      }
      triangle[corner] = static_cast<std::uint32_t>(mesh.positions.size());
      candidates.push_back(triangle[corner]);
      mesh.positions.emplace_back(shape.points[point]);
      mesh.normals.push_back(normal);
      if (texcoord) mesh.texcoords.push_back(texcoord(shape.points[point]));
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace umbrameter::builtin
