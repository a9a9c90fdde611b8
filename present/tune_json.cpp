#include <nlohmann/json.hpp>

#include "present/plateau_text.h"
#include "present/tune_comparison.h"
#include "present/tune_report.h"
#include "present/tune_sensitivity.h"
#include "present/tune_text.h"
#include "reports/files/value_json.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json estimate_json(const std::optional<Estimate>& estimate) {
  if (!estimate) return nullptr;
  const bool is_significant = estimate->lower > 0.0 || estimate->upper < 0.0;
  return {
      {"value", estimate->value}, {"lo", estimate->lower}, {"hi", estimate->upper}, {"significant", is_significant}};
}

Json values_json(const TuneSummary& summary, const std::vector<Value>& values) {
  Json object = Json::object();
  for (std::size_t a = 0; a < summary.axes.size(); ++a) object[summary.axes[a].key()] = to_json(values[a]);
  return object;
}

Json cases_json(const TuneSummary& summary, const std::vector<std::string>& cases, const TunePoint& point) {
  Json list = Json::array();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    Json object = {{"case", cases[c]}};
    for (std::size_t k = 0; k < summary.goal.columns.size(); ++k) {
      object[summary.goal.columns[k].name] = point.cases[c][k];
    }
    list.push_back(std::move(object));
  }
  return list;
}

Json point_json(const TuneSummary& summary, const std::vector<std::string>& cases, const TunePoint& point) {
  return {{"values", values_json(summary, point.values)},
          {"cost", point.score.cost},
          {"keeps_constraints", point.score.is_kept()},
          {"violation", point.score.violation},
          {"cases", cases_json(summary, cases, point)}};
}

Json compared_json(const TuneSummary& summary) {
  Json list = Json::array();
  for (const ComparedPoint& compared : summary.judgement.compared) {
    Json object = {{"name", title_of(summary, compared)},
                   {"values", values_json(summary, compared.point.values)},
                   {"cost", compared.point.score.cost},
                   {"keeps_constraints", compared.point.score.is_kept()},
                   {"minus_best", estimate_json(compared.difference)},
                   {"statistics", Json::object()}};
    const std::vector<double> values = shown_values(summary, compared);
    for (std::size_t c = 0; c < values.size(); ++c) object["statistics"][summary.shown.columns[c].name] = values[c];
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace

Table evaluation_table(const TuneSummary& summary) {
  Table table{{{"evaluation", "1", "number, in order"}}, {}};
  for (const TuneAxis& axis : summary.axes) table.columns.push_back({axis.key(), axis.axis.unit, "value"});
  table.columns.push_back({"cost", cost_unit(summary.goal), cost_name(summary.goal)});
  table.columns.push_back({"violation", "1", "relative excess over the constraints, summed; 0 if all are kept"});
  for (std::size_t c = 0; c < summary.cases.size(); ++c) {
    for (const Column& column : summary.goal.columns) {
      table.columns.push_back(
          {column.name + "_" + std::to_string(c), column.unit, column.meaning + ": " + summary.cases[c]});
    }
  }
  std::int64_t number = 0;
  for (const TunePoint& point : summary.result.points) {
    std::vector<Value>& row = table.rows.emplace_back();
    row.emplace_back(++number);
    row.insert(row.end(), point.values.begin(), point.values.end());
    row.emplace_back(point.score.cost);
    row.emplace_back(point.score.violation);
    for (const CaseValues& values : point.cases) row.insert(row.end(), values.begin(), values.end());
  }
  return table;
}

Json to_json(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  Json json;
  json["minimized"] = cost_name(summary.goal);
  json["over_cases"] = summary.goal.is_worst_case ? "worst" : "mean";
  json["constraints"] = Json::array();
  for (const TuneConstraint& constraint : summary.goal.constraints) {
    json["constraints"].push_back(constraint.condition.text);
  }
  json["axes"] = Json::object();
  for (const TuneAxis& axis : summary.axes) {
    json["axes"][axis.key()] = {{"text", axis.axis.text}, {"unit", axis.axis.unit}};
  }
  json["method"] = result.method;
  json["evaluations"] = result.evaluations;
  json["stopped_by"] = result.stopped_by.empty() ? Json(nullptr) : Json(result.stopped_by);
  json["best"] = point_json(summary, summary.cases, result.best);
  json["best"]["cost_95"] = estimate_json(summary.judgement.best);
  json["default"] = point_json(summary, summary.cases, result.before);
  json["best_minus_default"] = estimate_json(summary.judgement.against_before);
  if (result.plateau) {
    add_plateau(json["recommended_bias"], *result.plateau, result.evidence, result.withheld, [](const BiasCell& cell) {
      return Json{{"constant_bias", cell.constant}, {"cost", cell.mae}, {"acne", cell.acne}};
    });
  }
  if (result.recommended) json["recommended"] = point_json(summary, summary.cases, *result.recommended);
  if (result.runner_up) {
    json["runner_up"] = point_json(summary, summary.cases, *result.runner_up);
    json["best_minus_runner_up"] = estimate_json(summary.judgement.against_runner_up);
  }
  if (const std::optional<HeldOut>& held = summary.judgement.held_out) {
    json["held_out"] = {{"default", point_json(summary, held->cases, held->before)},
                        {"best", point_json(summary, held->cases, held->best)},
                        {"best_minus_default", estimate_json(held->difference)}};
    if (held->recommended) {
      json["held_out"]["recommended"] = point_json(summary, held->cases, *held->recommended);
      json["held_out"]["recommended_minus_default"] = estimate_json(held->recommended_difference);
    }
  }
  json["compared"] = compared_json(summary);
  json["sensitivity"] = Json::array();
  for (const AxisScan& scan : result.scans) {
    Json points = Json::array();
    for (const TunePoint& point : scan.points) {
      points.push_back({to_json(point.values[scan.axis]), point.score.cost, point.score.is_kept()});
    }
    Json within = nullptr;
    if (const auto range = range_within(summary, scan))
      within = Json::array({to_json(range->first), to_json(range->second)});
    json["sensitivity"].push_back({{"parameter", summary.axes[scan.axis].key()},
                                   {"within_5_percent", std::move(within)},
                                   {"value_cost_kept", std::move(points)}});
  }
  std::vector<TunePoint> candidates = result.points;
  candidates.insert(candidates.end(), result.curve.begin(), result.curve.end());
  json["pareto_front"] = Json::array();
  for (const TunePoint& point : pareto_front(summary.goal, candidates)) {
    Json object = {{"values", values_json(summary, point.values)}};
    for (std::size_t k = 0; k < summary.goal.columns.size(); ++k) {
      object[summary.goal.columns[k].name] = aggregate(summary.goal, k, point.cases);
    }
    json["pareto_front"].push_back(std::move(object));
  }
  json["warnings"] = warnings_of(summary);
  return json;
}

}  // namespace umbrameter
