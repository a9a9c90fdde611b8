#include "scenes/scene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

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

// 2×1 texels, left black and clear, right white and solid.
Scene textured(Wrap wrap) {
  Scene scene;
  Texture texture;
  texture.texels = Image<glm::u8vec4>(2, 1);
  texture.texels[1] = {255, 255, 255, 255};
  texture.wrap_u = wrap;
  texture.wrap_v = wrap;
  scene.textures.push_back(texture);
  Material material;
  material.base_color = {0.5f, 1.0f, 1.0f, 0.5f};
  material.base_color_texture = 0;
  scene.materials.push_back(material);
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

TEST(Alpha, Without_a_texture_it_is_the_factor) {
  Material material;
  material.base_color.w = 0.25f;
  EXPECT_EQ(alpha_at(Scene{}, material, {0.3f, 0.4f}), 0.25f);
}

TEST(Alpha, It_is_the_texel_at_its_centre_and_linear_between) {
  const Scene scene = textured(Wrap::clamp_to_edge);
  const Material& material = scene.materials[0];
  EXPECT_FLOAT_EQ(alpha_at(scene, material, {0.25f, 0.5f}), 0.0f);
  EXPECT_FLOAT_EQ(alpha_at(scene, material, {0.75f, 0.5f}), 0.5f);
  // A quarter of the way between the centres at 0.25 and 0.75, times the factor 0.5.
  EXPECT_FLOAT_EQ(alpha_at(scene, material, {0.375f, 0.5f}), 0.125f);
}

TEST(Alpha, Wrapping_decides_what_lies_beyond_the_edge) {
  const auto alpha = [](Wrap wrap, float u) {
    const Scene scene = textured(wrap);
    return alpha_at(scene, scene.materials[0], {u, 0.5f});
  };
  EXPECT_FLOAT_EQ(alpha(Wrap::clamp_to_edge, 1.25f), 0.5f);
  EXPECT_FLOAT_EQ(alpha(Wrap::repeat, 1.25f), 0.0f);
  EXPECT_FLOAT_EQ(alpha(Wrap::mirrored_repeat, 1.25f), 0.5f);
  EXPECT_FLOAT_EQ(alpha(Wrap::mirrored_repeat, 1.75f), 0.0f);
  EXPECT_FLOAT_EQ(alpha(Wrap::repeat, -0.25f), 0.5f);
  EXPECT_FLOAT_EQ(alpha(Wrap::mirrored_repeat, -0.25f), 0.0f);
  EXPECT_FLOAT_EQ(alpha(Wrap::clamp_to_edge, -7.0f), 0.0f);
  // Half way between the last texel and the first of the next repetition.
  EXPECT_FLOAT_EQ(alpha(Wrap::repeat, 1.0f), 0.25f);
}

TEST(Alpha, Coordinates_that_are_no_numbers_do_not_crash) {
  const Scene scene = textured(Wrap::repeat);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()}) {
    const float alpha = alpha_at(scene, scene.materials[0], {bad, bad});
    EXPECT_GE(alpha, 0.0f);
    EXPECT_LE(alpha, 0.5f);
  }
}

TEST(BaseColor, It_is_filtered_after_decoding_srgb) {
  Scene scene = textured(Wrap::clamp_to_edge);
  const vec4 middle = base_color_at(scene, scene.materials[0], {0.5f, 0.5f});
  EXPECT_FLOAT_EQ(middle.x, 0.25f);
  EXPECT_FLOAT_EQ(middle.y, 0.5f);
  EXPECT_FLOAT_EQ(middle.w, 0.25f);
  // IEC 61966-2-1: ((188/255 + 0.055) / 1.055)^2.4 = 0.502886.
  scene.textures[0].texels[1] = {188, 188, 188, 255};
  EXPECT_NEAR(base_color_at(scene, scene.materials[0], {0.75f, 0.5f}).y, 0.502886, 1e-5);
}

}  // namespace
}  // namespace umbrameter
