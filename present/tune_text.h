// Numbers and points of a tuning as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "results/tune_results.h"

namespace umbrameter {

/// A value in its unit: shares in per cent.
std::string statistic_text(double value, const std::string& unit);

/// The unit of the cost: that of its statistics if they have one; "1" if the goal is relative; empty if they differ.
std::string cost_unit(const TuneGoal& goal);
/// The statistic that is minimised in words, "mean absolute error"; of several the sum as it was given.
std::string cost_words(const TuneGoal& goal);
/// A statistic of the goal in words; |…| where its magnitude counts.
std::string column_words(const TuneGoal& goal, std::size_t column);

/// ", the mean of 3 cases": which number of several cases is shown; nothing for one case. `is_of_two`: it is said of
/// two numbers, whose worst cases may differ.
std::string of_cases_text(const TuneGoal& goal, std::size_t cases, bool is_of_two = false);

/// The cost with its interval.
std::string cost_text(const TuneGoal& goal, double value, const std::optional<Estimate>& interval = {});

/// A difference of costs with its interval; of shares with `points` ("percentage points") as the unit.
std::string difference_text(const TuneGoal& goal, double value, const std::optional<Estimate>& interval,
                            const char* points);

/// How much more than the least cost is as good: "5 %", "3 wrong pixels", or of the mean of several cases
/// "0.0027 percentage points".
std::string tolerance_text(const TuneSummary& summary);

/// "constant-bias 2.4 texels, slope-bias 0.8".
std::string point_text(const std::vector<TuneAxis>& axes, const std::vector<Value>& values, int digits = 3);

/// Digits of the best point's values: more than three where its bias would else read as the recommended one, or as
/// outside its own range.
int digits_of_best(const TuneSummary& summary);
std::string value_text(const TuneAxis& axis, const Value& value, int digits = 3);

/// " (breaks a constraint)" or nothing.
std::string kept_text(const TuneGoal& goal, const TuneScore& score);

/// ": acne 0.0235 % in courtyard, camera overview, sun"; nothing where every constraint is kept.
std::string broken_text(const TuneGoal& goal, const TunePoint& point, const std::vector<std::string>& cases);
/// The cost, and what it breaks: "1.05 % (breaks the constraint: acne 0.783 % in courtyard, camera arcade, sun)".
std::string held_text(const TuneGoal& goal, const TunePoint& point, const std::vector<std::string>& cases);

}  // namespace umbrameter
