#include "present/tune_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "present/tune_text.h"

namespace umbrameter {
namespace {

std::string name_of(const TuneAxis& axis) { return axis.key().substr(axis.key().find('.') + 1); }

// Where the cost is one statistic, its column is the cost's.
bool is_the_cost(const TuneGoal& goal, std::size_t column) {
  return !goal.is_relative && goal.terms.size() == 1 && goal.terms.front().column == column &&
         goal.terms.front().weight == 1.0;
}

std::string distance_text(const TuneGoal& goal, const ComparedPoint& compared, double best) {
  if (compared.is_best) return "best";
  if (compared.point.score.cost == best) return "the same cost";
  const std::string text =
      difference_text(goal, compared.point.score.cost - best, compared.difference, "percentage points");
  if (!compared.difference) return text + ", not tested";
  if (compared.difference->lower > 0.0) return text + ", worse";
  return text + (compared.difference->upper < 0.0 ? ", better" : ", not significant");
}

}  // namespace

std::string title_of(const TuneSummary& summary, const ComparedPoint& compared) {
  if (!compared.axis) return compared.is_best ? "best" : "default";
  const TuneAxis& axis = summary.axes[*compared.axis];
  return fmt::format("{} {}", name_of(axis), value_text(axis, compared.point.values[*compared.axis]));
}

std::vector<double> shown_values(const TuneSummary& summary, const ComparedPoint& compared) {
  std::vector<double> values;
  for (std::size_t c = 0; c < summary.shown.columns.size(); ++c) {
    values.push_back(aggregate(summary.shown, c, compared.shown));
  }
  return values;
}

bool reads(const TuneSummary& summary, const ComparedPoint& compared, std::size_t axis) {
  return std::ranges::none_of(summary.result.of_words, [&](const WordPoint& word) {
    return compared.axis == word.axis && compared.point.values == word.point.values &&
           std::ranges::find(word.unread, summary.axes[axis].key()) != word.unread.end();
  });
}

Table comparison_table(const TuneSummary& summary) {
  const TuneGoal& goal = summary.goal;
  Table table{{{"point", "", "the default, or the best point with this value"},
               {cost_words(goal), "", "cost"},
               {"more than the best", "",
                "difference of the costs, paired over blocks of pixels; of shares in percentage points"}},
              {}};
  if (!goal.constraints.empty()) table.columns.push_back({"constraints", "", "whether all are kept in every case"});
  std::vector<std::size_t> shown;
  for (std::size_t c = 0; c < summary.shown.columns.size(); ++c) {
    const Column& column = summary.shown.columns[c];
    if (is_the_cost(goal, c)) continue;
    shown.push_back(c);
    table.columns.push_back(
        {column_words(summary.shown, c) + of_cases_text(summary.shown, summary.cases.size()), "", column.meaning});
  }
  for (const TuneAxis& axis : summary.axes)
    table.columns.push_back({name_of(axis), "", "value; a dash: it is not read"});
  for (const ComparedPoint& compared : summary.judgement.compared) {
    std::vector<Value> row = {title_of(summary, compared), cost_text(goal, compared.point.score.cost),
                              distance_text(goal, compared, summary.result.best.score.cost)};
    if (!goal.constraints.empty()) row.emplace_back(compared.point.score.is_kept() ? "kept" : "broken");
    const std::vector<double> values = shown_values(summary, compared);
    for (const std::size_t c : shown) row.emplace_back(statistic_text(values[c], summary.shown.columns[c].unit));
    for (std::size_t a = 0; a < summary.axes.size(); ++a) {
      row.emplace_back(reads(summary, compared, a) ? value_text(summary.axes[a], compared.point.values[a]) : "—");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> ranking_lines(const TuneSummary& summary) {
  std::vector<std::string> lines;
  for (std::size_t a = 0; a < summary.axes.size(); ++a) {
    std::vector<const ComparedPoint*> points;
    for (const ComparedPoint& compared : summary.judgement.compared) {
      if (compared.axis == a) points.push_back(&compared);
    }
    if (points.empty()) continue;
    std::ranges::stable_sort(points, [](const ComparedPoint* one, const ComparedPoint* other) {
      return is_better(one->point.score, other->point.score);
    });
    std::string line =
        name_of(summary.axes[a]) + (summary.axes.size() > 1 ? ", each at the best point found with it: " : ": ");
    for (const ComparedPoint* each : points) {
      const bool has_cost = std::isfinite(each->point.score.cost);
      line += fmt::format(
          "{}{} {}{}", each == points.front() ? "" : ", ", value_text(summary.axes[a], each->point.values[a]),
          has_cost ? cost_text(summary.goal, each->point.score.cost) : "— (no such value in every case)",
          kept_text(summary.goal, each->point.score));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace umbrameter
