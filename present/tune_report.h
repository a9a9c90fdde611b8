// The result of a tuning as text, figures, a page section, a table and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "present/presentation.h"
#include "results/tune_results.h"

namespace umbrameter {

/// Points of which none is better in every objective: each statistic of the cost, and each constrained one. Ordered by
/// the first objective; one point where there is one objective.
std::vector<TunePoint> pareto_front(const TuneGoal& goal, const std::vector<TunePoint>& points);

/// Whether every evaluated point, the default included, has the same cost and keeps the constraints as well.
bool are_all_equal(const TuneResult& result);

/// Axes at whose end the best value lies, although the parameter could go on ("shadow.normal-offset: the best value 3
/// is the upper end of the axis; extend it"), then those of the summary.
std::vector<std::string> warnings_of(const TuneSummary& summary);

Presentation present_tuning(const TuneSummary& summary);

/// A row for each evaluated point: its values, cost, violation, then each statistic over the cases.
Table evaluation_table(const TuneSummary& summary);

nlohmann::ordered_json to_json(const TuneSummary& summary);

}  // namespace umbrameter
