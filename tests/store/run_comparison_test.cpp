// The intervals of `report` against answers that are known: whole runs are made here.
#include "store/run_comparison.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "reports/files/exr.h"

namespace umbrameter {
namespace {

constexpr int side = 64;
constexpr int randomisations = 8;

// The noise of a reference, and its variance as estimated from the randomisations.
struct Noise {
  Image<float> of_mean{side, side};
  Image<float> variance{side, side};

  Noise(unsigned seed, double sigma) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, sigma * std::sqrt(double{randomisations}));
    for (std::size_t i = 0; i < variance.size(); ++i) {
      double sum = 0.0;
      double squares = 0.0;
      for (int r = 0; r < randomisations; ++r) {
        const double value = normal(random);
        sum += value;
        squares += value * value;
      }
      of_mean[i] = static_cast<float>(sum / randomisations);
      variance[i] = static_cast<float>((squares - sum * sum / randomisations) / (randomisations - 1) / randomisations);
    }
  }
};

// The errors of two techniques without the noise of a reference. That of a patch of 8 × 8 pixels is u·w, u uniform in
// the patch and w in [−1, 1] in each pixel: its mean is 1/2 · 1/2, its mean square 1/3 · 1/3. That of the second is 0.9
// of it, and 0.05 of another such error: 0.81/9 + 0.0025/9.
struct Techniques {
  static constexpr double mae_of_first = 0.25;
  static constexpr double rmse_of_first = 1.0 / 3.0;
  static double rmse_of_second() { return std::sqrt(0.8125) / 3.0; }

  std::array<Image<float>, 2> error{Image<float>(side, side), Image<float>(side, side)};

  explicit Techniques(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> patches(128);
    for (double& patch : patches) patch = unit(random);
    for (std::size_t i = 0; i < error[0].size(); ++i) {
      const std::size_t patch = i / side / 8 * 8 + i % side / 8;
      const double common = patches[patch] * (2.0 * unit(random) - 1.0);
      const double other = patches[64 + patch] * (2.0 * unit(random) - 1.0);
      error[0][i] = static_cast<float>(common);
      error[1][i] = static_cast<float>(0.9 * common + 0.05 * other);
    }
  }
};

double mean_of(const Image<float>& image, double (*term)(double)) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += term(static_cast<double>(value));
  return sum / static_cast<double>(image.size());
}

double mean_absolute(const Image<float>& image) {
  return mean_of(image, [](double value) { return std::abs(value); });
}

StoredRun run_of(const Image<float>& technique, const Noise& noise) {
  StoredRun run;
  Image<float> error = technique;
  Image<float> truth(side, side, 0.5f);
  for (std::size_t i = 0; i < error.size(); ++i) {
    truth[i] += noise.of_mean[i];
    error[i] -= noise.of_mean[i];
  }
  const double mean_square = mean_of(error, [](double value) { return value * value; }) -
                             mean_of(noise.variance, [](double value) { return value; });
  const std::pair<const char*, double> statistics[] = {
      {"rmse", std::sqrt(mean_square)},
      {"mean_error", mean_of(error, [](double value) { return value; })},
      {"mae", mean_absolute(error)},
      {"too_dark", mean_of(error, [](double value) { return std::max(-value, 0.0); })}};
  for (const auto& [name, value] : statistics) {
    MeasuredStatistic& measured = run.statistics.emplace_back();
    measured.kind = "ao";
    measured.name = name;
    measured.value = value;
    measured.half_width = 0.001;  // of the rays, which must not decide
    measured.degrees_of_freedom = randomisations - 1;
  }
  add_layer(run.images, "error_ao", error);
  add_layer(run.images, "truth_ao", truth);
  add_layer(run.images, "truth_ao_variance", noise.variance);
  add_layer(run.images, "gbuffer_position", Image<vec3>(side, side, vec3(1.0f)));
  return run;
}

bool holds(const Estimate& estimate, double answer) { return estimate.lower <= answer && answer <= estimate.upper; }

