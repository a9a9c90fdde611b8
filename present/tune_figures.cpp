#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <set>
#include <utility>

#include "present/plot_axes.h"
#include "present/presentation_parts.h"
#include "present/tune_text.h"

namespace umbrameter {
namespace {

double shown(const TuneGoal& goal, double cost) { return cost_unit(goal) == "1" ? 100.0 * cost : cost; }

std::string cost_label(const TuneGoal& goal) {
  const std::string unit = cost_unit(goal) == "1" ? "%" : cost_unit(goal);
  return fmt::format("{}{}{}", cost_words(goal), goal.is_worst_case ? ", worst case" : "",
                     unit.empty() ? "" : " [" + unit + "]");
}

std::vector<Figure> figures_of(const SceneFacts& scene, const Measurement& measurement) {
  const LayeredImage& layers = measurement.layers;
  if (measurement.ao) return present_ao(layers, *measurement.ao).figures;
  if (measurement.image) return present_image(scene, layers, *measurement.image).figures;
  return present_shadow(scene, layers, measurement.shadows.front()).figures;
}

}  // namespace

PlotFigure scan_figure(const TuneSummary& summary, const AxisScan& scan) {
  const TuneAxis& axis = summary.axes[scan.axis];
  PlotFigure plot;
  plot.stem = fmt::format("cost_{}", scan.axis);
  plot.title = "Cost along " + axis.key();
  plot.caption = summary.axes.size() > 1 ? "The other parameters have their best values. The ring is the best point."
                                         : "The ring is the best point.";
  plot.x = {"value", label_of(axis.axis), axis.is_logarithmic};
  plot.x.round_ticks = axis.is_continuous;
  plot.y = {"cost", cost_label(summary.goal)};
  plot.mark = "best";
  plot.data.columns = {{"value", axis.axis.unit, "value"}, {"cost", "1", "cost"}, {"best", "", "best point"}};
  const auto add = [&](const TunePoint& point, bool is_best) {
    plot.data.rows.push_back({to_number(point.values[scan.axis]), shown(summary.goal, point.score.cost), is_best});
  };
  for (const TunePoint& point : scan.points) add(point, false);
  add(summary.result.best, true);
  // Where the ends of the axis cost many times as much, the costs near the best would lie on the zero line.
  constexpr double large_ratio = 20.0;
  const auto [least, most] = std::ranges::minmax(
      plot.data.rows | std::views::transform([](const std::vector<Value>& row) { return to_number(row[1]); }));
  plot.y.logarithmic = least > 0.0 && std::isfinite(most) && most > large_ratio * least;
  return plot;
}

PlotFigure search_figure(const TuneSummary& summary) {
  const auto words = std::ranges::find_if(summary.axes, [](const TuneAxis& axis) { return axis.is_word(); });
  const bool has_words = words != summary.axes.end();
  const auto axis = static_cast<std::size_t>(words - summary.axes.begin());
  PlotFigure plot;
  plot.stem = "search";
  plot.title = "Least cost during the search";
  plot.caption = fmt::format("The least cost so far, after each evaluation{}.{}",
                             has_words ? " with the same " + words->key() : "",
                             summary.goal.constraints.empty() ? "" : " Points that break a constraint do not count.");
  plot.x = {"evaluation", "evaluation"};
  plot.y = {"cost", cost_label(summary.goal)};
  plot.data.columns = {{"evaluation", "1", "number"}, {"cost", "1", "least cost so far"}, {"word", "", "value"}};
  if (has_words) {
    plot.series = "word";
    plot.series_label = words->key().substr(words->key().find('.') + 1);
  }
  struct Search {
    std::int64_t number = 0;
    std::optional<TuneScore> best{};
  };
  std::map<std::string, Search> by_word;
  for (const TunePoint& point : summary.result.points) {
    const std::string word = has_words ? to_string(point.values[axis]) : "";
    Search& progress = by_word[word];
    ++progress.number;
    if (!progress.best || is_better(point.score, *progress.best)) progress.best = point.score;
    if (progress.best->is_kept()) {
      plot.data.rows.push_back({progress.number, shown(summary.goal, progress.best->cost), word});
    }
  }
  return plot;
}

ReportTable front_table(const TuneSummary& summary, const std::vector<TunePoint>& front) {
  Table table;
  for (const TuneAxis& axis : summary.axes) table.columns.push_back({axis.key(), "", "value"});
  for (const std::size_t c : objectives_of(summary.goal)) {
    table.columns.push_back({column_words(summary.goal, c) + of_cases_text(summary.goal, summary.cases.size()), "",
                             summary.goal.columns[c].meaning});
  }
  constexpr std::size_t max_rows = 30;
  const std::vector<std::size_t> thinned = thin(front.size(), max_rows).indices;
  std::set<std::size_t> shown(thinned.begin(), thinned.end());
  const auto best = std::ranges::find(front, summary.result.best.values, &TunePoint::values);
  if (best != front.end()) shown.insert(static_cast<std::size_t>(best - front.begin()));
  for (const std::size_t i : shown) {
    std::vector<Value> row;
    for (std::size_t a = 0; a < summary.axes.size(); ++a) {
      row.emplace_back(value_text(summary.axes[a], front[i].values[a]));
    }
    for (const std::size_t c : objectives_of(summary.goal)) {
      row.emplace_back(statistic_text(aggregate(summary.goal, c, front[i].cases), summary.goal.columns[c].unit));
    }
    table.rows.push_back(std::move(row));
  }
  ReportTable report{"Pareto front", std::move(table)};
  if (shown.size() < front.size()) {
    report.remarks.push_back(fmt::format("{} of the front's {} points{}; summary.json has all.", shown.size(),
                                         front.size(), best != front.end() ? ", the best one among them" : ""));
  }
  return report;
}

PlotFigure front_figure(const TuneSummary& summary, const std::vector<TunePoint>& front) {
  const TuneGoal& goal = summary.goal;
  const std::vector<std::size_t> objectives = objectives_of(goal);
  const Column& x = goal.columns[objectives[0]];
  const Column& y = goal.columns[objectives[1]];
  const auto label = [&](std::size_t column) {
    const std::string& unit = goal.columns[column].unit;
    return fmt::format("{}{} [{}]", column_words(goal, column), of_cases_text(goal, summary.cases.size()),
                       unit == "1" ? "%" : unit);
  };
  const auto number = [](const Column& column, double value) { return column.unit == "1" ? 100.0 * value : value; };
  PlotFigure plot;
  plot.stem = "pareto_front";
  plot.title = "Pareto front";
  plot.caption = fmt::format(
      "Points that no other point beats in every objective: {} against {}. The ring is the best point by the cost and "
      "the "
      "constraints.",
      column_words(goal, objectives[1]), column_words(goal, objectives[0]));
  if (!goal.constraints.empty() && summary.cases.size() > 1 && !goal.is_worst_case) {
    plot.caption += " A point whose mean keeps a constraint may break it in a case.";
  }
  plot.x = {"x", label(objectives[0])};
  plot.y = {"y", label(objectives[1])};
  plot.mark = "best";
  plot.data.columns = {{"x", "1", x.meaning}, {"y", "1", y.meaning}, {"best", "", "best point"}};
  const auto add = [&](const TunePoint& point, bool best) {
    plot.data.rows.push_back({number(x, aggregate(goal, objectives[0], point.cases)),
                              number(y, aggregate(goal, objectives[1], point.cases)), best});
  };
  for (const TunePoint& point : front) add(point, false);
  add(summary.result.best, true);
  return plot;
}

std::string stem_prefix(const TunePointImages& point) { return point.name + "_"; }

ViewerPack add_tune_images(Presentation& part, const SceneFacts& scene, const TuneFindings& tune) {
  ViewerPack pack;
  pack.title = tune.summary.result.recommended ? "Recommended, best and default point" : "Best and default point";
  const std::string& title = tune.summary.cases.front();
  for (const TunePointImages& point : tune.points) {
    ViewerData data = viewer_data(scene, point.measurement, false);
    data.title = fmt::format("{}: {}; {}", point.name, point.values, title);
    add_set(pack, data);
    for (Figure& image : figures_of(scene, point.measurement)) {
      FigureHead& figure = head_of(image);
      // All points have the same reference.
      if (figure.stem.starts_with("truth_") && &point != &tune.points.front()) continue;
      figure.stem = stem_prefix(point) + figure.stem;
      figure.caption += fmt::format(" The {} point in {}.", point.name, title);
      pack.layers.insert(figure.stem);
      add_figure(part, std::move(image));
    }
  }
  return pack;
}

}  // namespace umbrameter
