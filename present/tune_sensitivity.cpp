#include "present/tune_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "present/axis_ends.h"
#include "present/plateau_text.h"
#include "present/tune_text.h"

namespace umbrameter {
namespace {

// "0.833 to 1.66 texels", and "0.833 cm to 1.66 m" where units differ.
std::string pair_text(const TuneAxis& axis, const Value& a, const Value& b, const char* between, int digits = 3) {
  std::string first = value_text(axis, a, digits);
  const std::string second = value_text(axis, b, digits);
  const std::size_t unit = first.find(' ');
  if (unit != std::string::npos && second.ends_with(first.substr(unit))) first.resize(unit);
  return first + between + second;
}

// The measured values next to the range: " (the next measured values, 0.0841 and 0.484 texels, are outside)".
std::string outside_text(const TuneSummary& summary, const AxisScan& scan, const std::pair<Value, Value>& range) {
  const TuneAxis& axis = summary.axes[scan.axis];
  const bool is_exact = summary.result.plateau && axis.key() == constant_bias_key;
  if (is_exact || (!axis.is_continuous && scan.points.size() >= axis.count())) return {};
  std::optional<Value> below, above;
  for (const TunePoint& point : scan.points) {
    const Value& value = point.values[scan.axis];
    if (to_number(value) < to_number(range.first)) below = value;
    if (to_number(value) > to_number(range.second) && !above) above = value;
  }
  if (!below && !above) return {};
  if (below && above)
    return fmt::format(" (the next measured values, {}, are outside)", pair_text(axis, *below, *above, " and "));
  return fmt::format(" (the next measured value, {}, is outside)", value_text(axis, below ? *below : *above));
}

std::string good_values_text(const TuneSummary& summary, const AxisScan& scan) {
  const TuneAxis& axis = summary.axes[scan.axis];
  if (axis.is_word() && summary.result.best.score.is_kept()) {
    std::string words;
    for (const TunePoint& point : scan.points) {
      if (!point.score.is_kept() || !(point.score.cost <= summary.result.limit.error)) continue;
      words += (words.empty() ? "" : ", ") + value_text(axis, point.values[scan.axis]);
    }
    return words.empty() ? "—" : words;
  }
  const auto range = range_within(summary, scan);
  if (!range) return "—";
  std::string ends = ends_text(axis, *range);
  if (!ends.empty()) ends = " (" + ends + ")";
  const std::optional<BiasPlateau>& plateau = summary.result.plateau;
  const std::string outside = outside_text(summary, scan, *range);
  if (range->first == range->second)
    return (!outside.empty()     ? ""
            : axis.is_continuous ? "only "
                                 : "of the axis only ") +
           value_text(axis, range->first) + ends + outside;
  const bool is_exact = plateau && axis.key() == constant_bias_key && axis.is_continuous;
  if (!is_exact) return pair_text(axis, range->first, range->second, " to ") + ends + outside;
  const RoundedRange good = rounded_inwards(plateau->first.constant, plateau->last.constant, plateau->least.constant);
  return pair_text(axis, good.first, good.last, " to ", good.digits) + ends + outside;
}

// The largest cost along the axis, in multiples of the least.
std::string worst_text(const TuneSummary& summary, const AxisScan& scan) {
  double worst = summary.result.best.score.cost;
  for (const TunePoint& point : scan.points) {
    if (std::isfinite(point.score.cost)) worst = std::max(worst, point.score.cost);
  }
  return cost_text(summary.goal, worst);
}

}  // namespace

std::string ends_text(const TuneAxis& axis, const std::pair<Value, Value>& range) {
  Experiment experiment;
  const Parameters parameters = describe(experiment);
  const std::vector<double> values = mapped(axis.axis.values, [](const Value& each) { return to_number(each); });
  std::vector<std::string> ends;
  for (const Value& value : {range.first, range.second}) {
    const AxisEnd end = end_of(values, to_number(value), require(parameters, axis.key()));
    if (end != AxisEnd::none) ends.emplace_back(end == AxisEnd::lower ? "lower" : "upper");
  }
  if (ends.empty()) return {};
  return ends.size() > 1 && ends[0] != ends[1] ? "both ends of the axis" : ends[0] + " end of the axis";
}

std::optional<std::pair<Value, Value>> range_within(const TuneSummary& summary, const AxisScan& scan) {
  const TuneAxis& axis = summary.axes[scan.axis];
  if (axis.is_word() || scan.points.empty() || !summary.result.best.score.is_kept()) return std::nullopt;
  const std::optional<BiasPlateau>& plateau = summary.result.plateau;
  if (plateau && axis.key() == constant_bias_key)
    return std::pair<Value, Value>{plateau->first.constant, plateau->last.constant};
  std::vector<double> costs;
  std::size_t inside = 0;
  for (const TunePoint& point : scan.points) {
    if (point.values[scan.axis] == summary.result.best.values[scan.axis]) inside = costs.size();
    costs.push_back(point.score.is_kept() ? point.score.cost : std::numeric_limits<double>::infinity());
  }
  const ConnectedRange range = connected_range(costs, inside, summary.result.limit.error);
  return std::pair{scan.points[range.first].values[scan.axis], scan.points[range.last].values[scan.axis]};
}

std::vector<std::string> missed_points(const TuneSummary& summary) {
  std::vector<std::string> lines;
  for (const AxisScan& scan : summary.result.scans) {
    const auto least = std::ranges::min_element(scan.points, is_better, &TunePoint::score);
    const TuneScore& best = summary.result.best.score;
    if (least == scan.points.end() || !is_better(least->score, best)) continue;
    const bool reads_alike = cost_text(summary.goal, least->score.cost) == cost_text(summary.goal, best.cost);
    if (reads_alike && least->score.violation == best.violation) continue;
    const TuneAxis& axis = summary.axes[scan.axis];
    const std::string value = value_text(axis, least->values[scan.axis]);
    lines.push_back(fmt::format(
        "{0}: the search missed {1}, measured after it with the other values of the best point: {2}; give it more "
        "--evaluations, or a shorter axis around {1}",
        axis.key(), value, cost_text(summary.goal, least->score.cost)));
  }
  return lines;
}

Table sensitivity_table(const TuneSummary& summary) {
  Table table{
      {{"varied alone", "", "this parameter; the others keep their best values"},
       {"axis", "", "values that were allowed"},
       {"best", "", "value of least cost"},
       {"within " + tolerance_text(summary) + (summary.goal.constraints.empty() ? "" : ", constraints kept"), "",
        "range around the best value in which the cost is at most this much above the least" +
            (summary.result.limit.is_by_pixels
                 ? fmt::format(" ({} of all counted pixels, which is more than 5 %)", chance_pixels)
                 : std::string()) +
            ". If a row gives next measured values, each true end lies between the printed end and the next measured "
            "value; "
            "if it gives none, the printed ends are exact" +
            (summary.goal.constraints.empty() ? "" : ". Values that break a constraint are outside")},
       {"highest cost", "", "cost on the measured values of the axis, the others as in the best point"}},
      {}};
  for (const AxisScan& scan : summary.result.scans) {
    const TuneAxis& axis = summary.axes[scan.axis];
    table.rows.push_back({axis.key(), axis.axis.text,
                          value_text(axis, summary.result.best.values[scan.axis], digits_of_best(summary)),
                          good_values_text(summary, scan), worst_text(summary, scan)});
  }
  return table;
}

}  // namespace umbrameter