// How many of the draws hold the answer: of the value of the first run, and of the difference.
struct Held {
  int value = 0;
  int difference = 0;
};

// 92 to 98 %; the standard error of a share of 400 draws is 1.1 %. Bounds hold it at least so often.
constexpr int draws = 400;
constexpr double fewest = 0.92 * draws;
constexpr double most = 0.98 * draws;

TEST(RunsReportIntervals, End_where_the_range_of_their_statistic_does) {
  ComparedValue lit;
  lit.measured.kind = "shadow";
  lit.measured.name = "lit";
  lit.measured.unit = "1";
  lit.measured.value = 0.981;
  lit.half_width = 0.025;
  EXPECT_EQ(estimate_of(lit).upper, 1.0);
  EXPECT_NEAR(estimate_of(lit).lower, 0.956, 1e-12);
  ComparedValue luminance = lit;
  luminance.measured.kind = "image";  // 1 is white, and light may be brighter
  EXPECT_NEAR(estimate_of(luminance).upper, 1.006, 1e-12);
  lit.measured.value = 0.01;
  EXPECT_EQ(estimate_of(lit).lower, 0.0);
}

TEST(RunsReportIntervals, Hold_the_value_95_times_in_100_over_the_choice_of_pixels_and_the_noise_of_the_reference) {
  Held rmse, mean, mae, too_dark;
  double mae_of_second = 0.0;
  for (unsigned seed = 0; seed < draws; ++seed)
    mae_of_second += mean_absolute(Techniques(2 * seed).error[1]) / double{draws};
  for (unsigned seed = 0; seed < draws; ++seed) {
    const Techniques made(2 * seed);
    const Noise noise(2 * seed + 1, 0.1);
    const std::vector<StoredRun> runs = {run_of(made.error[0], noise), run_of(made.error[1], noise)};
    const std::vector<ComparedStatistic> compared = compare_runs(runs);
    const auto count = [&](std::size_t statistic, Held& held, double first, double second) {
      const std::vector<ComparedValue>& values = compared.at(statistic).values;
      ASSERT_EQ(values.at(0).interval, IntervalOf::pixels) << "the noise of the reference must not prevent it";
      ASSERT_EQ(values.at(1).blocks, 64u);
      held.value += holds(estimate_of(values[0]), first) ? 1 : 0;
      held.difference += holds(values[1].difference, second - first) ? 1 : 0;
    };
    count(0, rmse, Techniques::rmse_of_first, Techniques::rmse_of_second());
    count(1, mean, 0.0, 0.0);
    count(2, mae, Techniques::mae_of_first, mae_of_second);
    count(3, too_dark, 0.5 * Techniques::mae_of_first, 0.5 * mae_of_second);
  }
  for (const Held& held : {rmse, mean, mae, too_dark}) {
    EXPECT_GE(held.value, fewest);
    EXPECT_GE(held.difference, fewest);
  }
  for (const Held& held : {rmse, mean}) {
    EXPECT_LE(held.value, most);
    EXPECT_LE(held.difference, most);
  }
}

// Noise raises an absolute error: 0.3 of it raises a mean of 0.25 by a third.
TEST(RunsReportIntervals, Of_absolute_errors_do_not_take_the_noise_of_fewer_rays_for_a_larger_error) {
  Held mae, too_dark;
  int without = 0;  // intervals that hold the answer but for what noise may have added
  for (unsigned seed = 0; seed < draws; ++seed) {
    const Techniques made(3 * seed);
    const std::vector<StoredRun> runs = {run_of(made.error[0], Noise(3 * seed + 1, 0.3)),
                                         run_of(made.error[0], Noise(3 * seed + 2, 0.03))};
    const std::vector<ComparedStatistic> compared = compare_runs(runs);
    const auto count = [&](std::size_t statistic, Held& held, double answer) {
      const std::vector<ComparedValue>& values = compared.at(statistic).values;
      held.value += holds(estimate_of(values.at(0)), answer) ? 1 : 0;
      held.difference += holds(values.at(1).difference, 0.0) ? 1 : 0;
    };
    count(2, mae, Techniques::mae_of_first);
    count(3, too_dark, 0.5 * Techniques::mae_of_first);
    const auto paired = paired_difference(runs[0], runs[0].statistics.at(2), runs[1], runs[1].statistics.at(2));
    ASSERT_TRUE(paired);
    without += std::abs(paired->value) <= paired->half_width ? 1 : 0;
  }
  for (const Held& held : {mae, too_dark}) {
    EXPECT_GE(held.value, fewest);
    EXPECT_GE(held.difference, fewest);
  }
  EXPECT_EQ(without, 0) << "the noise is too small for this test";
}

