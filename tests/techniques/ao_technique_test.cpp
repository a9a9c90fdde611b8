#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "techniques/ao/kernel.h"
#include "techniques/ao/technique.h"

namespace umbrameter {
namespace {

TEST(AoKernel, Points_fill_the_upper_unit_hemisphere_and_thin_out_from_the_centre) {
  const std::vector<vec4> kernel = hemisphere_kernel({}, 1024, 7);
  ASSERT_EQ(kernel.size(), 1024u);
  double mean_z = 0.0;
  for (const vec4& point : kernel) {
    EXPECT_GE(point.z, 0.0f);
    EXPECT_LE(glm::length(vec3(point)), 1.0f);
    mean_z += static_cast<double>(point.z) / std::max(1e-9, static_cast<double>(glm::length(vec3(point)))) / 1024;
  }
  EXPECT_NEAR(mean_z, 0.5, 0.03);  // uniform directions: the mean of z over a hemisphere is 1/2
  EXPECT_EQ(kernel, hemisphere_kernel({}, 1024, 7));
  EXPECT_NE(kernel, hemisphere_kernel({}, 1024, 8));
}

TEST(AoKernel, A_progressive_kernel_begins_with_every_smaller_one) {
  const AoKernelParams params{AoKernel::progressive};
  const std::vector<vec4> all = hemisphere_kernel(params, 1024, 7);
  for (const int samples : {1, 16, 100}) {
    const std::vector<vec4> first = hemisphere_kernel(params, samples, 7);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), all.begin())) << samples;
  }
  EXPECT_NE(all, hemisphere_kernel(params, 1024, 8));
  // Directions and distances are distributed as in Learn OpenGL: the mean distance is E[u](0.1 + 0.9 E[v²]) = 0.2.
  double mean_z = 0.0;
  double mean_length = 0.0;
  double random_length = 0.0;
  const std::vector<vec4> random = hemisphere_kernel({}, 1024, 7);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double length = glm::length(dvec3(all[i]));
    EXPECT_GE(all[i].z, 0.0f);
    EXPECT_LE(length, 1.0);
    mean_z += static_cast<double>(all[i].z) / std::max(1e-9, length) / 1024;
    mean_length += length / 1024;
    random_length += glm::length(dvec3(random[i])) / 1024;
  }
  EXPECT_NEAR(mean_z, 0.5, 0.006);  // as accurate as 1024 × 27 random directions
  EXPECT_NEAR(mean_length, 0.2, 0.002);
  EXPECT_NEAR(random_length, 0.2, 0.02);
}

TEST(AoNoise, The_tile_has_a_rotation_for_each_of_its_pixels_and_follows_from_the_seed) {
  const std::vector<vec4> tile = rotation_tile({.size = 64}, 7);
  ASSERT_EQ(tile.size(), 4096u);
  double mean_x = 0.0;
  for (const vec4& rotation : tile) {
    EXPECT_LE(std::max(std::abs(rotation.x), std::abs(rotation.y)), 1.0f);
    EXPECT_EQ(vec2(rotation.z, rotation.w), vec2(0.0f));
    mean_x += static_cast<double>(rotation.x) / 4096;
  }
  EXPECT_NEAR(mean_x, 0.0, 0.03);  // uniform on [-1, 1]: the mean of 4096 deviates by 1/sqrt(3 * 4096) = 0.009
  EXPECT_EQ(tile, rotation_tile({.size = 64}, 7));
  EXPECT_NE(tile, rotation_tile({.size = 64}, 8));
}

TEST(AoBlur, A_box_is_centred_and_an_even_one_extends_further_to_the_left_and_up) {
  struct Case {
    AoBlurParams params;
    int first;
    int count;
  };
  for (const Case& expected : {Case{{AoBlur::box, 5}, -2, 5}, Case{{AoBlur::box, 4}, -2, 4},
                               Case{{AoBlur::box, 1}, 0, 1}, Case{{AoBlur::none, 5}, 0, 1}}) {
    const AoBlurTaps taps = taps_of(expected.params);
    EXPECT_EQ(taps.first, expected.first) << expected.params.size;
    EXPECT_EQ(taps.count, expected.count) << expected.params.size;
  }
}

TEST(AoBlur, Each_technique_has_its_own_blur_unless_another_is_asked_for) {
  const std::pair<AoTechniques::Choice, AoBlur> expected[] = {
      {AoTechniques::choice<Ssao>, AoBlur::box},         {AoTechniques::choice<Gtao>, AoBlur::xegtao},
      {AoTechniques::choice<Hbao>, AoBlur::bilateral},   {AoTechniques::choice<Alchemy>, AoBlur::bilateral},
      {AoTechniques::choice<Crytek>, AoBlur::bilateral}, {AoTechniques::choice<Bitmask>, AoBlur::xegtao},
      {AoTechniques::choice<Marched>, AoBlur::none},
  };
  for (const auto& [technique, own] : expected) {
    AoParams params;
    params.technique = technique;
    params.blur.size = 7;
    EXPECT_EQ(blur_of(params).kind, own);
    EXPECT_EQ(blur_of(params).size, 7);
    params.blur.kind = AoBlur::gaussian;
    EXPECT_EQ(blur_of(params).kind, AoBlur::gaussian);
  }
}

