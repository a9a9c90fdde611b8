#include "present/gate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/lists.h"
#include "reports/files/markup.h"
#include "reports/files/text_layout.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// With as many decimals as show two digits of the head room.
std::string number_text(double value, const MeasuredStatistic& measured) {
  if (!std::isfinite(value)) return "—";
  const bool is_share = measured.unit == "1";
  const double scale = is_share ? 100.0 : 1.0;
  const std::string unit = is_share ? "%" : measured.unit;
  const int decimals = decimals_of(scale * measured.head_room(), 2);
  return with_minus(fmt::format("{:.{}f}{}{}", scale * value, decimals, unit.empty() ? "" : " ", unit));
}

std::string statistic_text(const GateCheck& check) {
  return check.budget.is_magnitude ? fmt::format("|{}|", check.budget.statistic) : check.budget.statistic;
}

std::size_t count_runs(const std::vector<GateCheck>& checks) {
  std::set<std::string> runs;
  for (const GateCheck& check : checks) {
    if (check.measured) runs.insert(check.measured->run);
  }
  return runs.size();
}

bool has_several_runs(const std::vector<GateCheck>& checks) { return count_runs(checks) > 1; }

// "courtyard, sun"; "courtyard, ao"; of several runs "out: courtyard, sun".
std::string where_text(const GateCheck& check, bool names_run) {
  const BudgetEntry& budget = check.budget;
  std::string scene = budget.scene, part = budget.light.empty() ? budget.kind : budget.light;
  if (check.measured) {
    scene = check.measured->scene;
    part = check.measured->light.empty() ? check.measured->kind : check.measured->light;
    if (names_run) scene = check.measured->run + ": " + scene;
  }
  return plain_text(scene.empty() ? part : part.empty() ? scene : scene + ", " + part);
}

std::string bound_text(const GateCheck& check) {
  const Bound& bound = check.budget.bound;
  const std::string number = check.measured ? number_text(check.bound, *check.measured)
                                            : fmt::format("{:.6g}{}{}", bound.quantity.number,
                                                          bound.quantity.unit.empty() ? "" : " ", bound.quantity.unit);
  return fmt::format("{} {}", relation_text(bound.relation), number);
}

std::string measured_text(const GateCheck& check) {
  if (!check.measured) return "not measured";
  const double value = check.measured->value;
  return number_text(check.budget.is_magnitude ? std::abs(value) : value, *check.measured);
}

bool is_judged(const GateCheck& check) { return check.measured && std::isfinite(check.measured->value); }

std::string difference_text(double difference, const GateCheck& check) {
  const std::string text = number_text(difference, *check.measured);
  return text.ends_with(" %") ? text.substr(0, text.size() - 1) + "percentage points" : text;
}

std::string excess_text(const GateCheck& check) {
  return is_judged(check) ? difference_text(check.excess, check) : "—";
}

// The most that other rays of the reference may change the value towards its bound. check.intervals must be finite.
std::string noise_text(const GateCheck& check) { return difference_text(check.excess / check.intervals, check); }

// Whether the noise of the reference's rays alone may have broken the bound.
std::string rays_text(const GateCheck& check) {
  if (check.is_kept || !is_judged(check) || !std::isfinite(check.intervals)) return "—";
  return check.intervals <= 1.0 ? "yes" : fmt::format("no, at most {} of it", noise_text(check));
}

// The value that uses the largest share of its bound. A bound of 0 has no shares, and comes last.
const GateCheck& nearest_to_its_bound(const std::vector<GateCheck>& checks) {
  const auto use_of = [](const GateCheck& check) {
    return check.bound == 0.0 ? 0.0 : 1.0 + check.excess / std::abs(check.bound);
  };
  return *std::ranges::max_element(checks, {}, use_of);
}

