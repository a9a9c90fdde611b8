// The depth per texel of planes whose slope and azimuth are known.
#include "compare/bias_facts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrameter {
namespace {

constexpr double degrees = pi / 180.0;

// Texels of 0.1 m, light along −z.
MapLayout orthographic_layout() {
  MapLayout layout;
  layout.resolution = 200;
  layout.views[0].half_extent = 10.0;
  layout.light_from_world[3] = {0.0, 0.0, -50.0, 1.0};
  layout.far_depth = 100.0;
  return layout;
}

// The normal of a plane θ from the light, which slopes in a direction ψ from the map's x axis.
dvec3 normal_of(double theta, double psi) {
  return {std::sin(theta) * std::cos(psi), std::sin(theta) * std::sin(psi), std::cos(theta)};
}

TEST(BiasFacts, Depth_per_texel_is_texel_times_tangent_times_p_plus_q) {
  for (const double theta : {0.0, 30.0, 60.0, 75.0}) {
    for (const double psi : {0.0, 20.0, 45.0, 250.0}) {
      const double expected =
          0.1 * std::tan(theta * degrees) * (std::abs(std::cos(psi * degrees)) + std::abs(std::sin(psi * degrees)));
      EXPECT_NEAR(
          depth_per_texel_at(orthographic_layout(), {1.23, -4.56, 0.0}, normal_of(theta * degrees, psi * degrees)),
          expected, 1e-9)
          << theta << " " << psi;
    }
  }
}

TEST(BiasFacts, Of_a_spot_light_is_that_of_its_texels_at_the_receiver) {
  // At depth 8 m on the axis a texel is 2 · tan 45° · 8 m / 200 = 0.08 m. The centre of the receiver's texel lies half
  // a texel, u = 0.005, from the axis, where the depth changes by 1 / (1 − u · tan θ)² as much.
  MapLayout layout;
  layout.kind = MapKind::perspective;
  layout.resolution = 200;
  const double tangent = std::sqrt(3.0);
  EXPECT_NEAR(depth_per_texel_at(layout, {0.0, 0.0, -8.0}, normal_of(60 * degrees, 0.0)),
              0.08 * tangent / std::pow(1.0 - 0.005 * tangent, 2), 0.08 * 1e-3);
}

TEST(BiasFacts, A_plane_that_faces_away_has_none) {
  EXPECT_TRUE(std::isinf(depth_per_texel_at(orthographic_layout(), dvec3(0.0), {0.0, 0.0, -1.0})));
}

FilterKernel filter_of(ShadowFilter filter, int size, FilterTaps taps = FilterTaps::nearest) {
  PcfParams params;
  params.filter = filter;
  params.size = size;
  params.taps = taps;
  return make_filter(params);
}

TEST(BiasFacts, A_filter_reaches_its_farthest_tap) {
  // A receiver is at most half a texel from the centre of the kernel, so that with the least bias without acne on a
  // plane, ρ · depth per texel, reach = ρ − ½: ρ = ½ for one tap, 1 for bilinear 2×2, r + ½ for (2r+1)² nearest taps
  // and r + 1 for (2r+1)² bilinear ones.
  EXPECT_EQ(reach_of(filter_of(ShadowFilter::nearest, 5)), 0.0);
  EXPECT_EQ(reach_of(filter_of(ShadowFilter::bilinear, 5)), 0.5);
  EXPECT_EQ(reach_of(filter_of(ShadowFilter::box, 5)), 2.0);
  EXPECT_EQ(reach_of(filter_of(ShadowFilter::tent, 5, FilterTaps::linear)), 2.5);
  PcfParams params;
  params.filter = ShadowFilter::vogel;
  params.samples = 8;
  params.radius = 4.0;
  // The outermost of n points of a Vogel disk lies at √((n − ½) / n).
  EXPECT_NEAR(reach_of(make_filter(params)), 4.0 * std::sqrt(7.5 / 8.0), 1e-5);
  EXPECT_TRUE(std::isnan(reach_of(make_pcss_filter(params, {}, 0.1)))) << "each pixel has another radius";
}

TEST(BiasFacts, Are_those_that_90_percent_of_the_counted_pixels_do_not_exceed) {
  // 100 counted pixels, of tan θ = 1 to 100, and one that does not count.
  GBuffer gbuffer(101, 1);
  CountedPixels counted;
  counted.exclusion = Image<PixelExclusion>(101, 1, PixelExclusion::none);
  for (int i = 0; i < 101; ++i) {
    gbuffer.position[static_cast<std::size_t>(i)] = vec3(0.0f);
    gbuffer.geometric_normal[static_cast<std::size_t>(i)] = vec3(normal_of(std::atan(i), 0.0));
  }
  gbuffer.geometric_normal[0] = vec3(0.0f, 0.0f, -1.0f);
  counted.exclusion[0] = PixelExclusion::back_facing;
  MapDepthParams depth;
  depth.format = MapDepthFormat::fixed16;
  FilterKernel kernel;
  kernel.kernel = {1, 1, 1};
  const BiasFacts facts = measure_facts(gbuffer, orthographic_layout(), counted, depth, kernel);
  EXPECT_NEAR(facts.depth_per_texel, 0.1 * 90.0, 1e-3);
  EXPECT_EQ(facts.radius, 1.0);
  EXPECT_NEAR(facts.depth_step, 100.0 / 65535.0, 1e-12);
}

TEST(BiasFacts, Without_counted_pixels_are_unknown) {
  CountedPixels counted;
  counted.exclusion = Image<PixelExclusion>(4, 4, PixelExclusion::background);
  FilterKernel kernel;
  kernel.kernel = {1};
  EXPECT_TRUE(std::isnan(measure_facts(GBuffer(4, 4), orthographic_layout(), counted, {}, kernel).depth_per_texel));
}

}  // namespace
}  // namespace umbrameter
