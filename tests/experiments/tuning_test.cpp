// The parts of a tuning whose answer is known: axes, goals, the search, the front, the journal.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "core/error.h"
#include "core/random.h"
#include "experiments/settings/experiment.h"
#include "experiments/tune/minimize.h"
#include "experiments/tune/tune_journal.h"
#include "experiments/tune/tune_significance.h"
#include "present/tune_report.h"
#include "present/tune_text.h"
#include "results/tune_goal.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

TuneAxis axis(const std::string& key, const std::string& text) {
  Experiment experiment;
  return parse_tune_axis(describe(experiment), key, text);
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(TuneAxis, Range_is_continuous_and_its_ends_are_exact) {
  const TuneAxis range = axis("shadow.constant-bias", "0:8texels");
  EXPECT_TRUE(range.is_continuous);
  EXPECT_EQ(range.axis.unit, "texels");
  EXPECT_EQ(to_number(value_at(range, 0.0)), 0.0);
  EXPECT_EQ(to_number(value_at(range, 1.0)), 8.0);
  EXPECT_EQ(to_number(value_at(range, 0.5)), 4.0);
  EXPECT_EQ(position_of(range, 2.0), 0.25);
  const TuneAxis logarithmic = axis("ao.radius", "0.1:10:log");
  EXPECT_EQ(to_number(value_at(logarithmic, 0.5)), 1.0);
  EXPECT_NEAR(position_of(logarithmic, 1.0), 0.5, 1e-15);
}

TEST(TuneAxis, Whole_numbers_are_listed) {
  const TuneAxis samples = axis("ao.samples", "4:7");
  EXPECT_FALSE(samples.is_continuous);
  EXPECT_EQ(samples.axis.values,
            (std::vector<Value>{std::int64_t{4}, std::int64_t{5}, std::int64_t{6}, std::int64_t{7}}));
  EXPECT_EQ(value_at(samples, 0.4), Value(std::int64_t{5}));
}

TEST(TuneAxis, A_default_in_another_unit_is_named_and_lies_outside) {
  const TuneAxis metres = axis("shadow.constant-bias", "0.002:0.2");
  Experiment experiment;
  experiment.shadow.bias.constant = {1.5, LengthUnit::texels};
  const Value given = present_value(describe(experiment), metres);
  EXPECT_EQ(given, Value("1.5texels"));
  EXPECT_EQ(value_text(metres, given), "1.5 texels");
  EXPECT_EQ(value_text(axis("ao.samples", "4:7"), Value(std::int64_t{5})), "5") << "a count is no length";
  EXPECT_LT(position_of(metres, given), 0.0);
  experiment.shadow.bias.constant = {0.05, LengthUnit::metres};
  EXPECT_EQ(present_value(describe(experiment), metres), Value(0.05));
}

TEST(TuneAxis, Of_a_sweep_keeps_its_values_and_words_have_no_order) {
  EXPECT_EQ(axis("shadow.slope-bias", "0:2:5").count(), 5u);
  EXPECT_TRUE(axis("shadow.filter", "nearest,box").is_word());
  EXPECT_NE(refusal([] { axis("shadow.slope-bias", "2:1"); }), "");
  EXPECT_NE(refusal([] { axis("shadow.slope-bias", "0:x"); }), "");
  EXPECT_NE(refusal([] { axis("shadow.slope-bais", "0:1"); }).find("did you mean"), std::string::npos);
}

TuneGoal goal(const std::string& cost, const std::vector<std::string>& constraints = {}, bool worst = false) {
  static const std::vector<TuneAxis> axes = {axis("shadow.slope-bias", "0:4")};
  return make_goal(cost, constraints, "shadow", axes, worst);
}

TEST(TuneGoal, Cost_is_the_weighted_sum_over_the_mean_or_the_worst_case) {
  const TuneGoal mean = goal("acne + 0.5*rmse");
  const std::vector<CaseValues> cases = {{0.1, 0.2}, {0.3, 0.0}};
  EXPECT_DOUBLE_EQ(total_cost(mean, cases), 0.25);
  EXPECT_DOUBLE_EQ(total_cost(goal("acne + 0.5*rmse", {}, true), cases), 0.3);
  EXPECT_TRUE(std::isnan(total_cost(mean, {{0.1, std::nan("")}})));
}

TEST(TuneGoal, Constraint_holds_in_every_case_and_comes_before_the_cost) {
  const TuneGoal constrained = goal("mae", {"acne<10%"});
  const TuneScore kept = score_of(constrained, {0.0}, {{0.5, 0.05}, {0.5, 0.09}});
  const TuneScore broken = score_of(constrained, {0.0}, {{0.1, 0.05}, {0.1, 0.2}});
  EXPECT_TRUE(kept.is_kept());
  EXPECT_NEAR(broken.violation, 1.0, 1e-6);  // 20 % is 100 % more than 10 %
  EXPECT_TRUE(is_better(kept, broken));
  EXPECT_LT(to_number(kept), to_number(broken));
  EXPECT_FALSE(score_of(goal("mae", {"shadow.slope-bias<=1"}), {1.5}, {{0.1}}).is_kept());
}

TEST(TuneGoal, Relative_cost_counts_each_case_in_multiples_of_the_default) {
  for (const bool is_worst : {false, true}) {
    TuneGoal relative = goal("mae", {}, is_worst);
    relative.is_relative = true;
    const TuneGoal known = relative_to(relative, {{0.2}, {0.4}});
    // 0.1/0.2 = 0.5 and 0.4/0.4 = 1
    EXPECT_DOUBLE_EQ(total_cost(known, {{0.1}, {0.4}}), is_worst ? 1.0 : 0.75);
    EXPECT_DOUBLE_EQ(total_cost(not_relative(known), {{0.1}, {0.4}}), is_worst ? 0.4 : 0.25);
    EXPECT_EQ(cost_name(known), "mae / default");
    TuneGoal sum = known;
    sum.text = "mae + 2*acne";
    sum.terms.push_back({.weight = 2.0});
    EXPECT_EQ(cost_name(sum), "(mae + 2*acne) / default");
    EXPECT_NE(refusal([&] { relative_to(relative, {{0.2}, {0.0}}); }).find("without --relative"), std::string::npos);
  }
}

TEST(TuneGoal, Metrics_that_are_only_shown_are_no_objectives) {
  RunParams run;
  run.metrics = "edge-width,mae";
  const TuneGoal shown = with_metrics(goal("mae", {"acne<10%"}), run, "shadow");
  // mae and acne, then the width in pixels, texels and metres; mae only once.
  EXPECT_EQ(shown.columns.size(), 5u);
  EXPECT_EQ(objectives_of(shown), (std::vector<std::size_t>{0, 1}));
}

TEST(TuneBudget, Grows_with_the_combinations_of_words) {
  EXPECT_EQ(default_evaluations(0, 0, 1), 30u);
  EXPECT_EQ(default_evaluations(3, 3, 1), 90u);   // 30 · 3
  EXPECT_EQ(default_evaluations(3, 2, 6), 180u);  // 15 · 2 · 6
}

TEST(TuneGoal, Unknown_names_and_senseless_weights_are_refused) {
  EXPECT_NE(refusal([] { goal("acn"); }).find("did you mean 'acne'"), std::string::npos);
  EXPECT_NE(refusal([] { goal("ssim"); }).find("write -1*ssim"), std::string::npos);
  EXPECT_EQ(refusal([] { goal("-1*ssim"); }), "");
  EXPECT_NE(refusal([] { goal("ao.mae"); }).find("of kind ao"), std::string::npos);
  EXPECT_NE(refusal([] { goal("mae", {"shadow.resolution<3"}); }).find("not varied"), std::string::npos);
  EXPECT_NE(refusal([] { goal("mae", {"acne<3dB"}); }).find("acne is a share"), std::string::npos);
}

TEST(Minimize, Finds_the_lower_of_two_valleys_to_a_thousandth) {
  std::size_t calls = 0;
  // Least at (0.8, 0.3), with a wider but higher valley at (0.2, 0.7).
  const auto valleys = [&](const std::vector<double>& p) {
    ++calls;
    const auto distance = [&](double x, double y) { return std::hypot(p[0] - x, p[1] - y); };
    return std::min(distance(0.8, 0.3), 0.2 + 0.5 * distance(0.2, 0.7));
  };
  const std::vector<double> best = minimize({2, 80, 120, {0.2, 0.7}}, valleys);
  EXPECT_NEAR(best[0], 0.8, 1e-3);
  EXPECT_NEAR(best[1], 0.3, 1e-3);
  EXPECT_LE(calls, 210u);
}

TEST(Minimize, Passes_on_what_the_function_throws) {
  struct Stop {};
  std::size_t calls = 0;
  const auto function = [&](const std::vector<double>&) -> double {
    if (++calls == 5) throw Stop{};
    return 1.0;
  };
  EXPECT_THROW(minimize({1, 50, 50, {}}, function), Stop);
  EXPECT_EQ(calls, 5u);
}

TunePoint point(double acne, double mae) { return {{0.0}, {{mae, acne}}, {}}; }

TEST(TuneGoal, Column_whose_magnitude_is_bounded_is_shown_as_a_magnitude) {
  const TuneGoal bounded = goal("mae", {"|mean_error|<10%"});
  // mean of 0.3 and 0.1, and of −0.2 and 0.4 by magnitude
  const std::vector<CaseValues> cases = {{0.3, -0.2}, {0.1, 0.4}};
  EXPECT_DOUBLE_EQ(aggregate(bounded, 0, cases), 0.2);
  EXPECT_DOUBLE_EQ(aggregate(bounded, 1, cases), 0.3);
  EXPECT_EQ(shown_name(bounded, 0), "mae");
  EXPECT_EQ(shown_name(bounded, 1), "|mean_error|");
}

TEST(TuneGoal, The_worst_of_a_score_is_its_smallest_value) {
  const std::vector<CaseValues> cases = {{0.3, 0.8}, {0.1, 0.5}};
  const TuneGoal bounded = goal("mae", {"ssim>0.4"}, true);
  EXPECT_DOUBLE_EQ(aggregate(bounded, 0, cases), 0.3);
  EXPECT_DOUBLE_EQ(aggregate(bounded, 1, cases), 0.5);
  EXPECT_DOUBLE_EQ(aggregate(goal("-1*ssim", {}, true), 0, {{0.8}, {0.5}}), 0.5);
  RunParams run;
  run.metrics = "ssim";
  EXPECT_DOUBLE_EQ(aggregate(with_metrics(goal("mae", {}, true), run, "shadow"), 1, cases), 0.5);
}

TEST(ParetoFront, Of_a_score_that_is_both_minimised_and_bounded_more_is_better) {
  const TuneGoal score = goal("-1*ssim + mae", {"ssim>0.2"});
  const auto at = [](double ssim, double mae) { return TunePoint{{0.0}, {{ssim, mae}}, {}}; };
  const std::vector<TunePoint> front = pareto_front(score, {at(0.5, 0.1), at(0.9, 0.1), at(0.3, 0.05)});
  ASSERT_EQ(front.size(), 2u);
  EXPECT_DOUBLE_EQ(front[0].cases[0][0], 0.9);
  EXPECT_DOUBLE_EQ(front[1].cases[0][0], 0.3);
}

TEST(ParetoFront, Holds_the_points_of_which_none_is_better_in_both) {
  const TuneGoal both = goal("mae", {"acne<10%"});
  const std::vector<TunePoint> front =
      pareto_front(both, {point(0.3, 0.1), point(0.2, 0.2), point(0.3, 0.2), point(0.1, 0.3), point(0.1, 0.3)});
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].cases[0], (CaseValues{0.1, 0.3}));
  EXPECT_EQ(front[2].cases[0], (CaseValues{0.3, 0.1}));
}

