#include "present/tune_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "present/axis_ends.h"
#include "present/plateau_text.h"
#include "present/plot_axes.h"
#include "present/presentation_parts.h"
#include "present/tune_comparison.h"
#include "present/tune_sensitivity.h"
#include "present/tune_text.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

// Signed so that smaller is better.
double objective(const TuneGoal& goal, std::size_t column, const std::vector<CaseValues>& cases) {
  const double value = aggregate(goal, column, cases);
  return is_higher_better(goal, column) ? -value : value;
}

// How a point ("the best point") compares; `difference` and `plain` are its cost less the other's.
std::string judged(const TuneGoal& goal, const std::string& point, std::optional<Estimate> difference, double plain) {
  if (plain == 0.0) return point + " has the same cost";
  const double value = difference ? difference->value : plain;
  if (!std::isfinite(value)) return point + " cannot be compared";
  if (difference && value < 0.0) difference = {-value, -difference->upper, -difference->lower};
  const char* is_significant = !difference               ? ", without a test of significance"
                               : difference->lower > 0.0 ? ""
                                                         : ", not significantly";
  return fmt::format("{} is {}{}, by {}{}", point, difference && difference->lower > 0.0 ? "significantly " : "",
                     value < 0.0 ? "better" : "worse",
                     difference_text(goal, std::abs(value), difference, "percentage points"), is_significant);
}

// A number that is nearer to the best is hardly another.
const char* runner_up_words(const TuneSummary& summary) {
  return std::ranges::all_of(summary.axes, &TuneAxis::is_word) ? "runner-up"
                                                               : "runner-up, at least a twentieth of an axis away";
}

std::string comparison(const TuneSummary& summary, const char* what, const TunePoint& other,
                       const std::optional<Estimate>& difference) {
  const TuneGoal& goal = summary.goal;
  const TunePoint& best = summary.result.best;
  const bool breaks = !other.score.is_kept();
  constexpr int digits = 5;  // its cost is of this very point
  return fmt::format("{}, {}{}: {}{}; {}", what, point_text(summary.axes, other.values, digits),
                     is_better(other.score, best.score) ? " (not on the axes)" : "", cost_text(goal, other.score.cost),
                     !breaks                ? ""
                     : best.score.is_kept() ? ", but breaks a constraint that the best point keeps"
                                            : " (breaks constraints" + broken_text(goal, other, summary.cases) + ")",
                     judged(goal, "the best point", difference, best.score.cost - other.score.cost));
}

Table case_table(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  Table table{{{"case", "", "scene, camera and light"}}, {}};
  for (const char* when : {"default", "recommended", "best"}) {
    if (when == std::string_view("recommended") && !result.recommended) continue;
    for (const Column& column : summary.goal.columns) {
      table.columns.push_back({fmt::format("{}: {}", when, statistic_words(column.name)), "", column.meaning});
    }
  }
  const auto add = [&](const std::vector<std::string>& cases, const TunePoint& before,
                       const std::optional<TunePoint>& recommended, const TunePoint& best, const char* prefix) {
    for (std::size_t c = 0; c < cases.size(); ++c) {
      std::vector<Value> row = {prefix + cases[c]};
      for (const TunePoint* point : {&before, recommended ? &*recommended : nullptr, &best}) {
        for (std::size_t k = 0; point != nullptr && k < summary.goal.columns.size(); ++k) {
          row.emplace_back(statistic_text(point->cases[c][k], summary.goal.columns[k].unit));
        }
      }
      table.rows.push_back(std::move(row));
    }
  };
  add(summary.cases, result.before, result.recommended, result.best, "");
  if (const auto& held = summary.judgement.held_out) {
    add(held->cases, held->before, held->recommended, held->best, "held out: ");
  }
  return table;
}

std::vector<std::string> lines_of(const Table& table) {
  std::vector<std::vector<std::string>> rows(1);
  for (const Column& column : table.columns) rows.front().push_back(column.name);
  for (const std::vector<Value>& row : table.rows) {
    std::vector<std::string>& cells = rows.emplace_back();
    for (const Value& value : row) cells.push_back(to_string(value));
  }
  return aligned(rows);
}

std::string constraint_line(const TuneSummary& summary) {
  if (summary.goal.constraints.empty()) return {};
  if (!summary.result.best.score.is_kept())
    return "no measured point keeps every constraint in every case; this one breaks them least, by the sum of all "
           "relative excesses" +
           broken_text(summary.goal, summary.result.best, summary.cases);
  return "every constraint is kept in every case of the search";
}

