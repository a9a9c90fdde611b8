#include "compare/map_views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "techniques/shadow/cascades.h"

namespace umbrameter {
namespace {

// Ten surfels on the ground along x; the light shines straight down.
struct MapRow {
  GBuffer gbuffer{10, 1};
  Light light;
  MapLayout layout;
  CountedPixels counted{Image<PixelExclusion>(10, 1, PixelExclusion::none)};

  MapRow() {
    light.shape = DirectionalLight{};
    layout.resolution = 320;
    layout.far_depth = 10.0;
    // Light space: x right, y = −z of the world, 5 m above the ground.
    layout.light_from_world = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, -1, 0, 0), dvec4(0, 0, -5, 1));
    for (int i = 0; i < 10; ++i) {
      const auto at = static_cast<std::size_t>(i);
      gbuffer.instance[at] = 0;
      gbuffer.triangle[at] = 0;
      gbuffer.position[at] = vec3(static_cast<float>(i) + 0.5f, 0, 0);
      gbuffer.geometric_normal[at] = vec3(0, 1, 0);
    }
    counted.totals[0] = 10;
    // The margin is a tenth of the side: the first cascade serves |x| ≤ 0.9 · 6.67 = 6.
    layout.views = {{dvec2(0.0), 6.0 / 0.9}, {dvec2(0.0), 20.0}};
  }
};

TEST(MapViews, Each_view_gets_the_error_of_the_pixels_that_it_serves) {
  MapRow row;
  const Image<float> truth(10, 1, 1.0f);
  Image<float> drawn(10, 1, 1.0f);
  WrongTaps wrong{Image<uvec4>(10, 1, uvec4(0)), 4};
  drawn[1] = 0.5f;  // in the first cascade
  wrong.weights[1] = uvec4(2, 0, 0, 0);
  drawn[8] = 0.25f;  // in the second
  wrong.weights[8] = uvec4(1, 2, 0, 0);
  const std::vector<ViewStatistics> views =
      analyze_views({row.gbuffer, truth, row.counted, row.light, row.layout}, drawn, &wrong);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].pixels, 6u);
  EXPECT_EQ(views[1].pixels, 4u);
  EXPECT_NEAR(views[0].share, 0.6, 1e-12);
  EXPECT_NEAR(views[0].mean_texel, 12.0 / 0.9 / 320, 1e-12);
  EXPECT_NEAR(views[1].mean_texel, 0.125, 1e-12);
  EXPECT_NEAR(views[0].mae, 0.5 / 6, 1e-12);
  EXPECT_NEAR(views[1].mean_error, -0.75 / 4, 1e-12);
  EXPECT_NEAR(views[0].causes[0], 0.5 / 6, 1e-12);
  EXPECT_NEAR(views[1].causes[0], 0.25 / 4, 1e-12);
  EXPECT_NEAR(views[1].causes[1], 0.5 / 4, 1e-12);
  const auto uncaused = analyze_views({row.gbuffer, truth, row.counted, row.light, row.layout}, drawn, nullptr);
  EXPECT_TRUE(std::isnan(uncaused[0].causes[0]));
  EXPECT_EQ(uncaused[0].mae, views[0].mae);
}

TEST(MapViews, A_seam_is_the_outer_tenth_of_a_cascade_that_the_next_one_also_holds) {
  MapRow row;
  // The first serves |x| ≤ 6; its outer tenth starts at 5.4: the surfel at 5.5.
  Image<std::uint8_t> seams = find_seams(row.gbuffer, row.layout, row.counted);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(seams[i], i == 5 ? 1 : 0) << i;
  row.layout.views[1].half_extent = 5.45;
  seams = find_seams(row.gbuffer, row.layout, row.counted);
  EXPECT_EQ(seams[5], 0) << "the last cascade does not hold it";

  const Image<std::uint8_t> two(2, 1, std::uint8_t{1});
  Image<float> own(2, 1, 1.0f);
  Image<float> neighbour(2, 1, 0.5f);
  own[1] = 0.25f;
  const SeamStatistics found = analyze_seams(two, own, neighbour, row.counted);
  EXPECT_EQ(found.pixels, 2u);
  EXPECT_NEAR(found.share, 0.2, 1e-12);
  EXPECT_NEAR(found.mean_difference, (0.5 + 0.25) / 2, 1e-12);
  EXPECT_NEAR(found.largest_difference, 0.5, 1e-12);
}

}  // namespace
}  // namespace umbrameter