TEST(CostDifference, Of_points_that_differ_alike_in_every_block_is_significant) {
  const TuneGoal mae = goal("mae");
  // One case of 20 blocks. b is worse by 0.1 whichever block is left out, although both vary by much more.
  LeftOutBlocks a(1), b(1), few(1);
  for (int i = 0; i < 20; ++i) {
    const double cost = i % 4 == 1 ? 0.9 : i % 4 == 2 ? 0.1 : 0.5;
    a[0].without.push_back({cost});
    b[0].without.push_back({cost + 0.1});
    if (i > 0) few[0].without.push_back({cost});
  }
  const std::optional<Estimate> difference = cost_difference(mae, {{0.5}}, a, {{0.6}}, b);
  ASSERT_TRUE(difference.has_value());
  EXPECT_NEAR(difference->value, -0.1, 1e-12);
  EXPECT_LT(difference->upper, 0.0);
  // Of one alone, with Student's t for 19 degrees of freedom: 2.093024 √(19/20 · 10 · 0.4²) = 2.580460
  const std::optional<Estimate> alone = cost_interval(mae, {{0.5}}, a);
  EXPECT_NEAR(alone->upper - alone->value, 2.580460, 1e-5);
  EXPECT_EQ(alone->lower, 0.0) << "no absolute error is negative";
  EXPECT_NEAR(cost_interval(goal("mean_error"), {{0.5}}, a)->lower, 0.5 - 2.580460, 1e-5);
  EXPECT_FALSE(cost_interval(mae, {{0.5}}, {{}}).has_value());
  EXPECT_FALSE(cost_interval(mae, {{0.5}}, few).has_value()) << "as in report";
  EXPECT_FALSE(cost_difference(mae, {{0.5}}, few, {{0.6}}, few).has_value());
}

