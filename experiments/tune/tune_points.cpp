#include "experiments/tune/tune_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/interrupt.h"

namespace umbrameter {
namespace {

// Both hold every value of the evenly spaced axes of 1,000 and of 1,001 values, so that the least cost on these is
// never missed.
std::vector<double> dense_values(const Parameters& parameters, const TuneAxis& axis) {
  std::vector<double> values;
  if (!axis.is_continuous) {
    for (const Value& value : axis.axis.values) values.push_back(to_number(value));
    return values;
  }
  const std::string ends = axis.is_logarithmic ? axis.axis.text.substr(0, axis.axis.text.size() - 4) : axis.axis.text;
  for (const int count : {8 * 999 + 1, 8 * 1000 + 1}) {
    const std::string text = fmt::format("{}:{}{}", ends, count, axis.is_logarithmic ? ":log" : "");
    for (const Value& value : parse_axis(parameters, axis.key(), text).values) values.push_back(to_number(value));
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// The middle of the first run of equally good points: the farthest from what is worse on either side.
const TunePoint& best_of(const std::vector<TunePoint>& curve) {
  std::size_t first = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (is_better(curve[i].score, curve[first].score)) first = i;
  }
  std::size_t last = first;
  while (last + 1 < curve.size() && !is_better(curve[first].score, curve[last + 1].score)) ++last;
  return curve[first + (last - first) / 2];
}

}  // namespace

TuneRecord join_parts(const PointLayout& layout, const TuneQuery& query,
                      const std::vector<std::vector<double>>& parts) {
  TuneRecord record{query.values, {}};
  for (const std::vector<double>& part : parts) {
    auto number = part.begin();
    if (layout.exact) {
      if (query.kind == TuneQuery::Kind::point) record.point[*layout.exact] = *number;
      ++number;
    }
    for (; number != part.end(); number += static_cast<std::ptrdiff_t>(layout.columns)) {
      record.cases.emplace_back(number, number + static_cast<std::ptrdiff_t>(layout.columns));
    }
  }
  return record;
}

PointMeasurer::PointMeasurer(const std::vector<TuneAxis>& axes, const std::vector<TuneCase>& cases,
                             const TuneGoal& goal)
    : axes_(axes), cases_(cases), layout_{cases.size(), goal.columns.size(), std::nullopt} {
  const bool is_exact =
      std::ranges::all_of(cases, [&](const TuneCase& each) { return has_exact_bias(each, axes, goal); });
  const auto found = std::ranges::find(axes, constant_bias_key, &TuneAxis::key);
  if (!is_exact || found == axes.end()) return;
  layout_.exact = static_cast<std::size_t>(found - axes.begin());
  Experiment experiment;
  constants_ = dense_values(describe(experiment), *found);
}

std::vector<double> PointMeasurer::measure_part(const TuneQuery& query, std::size_t part, const TuneGoal& goal) const {
  if (layout_.exact && query.kind == TuneQuery::Kind::point) {
    const std::vector<TunePoint> curve = measure_curve(query.values, goal);
    const TunePoint& best = best_of(curve);
    std::vector<double> numbers = {to_number(best.values[*layout_.exact])};
    for (const CaseValues& values : best.cases) numbers.insert(numbers.end(), values.begin(), values.end());
    return numbers;
  }
  std::vector<double> numbers;
  if (layout_.exact) numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  const std::size_t count = layout_.exact ? cases_.size() : 1;
  for (std::size_t c = part; c < part + count; ++c) {
    throw_if_interrupted();
    const TuneCase& of = cases_[c];
    const bool is_given = query.kind == TuneQuery::Kind::before;
    const CaseValues values = measure_case(of, is_given ? of.experiment : at_point(of, axes_, query.values), goal);
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  return numbers;
}

TuneRecord PointMeasurer::measure(const TuneQuery& query, const TuneGoal& goal) const {
  std::vector<std::vector<double>> parts;
  for (std::size_t part = 0; part < layout_.parts(); ++part) parts.push_back(measure_part(query, part, goal));
  return join_parts(layout_, query, parts);
}

std::vector<TunePoint> PointMeasurer::measure_curve(const std::vector<Value>& values, const TuneGoal& goal) const {
  std::vector<TunePoint> curve(constants_.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve[i].values = values;
    curve[i].values[*layout_.exact] = constants_[i];
  }
  for (const TuneCase& each : cases_) {
    throw_if_interrupted();
    const Experiment experiment = at_point(each, axes_, curve.front().values);
    std::vector<CaseValues> measured = measure_biases_of(each, experiment, goal, constants_);
    for (std::size_t i = 0; i < curve.size(); ++i) curve[i].cases.push_back(std::move(measured[i]));
  }
  for (TunePoint& point : curve) point.score = score_of(goal, point.values, point.cases);
  return curve;
}

}  // namespace umbrameter
