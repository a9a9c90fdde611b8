#include "present/runs_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "present/plateau_text.h"
#include "present/presentation_parts.h"
#include "reports/files/text_layout.h"
#include "results/known_statistics.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

// Shares are shown in per cent.
double scale_of(const std::string& unit) { return unit == "1" ? 100.0 : 1.0; }
std::string shown_unit(const std::string& unit) { return unit == "1" ? "%" : unit; }

// "12.8 ± 1.9", or "12.8 (10.7 to 14.7)" where noise of the reference may have raised the value, or the interval ends
// at 0: its ends do not show the value.
std::string interval_text(const Estimate& estimate, double scale) {
  const std::string value = with_half_width(scale * estimate.value, 0.0);
  if (!(estimate.upper > estimate.lower)) return value;
  const std::string text = estimate_text({scale * estimate.value, scale * estimate.lower, scale * estimate.upper}, "");
  return text.find(" to ") == std::string::npos ? text : fmt::format("{} ({})", value, text);
}

// Marks an interval that does not cover the choice of pixels.
constexpr const char* rays_only_mark = "*";

std::string printed_value(const ComparedValue& value) {
  const double scale = scale_of(value.measured.unit);
  const double number = value.measured.value;
  const bool is_count = value.measured.unit == "px" && number >= 0.0 && number == std::floor(number);
  if (is_count && !(value.half_width > 0.0)) return grouped(static_cast<std::uint64_t>(number));
  return interval_text(estimate_of(value), scale);
}

std::string compared_text(const ComparedValue& value) {
  return printed_value(value) + (value.interval == IntervalOf::rays ? rays_only_mark : "");
}

std::string difference_text(const ComparedValue& value) {
  if (value.verdict == Verdict::base || value.verdict == Verdict::no_base) return "—";
  const std::string text = interval_text(value.difference, scale_of(value.measured.unit)) +
                           (value.verdict == Verdict::rays_only ? rays_only_mark : "");
  if (value.verdict == Verdict::significant || value.verdict == Verdict::equal) return text;
  const std::size_t range = text.find(" (");
  return range == std::string::npos ? "(" + text + ")" : "(" + text.substr(0, range) + ", " + text.substr(range + 2);
}

std::string verdict_text(const ComparedValue& value) {
  const std::string test = value.blocks > 0 ? fmt::format("paired over {} blocks of the image", value.blocks)
                                            : "not paired: from both intervals";
  switch (value.verdict) {
    case Verdict::base:
      return "—";
    case Verdict::no_base:
      return "not compared: the first run has no such statistic";
    case Verdict::equal:
      return "equal";
    case Verdict::significant:
      return "significant, " + test;
    case Verdict::not_significant:
      return "not significant, " + test;
    case Verdict::rays_only:
      return "not tested: the interval covers the rays only";
    case Verdict::no_interval:
      if (value.counted_blocks == 0) return "not tested: no interval";
      return "not tested: " + few_blocks_text(value.counted_blocks);
  }
  return "";
}

bool are_of_one_part(const ComparedStatistic& a, const ComparedStatistic& b) {
  return a.kind == b.kind && a.light == b.light;
}

std::string part_title(const ComparedStatistic& compared) {
  if (compared.kind == "shadow") return "Shadow of " + compared.light;
  return compared.kind == "ao" ? "Ambient occlusion" : "The shaded image";
}

std::string file_stem(const std::vector<StoredRun>& runs, const ComparedStatistic& compared) {
  if (compared.light.empty()) return compared.kind;
  return compared.kind + "_" + runs[compared.values.front().run].layers.at(compared.light);
}

// "Mean absolute error". What it is an error of is the table's subject.
std::string title_text(const ComparedStatistic& compared) {
  std::string title = statistic_words(compared.name, compared.kind);
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  return title;
}

std::string head_with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

// Without an interval nothing can be said of a difference that the values do not say.
std::string printed_difference(const ComparedValue& value) {
  if (value.verdict == Verdict::no_interval || value.verdict == Verdict::no_base) return "—";
  if (value.verdict == Verdict::equal) return "0";
  const std::string text = interval_text(value.difference, scale_of(value.measured.unit));
  return value.verdict == Verdict::significant ? text + "*" : text;
}

// Of two shares the difference is in percentage points.
std::string unit_in_table(const ComparedStatistic& each, bool is_difference) {
  const std::string unit = shown_unit(each.unit);
  return is_difference && unit == "%" ? "percentage points" : unit;
}

