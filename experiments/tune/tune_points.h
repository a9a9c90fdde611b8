// Measures the points of a tuning. A point has parts that can be measured apart: its cases, unless one pass measures
// every constant bias, where the best one is found over all cases.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/tune/tune_case.h"
#include "experiments/tune/tune_journal.h"
#include "experiments/tune/tune_search.h"

namespace umbrameter {

/// How the numbers of a point are laid out.
struct PointLayout {
  std::size_t cases = 0;
  std::size_t columns = 0;             ///< of the goal
  std::optional<std::size_t> exact{};  ///< SearchInput::exact

  std::size_t parts() const { return exact ? 1 : cases; }
  /// Of each part: the best constant bias, with an exact one, and the columns of its cases.
  std::size_t numbers() const { return exact ? 1 + cases * columns : columns; }
};

/// Puts the parts of a point together.
TuneRecord join_parts(const PointLayout& layout, const TuneQuery& query, const std::vector<std::vector<double>>& parts);

class PointMeasurer {
 public:
  /// What the arguments refer to must outlive this.
  PointMeasurer(const std::vector<TuneAxis>& axes, const std::vector<TuneCase>& cases, const TuneGoal& goal);

  const PointLayout& layout() const { return layout_; }
  /// The constant biases that one pass measures; empty without an exact bias.
  const std::vector<double>& constants() const { return constants_; }

  /// The numbers of one part. `goal` decides which constant bias is the best. Throws Error as measure_case() does, and
  /// (interrupted).
  std::vector<double> measure_part(const TuneQuery& query, std::size_t part, const TuneGoal& goal) const;
  TuneRecord measure(const TuneQuery& query, const TuneGoal& goal) const;
  /// The point at every constant bias, in one pass per case.
  std::vector<TunePoint> measure_curve(const std::vector<Value>& values, const TuneGoal& goal) const;

 private:
  const std::vector<TuneAxis>& axes_;
  const std::vector<TuneCase>& cases_;
  PointLayout layout_;
  std::vector<double> constants_;
};

}  // namespace umbrameter
