// The causes of a filtered shadow as layers of a run, and the intervals that `report` computes from them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/jackknife.h"
#include "core/quantiles.h"
#include "results/layers.h"
#include "store/run_comparison.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

constexpr std::array<const char*, 4> causes = {"acne", "false_occlusion", "peter_panning", "leak"};

struct CauseLayers : GlRun {
  StoredRun run(const std::string& name, const std::vector<std::string>& settings) {
    const ProgramResult result =
        run_program(words({"compare", "contact-box", "-o", folder_ / name, "--light", "sun", "--measure", "visibility",
                           "--size", "128x72", "--shadow.resolution", "256", "--no-figures", "--quiet"},
                          settings));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_stored_run(folder_ / name);
  }
  StoredRun box(const std::string& name, const std::string& bias) {
    return run(name, {"--shadow.filter", "box", "--shadow.filter-size", "3", "--shadow.constant-bias", bias});
  }
};

const MeasuredStatistic& statistic(const StoredRun& run, const std::string& name) {
  return *std::ranges::find(run.statistics, name, &MeasuredStatistic::name);
}

bool is_counted(const StoredRun& run, std::size_t i) {
  const float pixel = (*find_channel(run.images, "class_sun.Y"))[i];
  return pixel <= 4.0f;
}

TEST_F(CauseLayers, Of_a_filter_add_up_to_the_absolute_error_of_each_counted_pixel) {
  const StoredRun stored = box("box", "0.2texels");
  const Image<float>& error = *find_channel(stored.images, "error_visibility_sun.Y");
  std::array<std::size_t, 4> pixels{};
  std::size_t of_several = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!is_counted(stored, i)) continue;
    float sum = 0.0f;
    int present = 0;
    for (std::size_t c = 0; c < causes.size(); ++c) {
      const Image<float>* share = find_channel(stored.images, std::string(causes[c]) + "_sun.Y");
      ASSERT_NE(share, nullptr) << causes[c];
      sum += (*share)[i];
      present += (*share)[i] > 0.0f ? 1 : 0;
      pixels[c] += (*share)[i] > 0.0f ? 1u : 0u;
    }
    of_several += present > 1 ? 1 : 0;
    ASSERT_NEAR(sum, std::abs(error[i]), 1e-6f) << i;
  }
  EXPECT_GT(pixels[0], 10u);
  EXPECT_GT(pixels[1], 10u);
  EXPECT_GT(of_several, 0u) << "else the class layer would say as much";
}

TEST_F(CauseLayers, Of_one_tap_are_the_class_layer_alone) {
  const StoredRun stored = run("nearest", {"--shadow.filter", "nearest"});
  EXPECT_NE(find_channel(stored.images, "class_sun.Y"), nullptr);
  for (const char* cause : causes)
    EXPECT_EQ(find_channel(stored.images, std::string(cause) + "_sun.Y"), nullptr) << cause;
}

// 8 × 8 blocks of 16 × 9 pixels in 128 × 72 pixels.
TEST_F(CauseLayers, Give_a_filtered_map_intervals_and_paired_differences_of_its_causes) {
  const StoredRun stored = box("box", "0.2texels");
  const Image<float>& acne = *find_channel(stored.images, "acne_sun.Y");
  struct Sum {
    double share = 0.0;
    double pixels = 0.0;
  };
  std::array<Sum, 64> blocks{};
  Sum all;
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 128; ++x) {
      const std::size_t i = acne.index(x, y);
      if (!is_counted(stored, i)) continue;
      for (Sum* sum : {&blocks[static_cast<std::size_t>(y / 9 * 8 + x / 16)], &all}) {
        sum->share += acne[i];
        sum->pixels += 1.0;
      }
    }
  }
  std::vector<double> without;
  std::vector<BlockPlace> places;
  for (int b = 0; b < 64; ++b) {
    const Sum& block = blocks[static_cast<std::size_t>(b)];
    if (block.pixels == 0.0) continue;
    without.push_back((all.share - block.share) / (all.pixels - block.pixels));
    places.push_back({b % 8, b / 8});
  }
  const JackknifeVariance spread = jackknife_variance(without, places);
  const double half_width = student_95(spread.degrees_of_freedom) * std::sqrt(spread.variance);
  const MeasuredStatistic& measured = statistic(stored, "acne");
  ASSERT_GT(measured.value, 0.001);
  const std::optional<BlockEstimate> estimate = estimate_over_blocks(stored, measured);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->blocks, without.size());
  EXPECT_NEAR(estimate->value, all.share / all.pixels, 1e-7);
  EXPECT_NEAR(estimate->half_width, half_width, 1e-9);

  const StoredRun other = box("other", "0.4texels");
  for (const char* cause : causes) {
    EXPECT_TRUE(paired_difference(stored, statistic(stored, cause), other, statistic(other, cause))) << cause;
  }
}

}  // namespace
}  // namespace umbrameter