// One row for each error, one column for each run. A unit common to all rows is in the head.
template <class Text>
Table rows_of_errors(const std::vector<StoredRun>& runs, const std::vector<const ComparedStatistic*>& errors,
                     std::size_t first_run, const Text& text) {
  const auto unit_of = [&](const ComparedStatistic& each) { return unit_in_table(each, first_run > 0); };
  std::string unit = errors.empty() ? "" : unit_of(*errors.front());
  for (const ComparedStatistic* each : errors) {
    if (unit_of(*each) != unit) unit.clear();
  }
  const std::string what = first_run > 0 ? "Difference to " + runs.front().name : "Error";
  Table table{{{head_with_unit(what, unit), "", ""}}, {}};
  for (std::size_t run = first_run; run < runs.size(); ++run) table.columns.push_back({runs[run].name, "", ""});
  for (const ComparedStatistic* each : errors) {
    std::vector<Value> row(table.columns.size(), std::string("—"));
    row.front() = unit.empty() ? head_with_unit(title_text(*each), unit_of(*each)) : title_text(*each);
    for (const ComparedValue& value : each->values) {
      if (value.run >= first_run) row[value.run - first_run + 1] = text(value);
    }
    const auto is_dash = [](const Value& cell) { return to_string(cell) == "—"; };
    if (!std::all_of(row.begin() + 1, row.end(), is_dash)) table.rows.push_back(std::move(row));
  }
  return table;
}