// A reference with little noise: the interval of a small difference must not hold that of both runs.
TEST(RunsReportIntervals, Of_two_techniques_with_one_reference_allow_for_the_noise_that_does_not_cancel) {
  const Techniques made(1);
  const Noise noise(2, 0.1);
  Image<float> nearly = made.error[0];
  for (float& error : nearly.pixels) error += 0.001f;
  const auto added = [&](const Image<float>& technique) {
    const StoredRun first = run_of(made.error[0], noise);
    const StoredRun second = run_of(technique, noise);
    return paired_difference(first, first.statistics.at(2), second, second.statistics.at(2))->added;
  };
  EXPECT_EQ(added(made.error[0]), 0.0);
  EXPECT_GT(added(nearly), 0.0);
  EXPECT_LE(added(nearly), 0.001 + 1e-7) << "no more than the techniques differ by";
  EXPECT_GT(added(made.error[1]), 0.001);
}

// The RMS error of pixels that are right or wrong is the root of the share of wrong ones: one question, one verdict.
TEST(RunsReportIntervals, Of_pixels_that_are_right_or_wrong_give_both_errors_one_verdict) {
  const Noise none(1, 0.0);
  int significant = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto wrong = [&](double share) {
      Image<float> error(side, side);
      for (float& pixel : error.pixels) pixel = unit(random) < share ? -1.0f : 0.0f;
      return error;
    };
    const std::vector<StoredRun> runs = {run_of(wrong(0.020), none), run_of(wrong(0.014), none)};
    const std::vector<ComparedStatistic> compared = compare_runs(runs);
    const ComparedValue& root = compared.at(0).values.at(1);
    const ComparedValue& mean = compared.at(2).values.at(1);
    EXPECT_EQ(root.verdict, mean.verdict);
    const double sum = root.measured.value + compared.at(0).values.at(0).measured.value;
    EXPECT_NEAR(root.difference.upper * sum, mean.difference.upper, 1e-6);
    significant += mean.verdict == Verdict::significant ? 1 : 0;
  }
  EXPECT_GT(significant, 5);
  EXPECT_LT(significant, 35);
}

TEST(RunsReportIntervals, What_the_first_run_has_not_measured_is_listed_and_not_compared) {
  const Noise noise(1, 0.1);
  std::vector<StoredRun> runs = {run_of(Techniques(2).error[0], noise), run_of(Techniques(2).error[1], noise)};
  std::erase_if(runs[0].statistics, [](const MeasuredStatistic& each) { return each.name == "mae"; });
  MeasuredStatistic shadow = runs[1].statistics.front();
  shadow.kind = "shadow";
  shadow.light = "sun";
  runs[1].statistics.insert(runs[1].statistics.begin(), shadow);
  std::vector<std::string> names;
  for (const ComparedStatistic& each : compare_runs(runs)) {
    names.push_back(each.kind + " " + each.name);
    const bool has_base = each.values.front().run == 0;
    EXPECT_EQ(each.values.back().verdict == Verdict::no_base, !has_base) << names.back();
    EXPECT_GT(each.values.back().half_width, 0.0);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"ao rmse", "ao mean_error", "ao too_dark", "ao mae", "shadow rmse"}))
      << "those of AO stand together";
}

}  // namespace
}  // namespace umbrameter
