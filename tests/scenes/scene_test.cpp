#include "scenes/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

namespace umbrameter {
namespace {

Scene two_triangles() {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  scene.objects.resize(2);
  scene.instances.push_back({0, 0, dmat4(1.0)});
  scene.instances.push_back({0, 1, glm::translate(dmat4(1.0), dvec3(10, 20, 30))});
  return scene;
}

TEST(SceneCount, Instances_share_what_is_stored_once) {
  const SceneCounts counts = count(two_triangles());
  EXPECT_EQ(counts.triangles, 2u);
  EXPECT_EQ(counts.stored_triangles, 1u);
  EXPECT_EQ(counts.vertices, 3u);
}

TEST(SceneBounds, Bounds_reach_over_all_instances) {
  const Bounds bounds = bounds_of(two_triangles());
  EXPECT_EQ(bounds.min, dvec3(0, 0, 0));
  EXPECT_EQ(bounds.max, dvec3(11, 21, 30));
}

TEST(SceneBounds, A_scene_without_triangles_has_empty_bounds) { EXPECT_TRUE(bounds_of(Scene{}).empty()); }

TEST(WorldTriangle, Corners_are_transformed_in_double_precision) {
  Scene scene = two_triangles();
  // 1e8 + 1 has no float.
  scene.instances[1].world_from_mesh = glm::translate(dmat4(1.0), dvec3(1e8, 0, 0));
  const Triangle triangle = world_triangle(scene, 1, 0);
  EXPECT_EQ(triangle.b, dvec3(100000001.0, 0, 0));
  EXPECT_EQ(triangle.c, dvec3(1e8, 1, 0));
}

TEST(Mirroring, An_odd_number_of_negative_scales_mirrors) {
  EXPECT_FALSE(is_mirrored(dmat4(1.0)));
  EXPECT_TRUE(is_mirrored(glm::scale(dmat4(1.0), dvec3(-1, 2, 3))));
  EXPECT_FALSE(is_mirrored(glm::scale(dmat4(1.0), dvec3(-1, -2, 3))));
}

// Uniform in [−1, 1].
double draw(std::mt19937& random) { return static_cast<double>(random()) / 2147483647.5 - 1.0; }

dvec3 draw_vector(std::mt19937& random) {
  const double x = draw(random);
  const double y = draw(random);
  return {x, y, draw(random)};
}

dmat3 draw_rotation(std::mt19937& random) {
  const dvec3 x = glm::normalize(draw_vector(random));
  const dvec3 y = glm::normalize(glm::cross(x, draw_vector(random)));
  return {x, y, glm::cross(x, y)};
}

TEST(LargestStretch, It_is_the_largest_singular_value_to_within_a_millionth_from_above) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    // M = U diag(s) Vᵀ, with values that are far apart, close together, zero or mirrored.
    const double size = std::pow(10.0, 6.0 * draw(random));
    dvec3 s = size * draw_vector(random);
    if (i % 4 == 1) s.y = s.x;
    if (i % 4 == 2) s = dvec3(s.x, s.x * (1.0 + 1e-9 * draw(random)), 0.0);
    if (i % 4 == 3) s.z = 1e-8 * s.x;
    const dmat3 u = draw_rotation(random);
    const dmat3 v = draw_rotation(random);
    const dmat3 m = u * dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z) * glm::transpose(v);
    const double largest = std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)});
    const double bound = largest_stretch(dmat4(m));
    // The product above is itself rounded, by a few units of 1e-16.
    EXPECT_GE(bound, largest * (1.0 - 4e-15));
    EXPECT_LE(bound, largest * (1.0 + 1e-6));
  }
}

TEST(LargestStretch, No_edge_is_stretched_by_more) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    dmat4 transform(1.0);
    for (int column = 0; column < 4; ++column) transform[column] = dvec4(draw_vector(random), column == 3 ? 1.0 : 0.0);
    if (i % 3 == 0) transform[1] *= 1e-3;
    const double bound = largest_stretch(transform);
    double longest = 0.0;
    for (int k = 0; k < 500; ++k) {
      const dvec3 edge = draw_vector(random);
      const double stretched = glm::length(dmat3(transform) * edge);
      EXPECT_LE(stretched, bound * glm::length(edge));
      longest = std::max(longest, stretched / glm::length(edge));
    }
    // Of 500 random directions one is near the worst.
    EXPECT_GT(longest, 0.9 * bound);
  }
}

TEST(LargestStretch, Known_transforms) {
  EXPECT_NEAR(largest_stretch(glm::translate(dmat4(1.0), dvec3(1e6, 2, 3))), 1.0, 2e-7);
  EXPECT_NEAR(largest_stretch(glm::scale(dmat4(1.0), dvec3(-3, 2, 1))), 3.0, 6e-7);
  // A shear by one: the singular values are the golden ratio and its inverse.
  dmat4 shear(1.0);
  shear[1][0] = 1.0;
  EXPECT_NEAR(largest_stretch(shear), 1.6180339887498949, 1e-6);
  EXPECT_EQ(largest_stretch(dmat4(0.0)), 0.0);
  EXPECT_NEAR(largest_stretch(glm::scale(dmat4(1.0), dvec3(1e200))) / 1e200, 1.0, 2e-7);
  EXPECT_NEAR(largest_stretch(glm::scale(dmat4(1.0), dvec3(1e-200, 0, 0))) / 1e-200, 1.0, 2e-7);
}

TEST(Bounds, They_are_those_of_every_vertex_to_the_last_bit) {
  std::mt19937 random(13);
  Scene scene = two_triangles();
  scene.instances.clear();
  scene.meshes.resize(3, scene.meshes[0]);
  for (Mesh& mesh : scene.meshes) {
    mesh.positions.clear();
    for (int i = 0; i < 30; ++i) mesh.positions.emplace_back(draw_vector(random) + dvec3(0.3));
  }
  Bounds expected;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    dmat4 world_from_mesh(draw_rotation(random));
    // Most lie in the middle, a few each at the border, where nothing may be left out.
    world_from_mesh[3] = dvec4((i % 50 == 0 ? 3.0 : 1.0) * draw_vector(random), 1.0);
    scene.instances.push_back({i % 3, 0, world_from_mesh});
    for (const vec3& position : scene.meshes[i % 3].positions) {
      expected.include(dvec3(world_from_mesh * dvec4(dvec3(position), 1.0)));
    }
    const Bounds found = i % 100 == 0 ? bounds_of(scene) : expected;
    ASSERT_EQ(found.min, expected.min);
    ASSERT_EQ(found.max, expected.max);
  }
  EXPECT_EQ(bounds_of(scene).min, expected.min);
  EXPECT_EQ(bounds_of(scene).max, expected.max);
}

TEST(Bounds, A_step_over_the_border_by_one_unit_in_the_last_place_counts) {
  Scene scene = two_triangles();
  scene.instances[1].world_from_mesh = dmat4(1.0);
  const double least = std::nextafter(0.0, 1.0);
  const double beyond = std::nextafter(1.0, 2.0) - 1.0;
  scene.instances[1].world_from_mesh[3] = dvec4(beyond, -least, 0, 1);
  EXPECT_EQ(bounds_of(scene).max.x, 1.0 + beyond);
  EXPECT_EQ(bounds_of(scene).min.y, -least);
}

}  // namespace
}  // namespace umbrameter
