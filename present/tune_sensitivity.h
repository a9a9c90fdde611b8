// How far each axis of a tuning may be from its best value.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/table.h"
#include "results/tune_results.h"

namespace umbrameter {

/// The connected range of an axis of numbers around its best value in which the cost is at most 5 % above the least: of
/// an exact constant bias from its whole curve, else between the measured values.
std::optional<std::pair<Value, Value>> range_within(const TuneSummary& summary, const AxisScan& scan);

/// Which ends of the axis a range reaches, where the axis could go on: "upper end of the axis". May be empty.
std::string ends_text(const TuneAxis& axis, const std::pair<Value, Value>& range);

/// Of points that were measured along the axes after the search, and are better than its best one: "ao.radius: the
/// search missed 1.33 m, ...", one line an axis.
std::vector<std::string> missed_points(const TuneSummary& summary);

/// Best value, range and highest cost of each axis.
Table sensitivity_table(const TuneSummary& summary);

}  // namespace umbrameter
