#include "scenes/flat_normals.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

TEST(FlatNormals, Every_triangle_has_vertices_of_its_own_with_its_normal) {
  // Two triangles that share an edge: one on the floor, one upright.
  Mesh mesh;
  mesh.name = "fold";
  mesh.material = 3;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}};
  mesh.texcoords = {{0, 0}, {0, 1}, {1, 0}, {0.5f, 0.5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Mesh flat = with_flat_normals(mesh);
  EXPECT_EQ(flat.name, "fold");
  EXPECT_EQ(flat.material, 3u);
  ASSERT_EQ(flat.triangles.size(), 2u);
  ASSERT_EQ(flat.positions.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = flat.triangles[t][corner];
      EXPECT_EQ(flat.positions[vertex], mesh.positions[mesh.triangles[t][corner]]);
      EXPECT_EQ(flat.texcoords[vertex], mesh.texcoords[mesh.triangles[t][corner]]);
      EXPECT_EQ(flat.normals[vertex], t == 0 ? vec3(0, 1, 0) : vec3(0, 0, 1));
    }
  }
}

TEST(FlatNormals, A_triangle_without_area_gets_a_unit_normal) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 1}};
  const Mesh flat = with_flat_normals(mesh);
  EXPECT_TRUE(flat.texcoords.empty());
  for (const vec3& normal : flat.normals) EXPECT_EQ(glm::length(normal), 1.0f);
}

}  // namespace
}  // namespace umbrameter
