// A tuning in rounds, on functions whose values are known: the points and the answer of the search that measures one
// point after the other, in fewer rounds.
#include "experiments/tune/tune_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/error.h"
#include "experiments/settings/experiment.h"

namespace umbrameter {
namespace {

using Function = std::function<double(const std::vector<Value>&)>;

struct Tuning {
  std::vector<TuneAxis> axes{};
  TuneGoal goal{};
  Function cost{};
  std::vector<Value> given{};
  std::size_t evaluations = 0;

  SearchInput input() const { return {axes, goal, given, evaluations, std::nullopt}; }
  TuneRecord measure(const TuneQuery& query) const { return {query.values, {{cost(query.values)}}}; }
};

Tuning tuning_of(const std::vector<std::pair<const char*, const char*>>& axes, std::vector<Value> given,
                 Function cost) {
  Tuning tuning;
  Experiment experiment;
  for (const auto& [key, text] : axes) tuning.axes.push_back(parse_tune_axis(describe(experiment), key, text));
  tuning.goal = make_goal("mae", {}, "shadow", tuning.axes, false);
  tuning.given = std::move(given);
  tuning.cost = std::move(cost);
  return tuning;
}

struct InRounds {
  TuneResult result;
  std::size_t rounds = 0;
  std::size_t measured = 0;
  std::size_t used = 0;
};

InRounds tune_in_rounds(const Tuning& tuning, std::size_t wanted) {
  InRounds all;
  KnownPoints known;
  for (;;) {
    const NextRound round = next_round(tuning.input(), known, wanted);
    all.used = round.used;
    if (round.points.empty()) break;
    ++all.rounds;
    for (const TuneQuery& query : round.points) known[key_of(query, std::nullopt)] = tuning.measure(query);
  }
  all.measured = known.size();
  const AskPoint ask = [&](const TuneQuery& query, const TuneGoal& goal) {
    return scored(known.at(key_of(query, std::nullopt)), goal);
  };
  all.result = search_points(tuning.input(), ask);
  scan_axes(tuning.input(), all.result, ask);
  return all;
}

TuneResult tune_alone(const Tuning& tuning, std::size_t& measured) {
  const AskPoint ask = [&](const TuneQuery& query, const TuneGoal& goal) {
    ++measured;
    return scored(tuning.measure(query), goal);
  };
  TuneResult result = search_points(tuning.input(), ask);
  scan_axes(tuning.input(), result, ask);
  return result;
}

double bowl(double slope, double offset) {
  return 0.02 + 0.01 * std::pow(slope - 1.7, 2) + 0.05 * std::pow(offset - 0.63 - 0.1 * slope, 2);
}

const std::vector<std::pair<const char*, const char*>> two_numbers = {{"shadow.slope-bias", "0:4"},
                                                                      {"shadow.normal-offset", "0:2"}};

void expect_same(const std::vector<TunePoint>& points, const std::vector<TunePoint>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].values, expected[i].values) << i;
    EXPECT_EQ(points[i].cases, expected[i].cases) << i;
  }
}

// The same points in the same order, and no point that one search needs and the other does not.
InRounds expect_same_as_alone(const Tuning& tuning, std::size_t wanted) {
  std::size_t measured = 0;
  const TuneResult alone = tune_alone(tuning, measured);
  InRounds in_rounds = tune_in_rounds(tuning, wanted);
  expect_same(in_rounds.result.points, alone.points);
  EXPECT_EQ(in_rounds.result.best.values, alone.best.values);
  EXPECT_EQ(in_rounds.result.scans.size(), alone.scans.size());
  for (std::size_t a = 0; a < alone.scans.size(); ++a) {
    expect_same(in_rounds.result.scans[a].points, alone.scans[a].points);
  }
  EXPECT_EQ(in_rounds.used, measured);
  EXPECT_GE(in_rounds.measured, measured);
  return in_rounds;
}

TEST(TuneRounds, Along_an_axis_every_evaluated_point_counts_that_lies_on_it) {
  const Tuning tuning = tuning_of({two_numbers.front()}, {1.0},
                                  [](const std::vector<Value>& values) { return bowl(to_number(values[0]), 0.0); });
  std::size_t measured = 0;
  const TuneResult result = tune_alone(tuning, measured);
  std::set<double> expected;
  for (const TunePoint& point : result.points) expected.insert(to_number(point.values[0]));
  std::vector<double> scanned;
  for (const TunePoint& point : result.scans.front().points) scanned.push_back(to_number(point.values[0]));
  EXPECT_TRUE(std::ranges::is_sorted(scanned, std::less_equal<>()));
  EXPECT_TRUE(std::ranges::includes(scanned, expected));
  const std::vector<Value>& values = tuning.axes.front().axis.values;
  EXPECT_EQ(scanned.front(), to_number(values.front()))
      << "so that a range ends before a measured value or at the axis";
  EXPECT_EQ(scanned.back(), to_number(values.back()));
  EXPECT_GT(expected.size(), 20u);
}

