// The search of a tuning as a function of the values that it is given: which points it asks for, in which order, and
// the best of them. It measures nothing, so that it can be repeated on values that were measured elsewhere.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "results/tune_results.h"

namespace umbrameter {

/// A point whose value the search needs.
struct TuneQuery {
  enum class Kind {
    before,  ///< the experiments as given; their values may lie outside the axes
    point,   ///< of the search
    scan,    ///< along one axis from the best point
  };
  Kind kind = Kind::point;
  std::vector<Value> values{};  ///< of each axis
};

struct SearchInput {
  const std::vector<TuneAxis>& axes;
  const TuneGoal& goal;
  std::vector<Value> given{};          ///< the experiments' value of each axis, in its unit: where the search starts
  std::size_t evaluations = 0;         ///< max number of points; 0: default_evaluations()
  std::optional<std::size_t> exact{};  ///< axis of the constant bias, if each point is measured at all its values
};

/// Identifies a query. Of a point with an exact bias, that value is left out: the answer has the best one.
std::string key_of(const TuneQuery& query, std::optional<std::size_t> exact);

/// Answers a query. A relative goal has the default's costs once the first query, of the default, is answered.
using AskPoint = std::function<TunePoint(const TuneQuery& query, const TuneGoal& goal)>;

/// What AskPoint throws to end the search: what was found until then is its result.
struct SearchEnd {
  std::string stopped_by{};  ///< "2 minutes"
};

/// Evaluations so far, how many there will be at most, and the best so far.
using TuneProgress = std::function<void(std::size_t done, std::size_t all, const TuneScore& best)>;

/// 30 for each axis that is searched, and at least 15 for each axis of numbers in each combination of words.
std::size_t default_evaluations(std::size_t axes, std::size_t axes_of_numbers, std::size_t combinations_of_words);

/// Asks for the default and the points of the search: goal, points, best, before, method, evaluations. Deterministic.
/// Throws Error (usage) if no point can be measured, and what `ask` throws.
TuneResult search_points(const SearchInput& input, const AskPoint& ask, const TuneProgress& progress = {});

/// Asks for points along each axis but the exact one, from the best point: scans. The search may have missed one that
/// is better: it is then the best point, and the axes are scanned from there.
void scan_axes(const SearchInput& input, TuneResult& result, const AskPoint& ask);

}  // namespace umbrameter