TEST(CostDifference, Holds_costs_without_what_noise_may_have_added) {
  LeftOutBlocks exact(1);
  for (int i = 0; i < 20; ++i) exact[0].without.push_back({0.5 + 0.01 * (i % 3)});
  LeftOutBlocks noisy = exact;
  noisy.front().noise = {0.1};
  const auto expect = [&](const TuneGoal& of, double below, double above) {
    const Estimate before = *cost_difference(of, {{0.5}}, exact, {{0.5}}, exact);
    const Estimate of_first = *cost_difference(of, {{0.5}}, noisy, {{0.5}}, exact);
    EXPECT_NEAR(before.lower - of_first.lower, below, 1e-12);
    EXPECT_NEAR(of_first.upper - before.upper, above, 1e-12);
    const Estimate of_second = *cost_difference(of, {{0.5}}, exact, {{0.5}}, noisy);
    EXPECT_NEAR(before.lower - of_second.lower, above, 1e-12);
    EXPECT_NEAR(of_second.upper - before.upper, below, 1e-12);
    const Estimate alone = *cost_interval(of, {{0.5}}, noisy);
    EXPECT_NEAR(cost_interval(of, {{0.5}}, exact)->lower - alone.lower, below, 1e-12);
  };
  expect(goal("0.5*mae"), 0.05, 0.0);
  expect(goal("-2*mae"), 0.0, 0.2);
}