// One row for each check; one for all of a scene that no run shows.
std::vector<std::vector<std::string>> rows_of(const std::vector<GateCheck>& checks, bool all) {
  std::set<std::string> seen, told;
  for (const GateCheck& check : checks) {
    if (check.measured || check.budget.scene.empty()) seen.insert(check.budget.scene);
  }
  std::vector<std::vector<std::string>> rows;
  const bool names_run = has_several_runs(checks);
  for (const GateCheck& check : checks) {
    if (check.is_kept && !all) continue;
    const std::string& scene = check.budget.scene;
    const auto bounds = std::ranges::count(checks, scene, [](const GateCheck& each) { return each.budget.scene; });
    if (!seen.contains(scene) && bounds > 1) {
      rows.push_back(
          {"FAILED", plain_text(scene), fmt::format("all {} bounds", bounds), "not measured", "—", "—", "—"});
      seen.insert(scene);
      told.insert(scene);
    }
    if (told.contains(scene)) continue;
    rows.push_back({check.is_kept ? "kept" : "FAILED", where_text(check, names_run), statistic_text(check),
                    measured_text(check), bound_text(check), excess_text(check), rays_text(check)});
  }
  return rows;
}

// A failure in one sentence.
std::string failure_text(const GateCheck& check) {
  if (!check.measured) return "no run measured it";
  if (!is_judged(check)) return "nothing was measured: no pixel counts";
  const std::string by =
      fmt::format("{} is not {}: off by {}", measured_text(check), bound_text(check), excess_text(check));
  return std::isfinite(check.intervals) ? fmt::format("{}, of which noise of the reference can explain {}", by,
                                                      check.intervals <= 1.0 ? "all" : "at most " + noise_text(check))
                                        : by;
}

std::string markdown_cell(const std::string& text) { return escape_markup(replace_all(text, "|", "\\|")); }

const std::vector<std::string> header = {
    "", "where", "statistic", "value", "bound", "excess", "can noise of the reference explain it?"};

}  // namespace

std::size_t count_failed(const std::vector<GateCheck>& checks) {
  return static_cast<std::size_t>(std::ranges::count_if(checks, [](const GateCheck& check) { return !check.is_kept; }));
}

std::string gate_answer(const std::vector<GateCheck>& checks) {
  const std::size_t failed = count_failed(checks);
  // Of several runs a bound is checked more than once.
  const std::string checked =
      has_several_runs(checks) ? fmt::format("checks in {} runs", count_runs(checks)) : "bounds";
  if (failed == 0) {
    const bool has_several = checks.size() > 1;
    const GateCheck& check = has_several ? nearest_to_its_bound(checks) : checks.front();
    const std::string start = has_several ? fmt::format("all {} {} are kept; nearest to its bound: {}: ", checks.size(),
                                                        checked, where_text(check, has_several_runs(checks)))
                                          : "the bound is kept: ";
    return fmt::format("{}{} {}, {}", start, statistic_text(check), measured_text(check), bound_text(check));
  }
  const auto unmeasured =
      static_cast<std::size_t>(std::ranges::count_if(checks, [](const GateCheck& check) { return !check.measured; }));
  const std::size_t broken = failed - unmeasured;
  const auto count = [&](std::size_t number) {
    return fmt::format("{} of {} {} {}", number, checks.size(), checked, number == 1 ? "is" : "are");
  };
  if (checks.size() == 1) return broken == 1 ? "the bound is broken" : "no run measured what is bounded";
  if (unmeasured == 0) return count(broken) + " broken";
  if (broken == 0)
    return count(unmeasured) + " measured by no run" + (unmeasured < checks.size() ? "; the others are kept" : "");
  return fmt::format("{} broken, and {} measured by no run", count(broken),
                     unmeasured == 1 ? "1 is" : fmt::format("{} are", unmeasured));
}

std::vector<std::string> gate_lines(const std::vector<GateCheck>& checks, bool all) {
  std::vector<std::vector<std::string>> rows = rows_of(checks, all);
  if (rows.empty()) return {};
  rows.insert(rows.begin(), header);
  return aligned(rows);
}

