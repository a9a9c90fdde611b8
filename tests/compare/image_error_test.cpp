#include "compare/image_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace umbrameter {
namespace {

// A row of pixels, all surfaces but the last.
struct ImageRow {
  explicit ImageRow(std::size_t n)
      : width(static_cast<int>(n)), gbuffer(width, 1), distance(width, 1, std::numeric_limits<float>::infinity()) {
    for (std::size_t i = 0; i + 1 < n; ++i) gbuffer.instance[i] = 0;
  }
  Image<float> image(std::vector<float> values) const {
    Image<float> made(width, 1);
    made.pixels = std::move(values);
    return made;
  }
  int width;
  GBuffer gbuffer;
  Image<float> distance;
  Image<float> none{};
};

TEST(ImageError, Parts_are_what_the_error_loses_and_background_does_not_count) {
  ImageRow row(5);
  row.distance[0] = 1.0f;
  const Image<float> truth = row.image({0.5f, 0.5f, 0.5f, 0.5f, 0.0f});
  const Image<float> raster = row.image({0.9f, 0.4f, 0.5f, 0.52f, 7.0f});
  const Image<float> true_shadows = row.image({0.5f, 0.4f, 0.5f, 0.52f, 7.0f});
  const Image<float> true_ao = row.image({0.9f, 0.5f, 0.5f, 0.52f, 7.0f});
  const ImageErrorInput input{
      raster, {truth, row.none, row.none, 0}, {&true_shadows, &true_ao, &raster, &raster}, row.distance, row.gbuffer};
  const ImageStatistics s = analyze_image(input);
  EXPECT_EQ(s.error.pixels, 4u);
  EXPECT_NEAR(s.error.mae.value, (0.4 + 0.1 + 0.02) / 4, 1e-7);
  EXPECT_NEAR(s.near_edges, 0.25, 1e-12);
  EXPECT_NEAR(s.mae_off_edges, (0.1 + 0.02) / 3, 1e-7);
  EXPECT_NEAR(s.parts[0], 0.1, 1e-7);
  EXPECT_NEAR(s.parts[1], 0.025, 1e-7);
  EXPECT_EQ(s.parts[2], 0.0);
  EXPECT_EQ(s.parts[3], 0.0);
  const Image<std::uint8_t> causes = classify_image(input, 0.05f);
  const std::vector<std::uint8_t> expected = {0, 1, no_image_cause, no_image_cause, no_image_cause};
  EXPECT_EQ(causes.pixels, expected);
}

TEST(ImageError, An_input_that_hides_the_error_of_another_has_a_negative_part) {
  const ImageRow row(2);
  const Image<float> truth = row.image({0.5f, 0.0f});
  const Image<float> raster = row.image({0.5f, 0.0f});
  const Image<float> worse = row.image({0.7f, 0.0f});
  const ImageStatistics s = analyze_image(
      {raster, {truth, row.none, row.none, 0}, {&worse, &raster, &raster, &raster}, row.distance, row.gbuffer});
  EXPECT_NEAR(s.parts[0], -0.2, 1e-7);
}

TEST(ImageError, Without_a_surface_nothing_is_measured) {
  const ImageRow row(1);
  const Image<float> any = row.image({0.5f});
  const ImageStatistics s =
      analyze_image({any, {any, row.none, row.none, 0}, {&any, &any, &any, &any}, row.distance, row.gbuffer});
  EXPECT_EQ(s.error.pixels, 0u);
  for (const Value& value : row_of(ImageStatistics{s})) {
    if (const auto* number = std::get_if<double>(&value)) {
      EXPECT_TRUE(std::isnan(*number));
    }
  }
}

}  // namespace
}  // namespace umbrameter