// The plateau of the constant bias, by the rule of every command.
std::string bias_range_text(const TuneSummary& summary) {
  const BiasPlateau& plateau = *summary.result.plateau;
  const auto axis = std::ranges::find(summary.axes, constant_bias_key, &TuneAxis::key);
  const bool is_free = summary.goal.constraints.empty();
  const bool is_single = summary.cases.size() == 1;
  std::vector<std::string> which;
  if (summary.axes.size() > 1) which.emplace_back("other values as in the best point");
  if (!is_free) which.emplace_back("only biases that keep the constraints");
  std::string text = fmt::format("constant-bias{}: ", which.empty() ? "" : " (" + joined(which, "; ") + ")") +
                     range_text(plateau, axis->axis.length_unit, is_free ? "cost on the axis" : "cost of these",
                                cost_text(summary.goal, plateau.least.mae), only_of_axis, {},
                                plateau.is_by_pixels && !is_single ? tolerance_text(summary) : "");
  const std::string ends = ends_text(*axis, {plateau.first.constant, plateau.last.constant});
  if (!ends.empty()) text += "; the range reaches the " + ends;
  if (!plateau.has_little_acne()) {
    return text +
           (plateau.first.constant == plateau.last.constant
                ? fmt::format("; it leaves acne of {}{}, more than 0.1 %", is_single ? "" : "up to ",
                              percent(plateau.recommended.acne))
                : "; each leaves acne of more than 0.1 %" + std::string(is_single ? "" : " in one case at least"));
  }
  const std::string where = is_single ? "" : " in every case of the search";
  if (plateau.first.acne <= little_acne_share)
    return text + "; the smallest of these has acne of at most 0.1 %" + where;
  return text + fmt::format("; of these, acne is at most 0.1 %{} from {}", where,
                            value_text(*axis, plateau.recommended.constant));
}

std::string method_text(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  return fmt::format("Search: {}; {}, each of {}{}. Then each parameter is varied alone, from the best point.",
                     result.method, count_text(result.evaluations, "evaluation"),
                     count_text(summary.cases.size(), "case"),
                     result.stopped_by.empty() ? "" : "; stopped after " + result.stopped_by);
}

bool have_equal_scores(const TunePoint& a, const TunePoint& b) {
  return !is_better(a.score, b.score) && !is_better(b.score, a.score);
}

std::string equal_points_text(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  const std::string keys = joined(summary.axes, ", ", &TuneAxis::key);
  return fmt::format("all {} evaluated points are equal: {} {}; {} {} nothing here",
                     std::max(result.points.size(), result.curve.size()), cost_words(summary.goal),
                     cost_text(summary.goal, result.best.score.cost), keys,
                     summary.axes.size() > 1 ? "change" : "changes");
}

// The axes along which the cost is the same while the others keep their best values.
std::vector<std::string> idle_axes(const TuneSummary& summary) {
  std::vector<std::string> lines;
  for (const AxisScan& scan : summary.result.scans) {
    const bool is_idle = scan.points.size() > 1 && std::ranges::all_of(scan.points, [&](const TunePoint& point) {
                           return have_equal_scores(point, scan.points.front());
                         });
    if (is_idle) lines.push_back(fmt::format("{} changes nothing at the best point", summary.axes[scan.axis].key()));
  }
  return lines;
}

// "8 texels is the upper end of the axis; extend it"; nothing where the value lies within.
std::optional<std::string> end_of_axis_text(const TuneAxis& axis, const Value& value) {
  Experiment experiment;
  const double position = position_of(axis, value);
  constexpr double near_end = 0.005;
  if (axis.is_continuous ? position > near_end && position < 1.0 - near_end : position > 0.0 && position < 1.0)
    return {};
  const std::vector<double> ends = mapped(axis.axis.values, [](const Value& each) { return to_number(each); });
  const Value& end = position < 0.5 ? axis.axis.values.front() : axis.axis.values.back();
  const AxisEnd at = end_of(ends, to_number(end), require(describe(experiment), axis.key()));
  if (at == AxisEnd::none) return {};
  const std::string text = value_text(axis, value);
  const std::string last = value_text(axis, end);
  return fmt::format("{} is the {} end of the axis{}; extend it", text, at == AxisEnd::lower ? "lower" : "upper",
                     text == last ? "" : ", " + last + ", or next to it");
}

