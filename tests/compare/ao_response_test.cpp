// The error at every cell from one pass, against the error of the image of each cell.
#include "compare/ao_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "techniques/ao/ssao.h"

namespace umbrameter {
namespace {

constexpr int image_width = 37;
constexpr int image_height = 19;
constexpr int samples = 24;

float number(std::uint32_t purpose, std::size_t i, std::uint32_t j = 0) {
  return to_unit_float(hash(purpose, static_cast<std::uint32_t>(i), j));
}

struct Case {
  GBuffer gbuffer;
  Image<float> truth{image_width, image_height};
  Image<float> variance{image_width, image_height};
  Image<float> rays{image_width, image_height};
  std::vector<std::uint32_t> counts;
  std::vector<OccludingSample> occluding;
  AoAxes axes;

  SampledImage sampled() const { return {truth, variance, rays, 12}; }
  // As the technique draws it.
  Image<float> draw(std::size_t bias, int count, const AoToneParams& tone) const {
    Image<float> ao(image_width, image_height);
    for (std::size_t i = 0; i < ao.size(); ++i) {
      float sum = 0.0f;
      for (std::size_t k = 0; k < counts[i]; ++k) {
        const OccludingSample& each = occluding[i * samples + k];
        if (each.index() < count && bias < each.biases()) sum += each.weight;
      }
      ao[i] = with_tone(std::max(1.0f - sum * share_of_sample(count), 0.0f), tone);
    }
    return ao;
  }
};

Case make_case() {
  Case c;
  c.axes = {{-0.1f, 0.0f, 0.01f, 0.02f, 0.5f}, {1, 2, 3, 7, 16, 24}, {{1, 1}, {1, 2.2}, {0.5, 1}, {3.0, 0.7}}};
  c.gbuffer = GBuffer(image_width, image_height);
  c.occluding.resize(c.truth.size() * samples);
  for (std::size_t i = 0; i < c.truth.size(); ++i) {
    c.gbuffer.instance[i] = number(1, i) < 0.1f ? no_id : 0;
    c.truth[i] = number(2, i);
    c.variance[i] = number(3, i) < 0.3f ? 0.0f : 0.01f * number(4, i);
    c.rays[i] = c.variance[i] > 0.0f ? 64.0f : 0.0f;
    c.counts.push_back(0);
    if (number(5, i) < 0.2f) continue;  // open
    for (std::uint32_t s = 0; s < samples; ++s) {
      const auto biases = static_cast<std::uint32_t>(number(6, i, s) * static_cast<float>(c.axes.biases.size() + 1));
      if (biases == 0) continue;
      const float weight = number(7, i, s) < 0.7f ? 1.0f : number(8, i, s);
      c.occluding[i * samples + c.counts.back()++] = {s << 22u | biases, weight};
    }
  }
  return c;
}

void expect_same(const Estimate& a, const Estimate& b) {
  EXPECT_NEAR(a.value, b.value, 1e-11);
  EXPECT_NEAR(a.lower, b.lower, 1e-10);
  EXPECT_NEAR(a.upper, b.upper, 1e-10);
}

TEST(AoResponse, Every_cell_has_the_error_of_its_own_image) {
  const Case c = make_case();
  AoResponse response(c.sampled(), c.gbuffer, c.axes);
  std::vector<AoResponseRow> rows;
  for (int y = 0; y < image_height; ++y) {
    const std::size_t at = static_cast<std::size_t>(y) * image_width;
    rows.push_back({y, samples, std::span(c.counts).subspan(at, image_width),
                    std::span(c.occluding).subspan(at * samples, std::size_t{image_width} * samples)});
  }
  // In two parts, as a pass gives them.
  response.add(std::span(rows).first(8));
  response.add(std::span(rows).subspan(8));
  const std::vector<AoStatistics> all = response.statistics();
  ASSERT_EQ(all.size(), c.axes.cells());
  std::size_t cell = 0;
  for (std::size_t b = 0; b < c.axes.biases.size(); ++b) {
    for (const int count : c.axes.samples) {
      for (const AoToneParams& tone : c.axes.tones) {
        const SampledError& measured = all[cell++].error;
        const SampledError expected = analyze_ao(c.draw(b, count, tone), c.sampled(), c.gbuffer).error;
        EXPECT_EQ(measured.pixels, expected.pixels);
        EXPECT_EQ(measured.max_error, expected.max_error);
        EXPECT_NEAR(measured.mean_raster, expected.mean_raster, 1e-12);
        expect_same(measured.mean_truth, expected.mean_truth);
        expect_same(measured.mean_error, expected.mean_error);
        expect_same(measured.mae, expected.mae);
        expect_same(measured.rmse, expected.rmse);
      }
    }
  }
  EXPECT_NE(all.front().error.mae.value, all.back().error.mae.value);
}

TEST(AoResponse, An_image_of_background_has_no_error) {
  Case c = make_case();
  for (std::uint32_t& instance : c.gbuffer.instance.pixels) instance = no_id;
  const std::vector<AoStatistics> all = AoResponse(c.sampled(), c.gbuffer, c.axes).statistics();
  for (const AoStatistics& cell : all) EXPECT_EQ(cell.error.pixels, 0u);
}

}  // namespace
}  // namespace umbrameter