// A technique that reads a parameter that ao.* lacks could not be set; one that differs from it would ignore a flag.
TEST(AoTechnique, Every_technique_holds_the_values_of_the_parameters_that_it_reads) {
  for (std::size_t name = 0; name < std::variant_size_v<AoTechnique>; ++name) {
    AoParams params;
    params.technique = static_cast<AoTechniques::Choice>(name);
    const Parameters all = describe(params);
    require(all, "ao.samples").set_text("9");
    require(all, "ao.radius").set_text("0.75");
    require(all, "ao.bias").set_text("0.125");
    require(all, "ao.noise-size").set_text("5");
    require(all, "ao.range-check").set_text("false");
    AoTechnique technique = make_technique(params);
    EXPECT_EQ(technique.index(), name);
    EXPECT_FALSE(title_of(technique).empty());
    std::set<std::string> keys;
    for (const Parameter& parameter : describe(technique)) {
      EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key << " twice";
      EXPECT_EQ(parameter.value(), require(all, parameter.key).value()) << parameter.key;
    }
    EXPECT_TRUE(keys.contains("ao.radius"));
  }
}

TEST(AoTone, Intensity_comes_before_power_and_ones_change_no_bit) {
  EXPECT_EQ(with_tone(0.3f, {1.0, 1.0}), 0.3f);
  EXPECT_EQ(with_tone(1.0f, {0.7, 3.0}), 1.0f);
  EXPECT_FLOAT_EQ(with_tone(0.8f, {2.0, 1.0}), 0.6f);
  EXPECT_FLOAT_EQ(with_tone(0.8f, {2.0, 2.0}), 0.36f);
  EXPECT_EQ(with_tone(0.3f, {2.0, 0.5}), 0.0f);
}

TEST(AoTone, Further_bounces_brighten_all_but_black_surfaces_and_come_before_the_intensity) {
  for (const float ao : {0.0f, 0.1f, 0.5f, 0.9f, 1.0f}) {
    // A black surface reflects nothing; the fit is within its rounding of that.
    EXPECT_NEAR(with_bounces(ao, 0.0), ao, 1e-5f);
    float before = ao;
    for (const double albedo : {0.1, 0.5, 0.9, 1.0}) {
      const float bright = with_bounces(ao, albedo);
      EXPECT_GE(bright, before) << albedo;
      EXPECT_LE(bright, 1.0f);
      before = bright;
    }
  }
  // By hand: albedo 0.5 gives a = 0.6878, b = −1.75585, c = 2.0679; at 0.5: ((0.3439 − 1.75585)·0.5 + 2.0679)·0.5.
  EXPECT_NEAR(with_bounces(0.5f, 0.5), 0.6809625f, 1e-6f);
  EXPECT_EQ(with_bounces(0.0f, 0.9), 0.0f);
  EXPECT_NEAR(with_tone(0.5f, {2.0, 1.0, true, 0.5}), 1.0f - 2.0f * (1.0f - 0.6809625f), 1e-6f);
}

TEST(AoTone, Further_bounces_have_the_diffuse_albedo_of_the_surface_on_request) {
  AoToneParams params{.albedo = 0.5};
  const vec3 color(0.2f, 0.4f, 0.6f);
  EXPECT_EQ(at_surface(params, color, 0.25f).albedo, 0.5);
  params.albedo_source = AoAlbedo::surface;
  EXPECT_EQ(at_surface(params, color, 0.25f).albedo, 0.5) << "without further bounces";
  params.multi_bounce = true;
  // Luminance 0.2126 · 0.2 + 0.7152 · 0.4 + 0.0722 · 0.6; a metal reflects three quarters of it diffusely.
  EXPECT_NEAR(at_surface(params, color, 0.25f).albedo, 0.75 * 0.37192, 1e-7);
  EXPECT_EQ(at_surface(params, color, 1.0f).albedo, 0.0);
}

TEST(AoTechnique, Lengths_become_metres_of_the_scenes_size) {
  AoParams params;  // 2 % and 0.1 %
  params = in_metres(params, 50.0);
  EXPECT_EQ(params.sampling.radius, Length{1.0});
  EXPECT_EQ(params.bias.depth, Length{0.05});
}

}  // namespace
}  // namespace umbrameter