// Block k of the default costs k; the point costs 0.8 of that in every block, and so 0.8 of the default whichever
// pixels are counted.
TEST(CostDifference, Of_a_relative_goal_counts_multiples_of_the_default_without_the_same_block) {
  TuneGoal relative = goal("mae");
  relative.is_relative = true;
  relative = relative_to(relative, {{9.5}});
  LeftOutBlocks before(1), best(1);
  for (int k = 0; k < 20; ++k) {
    before[0].without.push_back({(190.0 - k) / 19.0});
    best[0].without.push_back({0.8 * (190.0 - k) / 19.0});
  }
  const Estimate exact = *cost_interval(relative, {{7.6}}, best, before);
  EXPECT_NEAR(exact.lower, 0.8, 1e-12);
  EXPECT_NEAR(exact.upper, 0.8, 1e-12);
  EXPECT_NEAR(cost_difference(relative, {{7.6}}, best, {{7.6}}, best, before)->upper, 0.0, 1e-12);
  // Up to 1.9 of the default's 9.5 may be noise: 7.6 of 7.6.
  before[0].noise = {1.9};
  const Estimate noisy = *cost_interval(relative, {{7.6}}, best, before);
  EXPECT_NEAR(noisy.lower, 0.8, 1e-12);
  EXPECT_NEAR(noisy.upper, 1.0, 1e-12);
  before[0].noise = {9.5};
  EXPECT_FALSE(cost_interval(relative, {{7.6}}, best, before).has_value()) << "the default may cost nothing";
}