std::string junit_xml(const std::vector<GateCheck>& checks) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\"", checks.size(), count_failed(checks));
  xml += fmt::format("<testsuites {}>\n  <testsuite name=\"umbrameter\" {}>\n", counts, counts);
  const bool names_run = has_several_runs(checks);
  for (const GateCheck& check : checks) {
    const std::string where = where_text(check, names_run);
    xml += fmt::format("    <testcase classname=\"{}\" name=\"{} {}\"", escape_markup(where.empty() ? "run" : where),
                       escape_markup(statistic_text(check)), escape_markup(bound_text(check)));
    if (check.is_kept) {
      xml += fmt::format("><system-out>{}</system-out></testcase>\n", escape_markup(measured_text(check)));
    } else {
      xml += fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n", escape_markup(failure_text(check)));
    }
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

std::vector<std::string> gate_notes(const std::vector<BudgetEntry>& budget,
                                    const std::vector<MeasuredStatistic>& measured) {
  std::vector<std::string> notes;
  const auto add = [&](std::string text) {
    if (std::ranges::find(notes, text) == notes.end()) notes.push_back(std::move(text));
  };
  for (const MeasuredStatistic& each : unbounded(budget, measured)) {
    add(fmt::format("no bound names {} ({}): nothing of it was checked; --update adds bounds for it", each.run,
                    each.scene));
  }
  for (const UncheckedBounds& each : unchecked_bounds(budget, measured)) {
    add(fmt::format("{0} ({1}) has not measured {2}: no bound on {2} was checked there", each.run, each.where,
                    joined(each.statistics, ", ")));
  }
  for (const MeasuredStatistic& each : measured) {
    if (each.view.empty()) continue;
    add(fmt::format("{} is a sweep over views, of which only that of least error is checked ({}); run compare for each",
                    each.run, each.view));
  }
  return notes;
}

std::string gate_markdown(const std::vector<GateCheck>& checks, const std::vector<std::string>& notes) {
  const std::size_t failed = count_failed(checks);
  std::string text = fmt::format("### {} Umbrameter: {}\n\n", failed == 0 ? "✅" : "❌", gate_answer(checks));
  text += "| " + joined(header, " | ") + " |\n| --- | --- | --- | ---: | ---: | ---: | ---: |\n";
  std::vector<GateCheck> sorted = checks;
  std::stable_partition(sorted.begin(), sorted.end(), [](const GateCheck& check) { return !check.is_kept; });
  for (std::vector<std::string>& row : rows_of(sorted, true)) {
    row.front() = row.front() == "kept" ? "✅" : "❌";
    text += "|";
    for (const std::string& cell : row) text += fmt::format(" {} |", markdown_cell(cell));
    text += "\n";
  }
  for (const std::string& note : notes) text += "\n" + markdown_cell(plain_text(note)) + "\n";
  return text;
}

Json to_json(const std::vector<GateCheck>& checks) {
  Json list = Json::array();
  for (const GateCheck& check : checks) {
    Json object = {{"kept", check.is_kept}, {"statistic", statistic_text(check)}};
    if (check.measured) {
      const MeasuredStatistic& measured = *check.measured;
      object.update({{"run", measured.run},
                     {"scene", measured.scene},
                     {"kind", measured.kind},
                     {"light", measured.light},
                     {"unit", measured.unit},
                     {"value", measured.value},
                     {"half_width_95", measured.half_width},
                     {"excess", check.excess},
                     {"excess_in_intervals", check.intervals}});
    } else {
      const BudgetEntry& budget = check.budget;
      object.update({{"scene", budget.scene},
                     {"kind", budget.kind},
                     {"light", budget.light},
                     {"unit", budget.bound.quantity.unit}});
    }
    object["relation"] = relation_text(check.budget.bound.relation);
    object["bound"] = check.bound;
    list.push_back(std::move(object));
  }
  return {{"checks", list}, {"failed", count_failed(checks)}};
}

}  // namespace umbrameter