// What the search found, with its significance.
void add_answers(const TuneSummary& summary, std::vector<std::string>& answers) {
  const TuneResult& result = summary.result;
  const TuneGoal& goal = summary.goal;
  std::string best = "best";
  const bool is_free = goal.constraints.empty();
  const char* where_kept = is_free ? "" : " where the constraints are kept";
  const bool has_cases = summary.cases.size() > 1;
  const std::string of_cases = of_cases_text(goal, summary.cases.size());
  if (result.withheld) {
    answers.push_back("no bias recommended: " + withheld_text(*result.withheld, result.evidence));
    best = "best point, whose bias is not recommended";
  } else if (result.recommended) {
    const BiasCell& used = result.plateau->recommended;
    answers.push_back(fmt::format(
        "use {}: {} {}{}, acne {}{}. {} constant bias is{} the smallest (to three digits) whose cost is at most {} "
        "{} and whose acne is at most 0.1 %{}. The smallest, because a larger bias may detach shadows where these "
        "views do not look",
        point_text(summary.axes, result.recommended->values), cost_words(goal), cost_text(goal, used.mae), of_cases,
        percent(used.acne), has_cases ? " in the case with the most" : "",
        summary.axes.size() > 1 ? "With the other values as they are, this" : "This",
        is_free ? "" : ", of those that keep the constraints,",
        result.limit.is_by_pixels || !(result.best.score.cost > 0.0) ? tolerance_text(summary) + " above"
                                                                     : times_text(1.0 + plateau_tolerance),
        is_free ? "the least" : "their least", has_cases ? " in every case of the search" : ""));
    best = std::string("best point, of least cost") + where_kept;
  }
  const std::string best_values = point_text(summary.axes, result.best.values, digits_of_best(summary));
  // With the digits of the other points, so that it reads as the smallest.
  const std::string plain = cost_text(goal, result.best.score.cost);
  const std::string range = cost_text(goal, result.best.score.cost, summary.judgement.best);
  const std::string covers =
      std::string("95 % interval, over parts of the image") + (summary.judgement.covers_rays ? " and rays" : "");
  const std::size_t half_width = range.find(" ± ");
  const std::string cost =
      range == plain ? plain
      : half_width == std::string::npos
          ? fmt::format("{} ({}: {})", plain, covers, range)
          : fmt::format("{}{} ({})", plain.substr(0, plain.find(' ')), range.substr(half_width), covers);
  const std::size_t few_blocks = summary.judgement.few_blocks;
  answers.push_back(
      fmt::format("{}: {}: {} {}{}{}", best, best_values, cost_words(goal), cost, of_cases,
                  few_blocks > 0 ? " (no interval: " + few_blocks_text(few_blocks, "the images") + ")" : ""));
  if (const std::string line = constraint_line(summary); !line.empty()) answers.push_back("constraints: " + line);
  answers.push_back(comparison(summary, "default", result.before, summary.judgement.against_before));
  if (result.runner_up) {
    answers.push_back(
        comparison(summary, runner_up_words(summary), *result.runner_up, summary.judgement.against_runner_up));
  }
  if (summary.judgement.held_out) {
    const HeldOut& held = *summary.judgement.held_out;
    const TuneGoal absolute = not_relative(goal);
    const TunePoint& checked = held.recommended ? *held.recommended : held.best;
    answers.push_back(fmt::format(
        "held out ({}): {}default {} → {}{}; {}",
        held.cases.size() > 2
            ? fmt::format("{} cases: '{}', …, '{}'", held.cases.size(), held.cases.front(), held.cases.back())
            : joined(held.cases, "; "),
        goal.is_relative ? cost_words(absolute) + ", not relative: " : "", held_text(absolute, held.before, held.cases),
        held_text(absolute, checked, held.cases), of_cases_text(goal, held.cases.size(), true),
        judged(absolute, held.recommended ? "the recommended point" : "the best point",
               held.recommended ? held.recommended_difference : held.difference,
               checked.score.cost - held.before.score.cost)));
    if (held.few_blocks > 0) answers.back() += ": " + few_blocks_text(held.few_blocks, "the images");
    if (!checked.score.is_kept() && held.best.score.is_kept()) {
      answers.back() += fmt::format("; the best point keeps {} there, at {}",
                                    goal.constraints.size() == 1 ? "the constraint" : "the constraints",
                                    held_text(absolute, held.best, held.cases));
    }
  } else {
    answers.emplace_back("held out: nothing; the scenes have no other camera; name a scene with --held-out");
  }
  if (result.plateau) answers.push_back(bias_range_text(summary));
  for (std::string& line : ranking_lines(summary)) answers.push_back(std::move(line));
  for (std::string& line : idle_axes(summary)) answers.push_back(std::move(line));
}

}  // namespace

bool are_all_equal(const TuneResult& result) {
  const auto are_equal = [&](const std::vector<TunePoint>& points) {
    return std::ranges::all_of(points, [&](const TunePoint& point) { return have_equal_scores(point, result.before); });
  };
  return result.points.size() + result.curve.size() > 1 && are_equal(result.points) && are_equal(result.curve);
}