// The cost of each block of a case is drawn uniformly from 0 to 1, but in most blocks there is little to measure:
// block k weighs 1 / (k + 1). The point b costs 0.9 of that, and up to 0.05 more by chance.
TEST(CostDifference, Has_an_interval_that_holds_it_95_times_in_100_for_few_blocks_and_for_many) {
  const TuneGoal mae = goal("mae");
  for (const auto& [cases, blocks] : {std::pair<std::size_t, std::size_t>{1, 24}, {1, 64}, {5, 16}}) {
    constexpr int draws = 400;
    int of_cost = 0;
    int of_difference = 0;
    int of_ratio = 0;
    for (std::uint32_t draw = 0; draw < draws; ++draw) {
      std::vector<CaseValues> a, b;
      LeftOutBlocks without_a, without_b;
      for (std::size_t c = 0; c < cases; ++c) {
        std::vector<double> weights, costs_a, costs_b;
        for (std::size_t k = 0; k < blocks; ++k) {
          const auto random = [&](std::uint32_t of) {
            return static_cast<double>(to_unit_float(hash(static_cast<std::uint32_t>(64 * c + k), draw, of)));
          };
          weights.push_back(1.0 / static_cast<double>(k + 1));
          costs_a.push_back(random(0));
          costs_b.push_back(0.9 * random(0) + 0.05 * random(1));
        }
        // Without no block: all.
        const auto mean = [&](const std::vector<double>& costs, std::size_t without) {
          double sum = 0.0;
          double weight = 0.0;
          for (std::size_t k = 0; k < blocks; ++k) {
            if (k == without) continue;
            sum += weights[k] * costs[k];
            weight += weights[k];
          }
          return CaseValues{sum / weight};
        };
        a.push_back(mean(costs_a, blocks));
        b.push_back(mean(costs_b, blocks));
        without_a.emplace_back();
        without_b.emplace_back();
        for (std::size_t k = 0; k < blocks; ++k) {
          without_a.back().without.push_back(mean(costs_a, k));
          without_b.back().without.push_back(mean(costs_b, k));
        }
      }
      const Estimate cost = *cost_interval(mae, a, without_a);
      of_cost += cost.lower <= 0.5 && 0.5 <= cost.upper ? 1 : 0;
      const Estimate difference = *cost_difference(mae, b, without_b, a, without_a);
      of_difference += difference.lower <= -0.025 && -0.025 <= difference.upper ? 1 : 0;
      TuneGoal relative = mae;
      relative.is_relative = true;
      const Estimate ratio = *cost_interval(relative_to(relative, a), b, without_b, without_a);
      of_ratio += ratio.lower <= 0.95 && 0.95 <= ratio.upper ? 1 : 0;
    }
    // 92 to 98 %; the standard error of a share of 400 draws is 1.1 %.
    for (const int held : {of_cost, of_difference, of_ratio}) {
      EXPECT_GE(held, 0.92 * draws) << cases << " cases, " << blocks << " blocks";
      EXPECT_LE(held, 0.98 * draws) << cases << " cases, " << blocks << " blocks";
    }
  }
}

TEST(TuneJournal, Is_read_back_to_the_bit_and_a_line_that_was_cut_off_is_ignored) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "journal";
  const std::vector<std::pair<std::string, std::string>> settings = {{"an axis", "a"}};
  const TuneRecord record{{0.1, std::int64_t{3}, std::string("box"), true}, {{1.0 / 3.0, std::nan("")}}};
  {
    TuneJournal journal(path, settings);
    journal.add("first", record);
    journal.add("second", record);
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 9);
  TuneJournal journal(path, settings);
  EXPECT_EQ(journal.count(), 1u);
  ASSERT_NE(journal.find("first"), nullptr);
  EXPECT_EQ(journal.find("first")->point, record.point);
  EXPECT_EQ(journal.find("first")->cases[0][0], 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(journal.find("first")->cases[0][1]));
  EXPECT_NE(refusal([&] { TuneJournal(path, {{"an axis", "b"}}); }).find("an axis differs"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