// One row for each run, one column for each statistic that is an error. `text` makes a cell.
template <class Text>
Table rows_of_runs(const std::vector<StoredRun>& runs, const std::vector<const ComparedStatistic*>& errors,
                   std::size_t first_run, const Text& text) {
  Table table{{{"run", "", ""}}, {}};
  for (const ComparedStatistic* each : errors)
    table.columns.push_back({statistic_words(each->name, each->kind), unit_in_table(*each, first_run > 0), ""});
  for (std::size_t run = first_run; run < runs.size(); ++run) {
    std::vector<Value> row = {runs[run].name};
    for (const ComparedStatistic* each : errors) {
      const auto found = std::ranges::find(each->values, run, &ComparedValue::run);
      row.emplace_back(found == each->values.end() ? "—" : text(*found));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Whether runs with another filter than the first were measured against the same hard shadow.
bool compares_filters(const std::vector<StoredRun>& runs, const std::vector<ComparedStatistic>& compared) {
  const auto has_filter_of_first = [&](const ComparedValue& value) {
    return std::ranges::all_of(runs.front().parameters, [&](const std::pair<std::string, std::string>& parameter) {
      const bool is_filter = parameter.first == "shadow.filter" || parameter.first == "shadow.technique";
      return !is_filter || std::ranges::find(runs[value.run].parameters, parameter) != runs[value.run].parameters.end();
    });
  };
  // Causes of PCF, or the parts of a technique without taps.
  const auto is_against_hard = [&](std::size_t run, const ComparedStatistic& of) {
    return std::ranges::any_of(compared, [&](const ComparedStatistic& each) {
      return are_of_one_part(each, of) && (each.name == "acne" || each.name == "too_dark_away") &&
             std::ranges::find(each.values, run, &ComparedValue::run) != each.values.end();
    });
  };
  return std::ranges::any_of(compared, [&](const ComparedStatistic& each) {
    return each.name == error_statistic && each.values.front().run == 0 && is_against_hard(0, each) &&
           std::ranges::any_of(each.values, [&](const ComparedValue& value) {
             return !has_filter_of_first(value) && is_against_hard(value.run, each);
           });
  });
}

}  // namespace

std::string with_half_width(double value, double half_width) {
  if (!std::isfinite(value)) return "—";
  // A count.
  if (!(half_width > 0.0) && value == std::floor(value)) return with_minus(fmt::format("{:.0f}", value));
  return estimate_text({value, value - half_width, value + half_width}, "");
}

std::vector<PartTables> part_tables(const std::vector<StoredRun>& runs,
                                    const std::vector<ComparedStatistic>& compared) {
  std::vector<PartTables> parts;
  for (auto first = compared.begin(); first != compared.end();) {
    const auto last = std::find_if(first, compared.end(),
                                   [&](const ComparedStatistic& each) { return !are_of_one_part(*first, each); });
    std::vector<const ComparedStatistic*> errors;
    PartTables part{file_stem(runs, *first), part_title(*first), {}, {}, {}, {}, {}};
    part.all.columns = {{"statistic", "", ""},
                        {"unit", "", ""},
                        {"run", "", ""},
                        {"value", "", ""},
                        {"difference", "", "of shares in percentage points"},
                        {"verdict", "", ""}};
    for (auto each = first; each != last; ++each) {
      if (each->is_error) errors.push_back(&*each);
      for (const ComparedValue& value : each->values) {
        part.is_sampled = part.is_sampled || value.measured.is_sampled();
        part.has_noise = part.has_noise || value.noise > 0.0;
        part.few_blocks = std::max(part.few_blocks, value.counted_blocks);
        part.all.rows.push_back({title_text(*each), shown_unit(each->unit), runs[value.run].name, compared_text(value),
                                 difference_text(value), verdict_text(value)});
      }
    }
    part.values = rows_of_runs(runs, errors, 0, compared_text);
    std::vector<const ComparedStatistic*> of_first = errors;
    std::erase_if(of_first, [](const ComparedStatistic* each) { return each->values.front().run > 0; });
    std::erase_if(of_first, [](const ComparedStatistic* each) { return each->values.size() < 2; });
    part.differences = rows_of_runs(runs, of_first, 1, difference_text);
    part.printed_values = rows_of_errors(runs, errors, 0, compared_text);
    part.printed_differences = rows_of_errors(runs, errors, 1, printed_difference);
    parts.push_back(std::move(part));
    first = last;
  }
  return parts;
}

Table comparison_rows(const std::vector<StoredRun>& runs, const std::vector<ComparedStatistic>& compared) {
  Table table{plain_columns({"kind", "light", "statistic", "unit", "run", "value", "half_width", "noise", "interval_of",
                             "difference", "difference_lo", "difference_hi", "blocks", "verdict"}),
              {}};
  constexpr const char* verdicts[] = {"base",      "equal",       "significant", "not significant",
                                      "rays only", "no interval", "no base"};
  constexpr const char* intervals[] = {"", "rays", "pixels and rays"};
  for (const ComparedStatistic& each : compared) {
    for (const ComparedValue& value : each.values) {
      table.rows.push_back({each.kind, each.light, each.name, each.unit, runs[value.run].name, value.measured.value,
                            value.half_width, value.noise,
                            std::string(intervals[static_cast<std::size_t>(value.interval)]), value.difference.value,
                            value.difference.lower, value.difference.upper, static_cast<std::int64_t>(value.blocks),
                            std::string(verdicts[static_cast<std::size_t>(value.verdict)])});
    }
  }
  return table;
}

std::vector<std::string> comparison_answers(const std::vector<StoredRun>& runs,
                                            const std::vector<ComparedStatistic>& compared) {
  std::vector<std::string> answers;
  std::string noisy;  // what has such intervals: "lamp, AO"
  for (const ComparedStatistic& each : compared) {
    if (each.name != error_statistic) continue;
    bool shows_noise = false;
    const std::string what = each.light.empty() ? (each.kind == "ao" ? "AO" : each.kind) : each.light;
    for (const ComparedValue& value : each.values) {
      const char* cell = runs[value.run].command == "sweep" ? ", cell of least error" : "";
      const std::string own = printed_value(value);
      const std::string difference = interval_text(value.difference, 100.0);
      std::string line =
          fmt::format("{}, {}{}: error {} %{}", what, runs[value.run].name, cell, own,
                      value.interval == IntervalOf::pixels ? fmt::format(" (95 % interval, over parts of the image{})",
                                                                         value.measured.is_sampled() ? " and rays" : "")
                      : value.interval == IntervalOf::rays ? " (95 % interval, over the rays only)"
                                                           : "");
      const bool is_compared = value.verdict != Verdict::base && value.verdict != Verdict::no_base;
      if (!is_compared && value.counted_blocks > 0) {
        line += " (no interval: " + few_blocks_text(value.counted_blocks) + ")";
      } else if (value.verdict == Verdict::equal) {
        line += fmt::format("; equal to that of {}", runs.front().name);
      } else if (is_compared) {
        line += fmt::format("; difference to {} {} percentage points ({})", runs.front().name, difference,
                            verdict_text(value));
      }
      const auto is_range = [](const std::string& text) { return text.find(" to ") != std::string::npos; };
      // An interval that ends at 0 is a range without noise, too.
      ComparedValue without_noise = value;
      without_noise.noise = 0.0;
      const bool is_by_noise = is_range(own) && !is_range(printed_value(without_noise));
      shows_noise = shows_noise || is_by_noise || (value.noise > 0.0 && is_compared && is_range(difference));
      answers.push_back(std::move(line));
    }
    if (shows_noise) noisy += (noisy.empty() ? "" : ", ") + what;
  }
  if (!noisy.empty()) {
    answers.push_back(
        fmt::format("the noise of its sampled reference can only raise the error of {0}: an interval 'A to B' of {0} "
                    "reaches down to what the error would be without noise; more rays (--truth.spp) shorten it",
                    noisy));
  }
  for (const StoredRun& run : runs) {
    const auto of_ao = [&](std::string_view name) {
      const auto found = std::ranges::find_if(
          run.statistics, [&](const MeasuredStatistic& each) { return each.kind == "ao" && each.name == name; });
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      if (found == run.statistics.end()) return Estimate{unknown, unknown, unknown};
      return Estimate{found->value, found->lower, found->value + found->half_width};
    };
    const std::string warning = no_ao_text(of_ao(error_statistic), of_ao("mean_truth"), of_ao("mean_raster").value);
    if (!warning.empty()) answers.push_back(fmt::format("warning: {}: {}", run.name, warning));
  }
  if (compares_filters(runs, compared)) answers.push_back("warning: " + filter_warning(filter_remedy("--run.metrics")));
  return answers;
}

}  // namespace umbrameter