std::vector<TunePoint> pareto_front(const TuneGoal& goal, const std::vector<TunePoint>& points) {
  const std::vector<std::size_t> objectives = objectives_of(goal);
  std::vector<std::vector<double>> values;
  for (const TunePoint& point : points) {
    std::vector<double>& of_point = values.emplace_back();
    for (const std::size_t c : objectives) of_point.push_back(objective(goal, c, point.cases));
  }
  const auto dominates = [&](std::size_t a, std::size_t b) {
    bool is_less = false;
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      if (!(values[a][k] <= values[b][k])) return false;
      is_less = is_less || values[a][k] < values[b][k];
    }
    return is_less || a < b;  // of equal points the first
  };
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_dominated = std::ranges::any_of(values[i], [](double v) { return std::isnan(v); });
    for (std::size_t j = 0; j < points.size() && !is_dominated; ++j) is_dominated = j != i && dominates(j, i);
    if (!is_dominated) kept.push_back(i);
  }
  std::ranges::sort(kept, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return mapped(kept, [&](const std::size_t i) { return points[i]; });
}

std::vector<std::string> warnings_of(const TuneSummary& summary) {
  std::vector<std::string> warnings;
  const auto add = [&](std::size_t a, const Value& value, const std::string& whose) {
    if (std::optional<std::string> end = end_of_axis_text(summary.axes[a], value)) {
      warnings.push_back(fmt::format("{}: {}best value {}", summary.axes[a].key(), whose, *end));
    }
  };
  const TunePoint& best = summary.result.best;
  for (std::size_t a = 0; a < summary.axes.size(); ++a) {
    if (summary.axes[a].is_word() || summary.axes[a].count() < 2) continue;
    // Where the cost does not depend on the parameter, any value is as good.
    const bool matters = std::ranges::any_of(
        summary.result.scans[a].points, [&](const TunePoint& point) { return is_better(best.score, point.score); });
    if (!matters) continue;
    add(a, best.values[a], "the ");
    for (const WordPoint& word : summary.result.of_words) {
      if (word.point.values == best.values ||
          std::ranges::find(word.unread, summary.axes[a].key()) != word.unread.end())
        continue;
      add(a, word.point.values[a],
          fmt::format("with {} the ", value_text(summary.axes[word.axis], word.point.values[word.axis])));
    }
  }
  for (const std::vector<std::string>& more : {missed_points(summary), summary.warnings}) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  return warnings;
}

Presentation present_tuning(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  const TuneGoal& goal = summary.goal;
  Presentation shown_part;
  std::vector<std::string>& answers = shown_part.answers;
  if (are_all_equal(result)) {
    answers.push_back(equal_points_text(summary));
  } else {
    add_answers(summary, answers);
  }
  for (const std::string& warning : warnings_of(summary)) answers.push_back("warning: " + warning);

  std::vector<TunePoint> candidates = result.points;
  candidates.insert(candidates.end(), result.curve.begin(), result.curve.end());
  const std::vector<TunePoint> front = pareto_front(goal, candidates);
  const Table sensitivity = sensitivity_table(summary);
  shown_part.lines = lines_of(sensitivity);
  ReportSection& section = shown_part.section;
  section.title = "Tuning";
  section.tables_first = true;
  section.text =
      method_text(summary) +
      "\n\n95 % intervals (± or a range) say how much a value depends on which parts of the scene an image shows" +
      (summary.judgement.covers_rays ? " and on the rays of the reference" : "") +
      ": each of up to 64 blocks of the image is left out in turn (jackknife). Differences are paired: both "
      "points lose the same block. "
      "The point to use is checked on the held-out cases, if there are any.";
  if (const Table compared = comparison_table(summary); !compared.rows.empty()) {
    const std::vector<std::string> lines = lines_of(compared);
    shown_part.lines.insert(shown_part.lines.end(), lines.begin(), lines.end());
    section.tables.push_back({"The best point with each value", compared});
  }
  section.tables.push_back({"Sensitivity to each parameter, the others as in the best point", sensitivity});
  section.tables.push_back({"Each case", case_table(summary)});
  if (objectives_of(goal).size() > 1) {
    section.tables.push_back(front_table(summary, front));
    add_figure(shown_part, front_figure(summary, front));
  }
  for (const AxisScan& scan : result.scans) {
    if (!summary.axes[scan.axis].is_word() && scan.points.size() > 1) {
      add_figure(shown_part, scan_figure(summary, scan));
    }
  }
  if (result.points.size() > 1) {
    PlotFigure search = search_figure(summary);
    const auto is_later = [](const auto& row) { return std::get<std::int64_t>(row.front()) > 1; };
    if (std::ranges::any_of(search.data.rows, is_later)) add_figure(shown_part, std::move(search));
  }
  return shown_part;
}

}  // namespace umbrameter
