#include "scenes/material.h"

#include <gtest/gtest.h>

#include <limits>

namespace umbrameter {
namespace {

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

void expect_near(const vec3& found, const vec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-6f) << i;
}

TEST(SurfaceMaterial, A_dielectric_reflects_four_percent_times_its_specular_factors) {
  Material material;
  material.base_color = {0.5f, 0.25f, 0.125f, 1.0f};
  material.roughness = 0.75f;
  const SurfaceMaterial plain = surface_material_at(Scene{}, material, vec2(0));
  expect_near(plain.base_color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(plain.metallic, 0.0f);
  EXPECT_EQ(plain.roughness, 0.75f);
  expect_near(plain.specular, vec3(0.04f));
  material.specular = 0.5f;
  material.specular_color = {1.0f, 2.0f, 0.25f};
  expect_near(surface_material_at(Scene{}, material, vec2(0)).specular, vec3(0.02f, 0.04f, 0.005f));
}

TEST(SurfaceMaterial, Metal_reflects_its_base_color_and_a_mix_lies_between) {
  Material material;
  material.base_color = {0.5f, 0.25f, 1.0f, 1.0f};
  material.metallic = 1.0f;
  expect_near(surface_material_at(Scene{}, material, vec2(0)).specular, vec3(0.5f, 0.25f, 1.0f));
  material.metallic = 0.25f;  // 0.75 · 0.04 + 0.25 · base colour
  expect_near(surface_material_at(Scene{}, material, vec2(0)).specular, vec3(0.155f, 0.0925f, 0.28f));
}

TEST(SurfaceMaterial, Factors_out_of_bounds_reflect_no_more_than_all_light) {
  Material material;
  material.base_color = {3.0f, 0.5f, 0.5f, 1.0f};
  material.specular_color = vec3(40.0f, 25.0f, 5.0f);  // times 0.04: 1.6, 1, 0.2
  const SurfaceMaterial surface = surface_material_at(Scene{}, material, vec2(0));
  expect_near(surface.base_color, vec3(1.0f, 0.5f, 0.5f));
  expect_near(surface.specular, vec3(1.0f, 1.0f, 0.2f));
}

TEST(SurfaceMaterial, Textures_multiply_the_factors_and_only_colours_are_decoded) {
  Scene scene = textured(Wrap::clamp_to_edge);
  scene.textures[0].texels = Image<glm::u8vec4>(1, 1, glm::u8vec4(255, 51, 102, 204));  // 1, 0.2, 0.4, 0.8
  Material material;
  material.metallic = 0.5f;
  material.roughness = 0.75f;
  material.metallic_roughness_texture = 0;
  const SurfaceMaterial metal = surface_material_at(scene, material, vec2(0));
  EXPECT_NEAR(metal.roughness, 0.75f * 0.2f, 1e-6f);
  EXPECT_NEAR(metal.metallic, 0.5f * 0.4f, 1e-6f);
  expect_near(metal.specular, vec3(0.8f * 0.04f + 0.2f));
  material = Material();
  material.specular = 0.5f;
  material.specular_texture = 0;
  expect_near(surface_material_at(scene, material, vec2(0)).specular, vec3(0.04f * 0.5f * 0.8f));
  // IEC 61966-2-1: ((0.2 + 0.055) / 1.055)^2.4 = 0.0331048, ((0.4 + 0.055) / 1.055)^2.4 = 0.1328683.
  material.specular_color_texture = 0;
  expect_near(surface_material_at(scene, material, vec2(0)).specular, 0.016f * vec3(1.0f, 0.0331048f, 0.1328683f));
}

}  // namespace
}  // namespace umbrameter