// 60 evaluations, the default and 16 points along the axes: measured one after the other, 77 rounds.
TEST(TuneRounds, Of_two_numbers_are_few_and_hardly_any_of_their_points_is_wasted) {
  const Tuning tuning = tuning_of(two_numbers, {1.0, 0.0}, [](const std::vector<Value>& values) {
    return bowl(to_number(values[0]), to_number(values[1]));
  });
  const InRounds one = expect_same_as_alone(tuning, 1);
  EXPECT_EQ(one.used, 77u);
  EXPECT_LE(one.rounds, 36u);
  EXPECT_LE(one.measured, 79u) << "a round has only what is needed in any case";
  const InRounds eight = expect_same_as_alone(tuning, 8);
  EXPECT_LE(eight.rounds, 14u);
  EXPECT_LE(eight.measured, 99u);
}

TEST(TuneRounds, Of_a_rough_function_with_words_have_the_points_of_the_search_alone) {
  const std::vector<std::pair<const char*, const char*>> axes = {
      {"shadow.filter", "nearest,box,bilinear"}, two_numbers[0], two_numbers[1]};
  const Tuning tuning = tuning_of(axes, {std::string("nearest"), 1.0, 0.0}, [](const std::vector<Value>& values) {
    const double scale = to_string(values[0]) == "box" ? 0.5 : 1.0;
    return bowl(to_number(values[1]) / scale, to_number(values[2])) + 0.001 * std::sin(50.0 * to_number(values[1]));
  });
  const InRounds eight = expect_same_as_alone(tuning, 8);
  EXPECT_LE(eight.rounds, eight.used / 5);
}

// One pass measures every value: nothing is left to vary.
TEST(TuneRounds, Of_a_constant_bias_alone_are_one) {
  const Tuning tuning = tuning_of({{"shadow.constant-bias", "0.5texels:8texels:log"}}, {1.5},
                                  [](const std::vector<Value>& values) { return to_number(values[0]); });
  SearchInput input = tuning.input();
  input.exact = 0;
  KnownPoints known;
  const NextRound first = next_round(input, known, 4);
  ASSERT_GE(first.points.size(), 1u);
  EXPECT_LE(first.points.size(), 2u) << "the default, and all biases";
}

TEST(TuneRounds, Of_all_combinations_are_two_without_waste) {
  const Tuning tuning = tuning_of({{"shadow.filter", "nearest,box,bilinear"}, {"shadow.resolution", "256,512,1024"}},
                                  {std::string("nearest"), std::int64_t{512}},
                                  [](const std::vector<Value>& values) { return 1.0 / to_number(values[1]); });
  const InRounds all = expect_same_as_alone(tuning, 1);
  EXPECT_EQ(all.rounds, 2u) << "the search, then the axes around the best point";
  EXPECT_EQ(all.measured, all.used);
}

TEST(TuneRounds, Of_a_relative_cost_wait_for_nothing_but_fail_where_the_default_costs_nothing) {
  Tuning tuning = tuning_of(two_numbers, {1.0, 0.0}, [](const std::vector<Value>& values) {
    return bowl(to_number(values[0]), to_number(values[1]));
  });
  tuning.goal.is_relative = true;
  tuning.evaluations = 20;
  expect_same_as_alone(tuning, 4);
  tuning.cost = [](const std::vector<Value>&) { return 0.0; };
  EXPECT_THROW(tune_in_rounds(tuning, 4), Error);
}

TEST(TuneSearch, Few_evaluations_reach_every_word) {
  Tuning tuning = tuning_of(
      {{"shadow.filter", "nearest,bilinear,box"}, {"shadow.constant-bias", "0:8texels"}, {"shadow.slope-bias", "0:4"}},
      {std::string("nearest"), 1.5, 0.0}, [](const std::vector<Value>& values) {
        const double word = std::get<std::string>(values[0]) == "box" ? 0.0 : 1.0;
        return word + std::pow(to_number(values[1]) - 2.0, 2.0) + to_number(values[2]);
      });
  for (const std::size_t evaluations : {3u, 5u, 12u, 40u}) {
    tuning.evaluations = evaluations;
    std::size_t measured = 0;
    const TuneResult result = tune_alone(tuning, measured);
    std::set<std::string> words;
    for (const TunePoint& point : result.points) words.insert(std::get<std::string>(point.values[0]));
    EXPECT_EQ(words.size(), 3u) << evaluations;
    EXPECT_LE(result.evaluations, evaluations);
    EXPECT_LE(result.points.size(), evaluations + 4) << "better ones that the scans found";
  }
  tuning.evaluations = 2;
  std::size_t measured = 0;
  EXPECT_THROW(tune_alone(tuning, measured), Error);
}

// Two evaluations see nothing of the valley; the scans along the axes lead into it.
TEST(TuneSearch, A_better_point_that_a_scan_finds_is_the_best) {
  Tuning tuning = tuning_of({{"shadow.constant-bias", "0:8texels"}, {"shadow.slope-bias", "0:4"}}, {7.0, 3.5},
                            [](const std::vector<Value>& values) {
                              return 1.0 + std::pow(to_number(values[0]) - 2.0, 2.0) + to_number(values[1]);
                            });
  tuning.evaluations = 2;
  std::size_t measured = 0;
  const TuneResult result = tune_alone(tuning, measured);
  EXPECT_EQ(result.evaluations, 2u);
  EXPECT_EQ(result.points.back().values, result.best.values);
  EXPECT_LT(result.best.score.cost, 1.2);
  for (const AxisScan& scan : result.scans) {
    for (const TunePoint& point : scan.points) EXPECT_GE(point.score.cost, 0.999 * result.best.score.cost);
  }
}

}  // namespace
}  // namespace umbrameter
