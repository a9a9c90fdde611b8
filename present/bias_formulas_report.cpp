#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/lists.h"
#include "present/bias_formulas.h"
#include "present/summary.h"
#include "reports/files/value_json.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* method =
    "least squares over all points, each weighted by 1 / h², where h is the step of the bias axis at the point";

constexpr std::size_t max_formula_plots = 3;

const Value empty_cell = std::string();
const char* name_of(const CurveFormula& of) { return formula_names[static_cast<std::size_t>(of.of)]; }

std::string range_text(const FormulaRange& range, const auto& text_of) {
  if (range.values == 0) return "unknown";
  const std::string min = text_of(range.min);
  const std::string max = text_of(range.max);
  return min == max ? min : min + " to " + max;
}
std::string length_range(const FormulaRange& range) {
  return range_text(range, [](double metres) { return metres_text(metres); });
}
std::string texel_range(const FormulaRange& range) {
  return range_text(range, [](double texels) { return fmt::format("{:.3g}", texels); });
}

// What is below it is rounding.
bool has_no_residual(const BiasFormula& formula) { return formula.residual < formula_rounding * formula.axis_step; }

std::string residual_text(const BiasFormula& formula) {
  if (has_no_residual(formula)) return "RMS residual 0, so that the standard errors are those of the bias axis's step";
  return fmt::format("RMS residual {}, largest {}", metres_text(formula.residual, 2),
                     metres_text(formula.worst_residual, 2));
}

std::string points_text(const CurveFormula& of) {
  const std::size_t independent = of.formula->independent;
  if (independent == of.points.size()) return fmt::format("{} points", independent);
  return fmt::format("{} points, of which {} are independent", of.points.size(), independent);
}

std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string names_of(const std::vector<Column>& columns) { return joined(columns, ", ", &Column::name); }

// Of terms that no formula has.
void drop_empty_columns(Table& table) {
  for (std::size_t c = table.columns.size(); c-- > 0;) {
    const auto is_empty = [&](const std::vector<Value>& row) { return row[c] == empty_cell; };
    if (!std::ranges::all_of(table.rows, is_empty)) continue;
    const auto place = static_cast<std::ptrdiff_t>(c);
    table.columns.erase(table.columns.begin() + place);
    for (std::vector<Value>& row : table.rows) row.erase(row.begin() + place);
  }
}

Table formulas_table(const BiasCurves& curves) {
  Table table;
  table.columns = curves.of_a_formula;
  const std::vector<Column> rest = {
      {"formula of", "",
       std::string("which bias is fitted") + (curves.varies_slope ? ", at the slope-scaled bias nearest to 0" : "")},
      {"points", "1", "fitted points: one for each combination of the swept parameters other than the bias"},
      {"independent points", "1",
       "those that differ in texel size, Δz, filter radius or depth step; only they count in the standard errors"},
      {"left out", "1", "combinations without such a bias on the axis, or whose bias may lie beyond its end"},
      {"constant part", "m", "the bias less the other terms"},
      {"error of the constant part", "m", "standard error"},
      {"factor of Δz", "1", "Δz: change of the surface's depth from texel to texel"},
      {"error for Δz", "1", "standard error"},
      {"factor of r·Δz", "1/texels", "r: filter radius"},
      {"error for r·Δz", "1/texels", "standard error"},
      {"factor of δ", "1", "δ: depth step"},
      {"error for δ", "1", "standard error"},
      {"residual", "", "RMS residual"},
      {"residual in texels", "texels", "the same in texels of each point"},
      {"largest residual", "", "at the worst point"},
      {"texel sizes", "", "of the points"},
      {"Δz", "", "of the points"},
      {"filter radius", "texels", "of the points"},
      {"depth step", "", "of the stored depth, on average over the counted pixels of each point"}};
  table.columns.insert(table.columns.end(), rest.begin(), rest.end());
  for (const CurveFormula& of : curves.formulas) {
    std::vector<Value> row = of.others;
    row.emplace_back(std::string(name_of(of)));
    row.emplace_back(static_cast<std::int64_t>(of.points.size()));
    row.emplace_back(
        static_cast<std::int64_t>(of.formula ? of.formula->independent : support_of(of.points).independent));
    row.emplace_back(static_cast<std::int64_t>(of.left_out));
    if (of.formula) {
      const BiasFormula& formula = *of.formula;
      for (const std::optional<Fitted>& fitted : formula.terms) {
        if (fitted) {
          const Fitted shown = rounded(*fitted);
          row.insert(row.end(), {shown.value + 0.0, shown.standard_error});  // no −0
        } else {
          row.insert(row.end(), 2, empty_cell);
        }
      }
      const bool is_0 = has_no_residual(formula);
      row.insert(
          row.end(),
          {is_0 ? "0" : metres_text(formula.residual, 2), is_0 ? "0" : digits_text(formula.residual_texels, 2),
           is_0 ? "0" : metres_text(formula.worst_residual, 2), length_range(formula.texel),
           length_range(formula.depth_per_texel), texel_range(formula.radius), length_range(formula.depth_step)});
    }
    row.resize(table.columns.size(), empty_cell);
    table.rows.push_back(std::move(row));
  }
  drop_empty_columns(table);
  return table;
}

std::vector<std::string> warnings_of(const CurveFormula& of) { return of.warnings; }
std::vector<std::string> refused_of(const CurveFormula& of) {
  std::vector<std::string> reasons = of.formula ? of.formula->refused : std::vector<std::string>();
  for (std::string& reason : reasons) reason.insert(0, "no term for ");
  return reasons;
}

// Each different remark on these formulas once, with the formulas that it is about.
std::vector<std::string> remarks_on(std::span<const CurveFormula* const> formulas,
                                    std::vector<std::string> (*remarks_of)(const CurveFormula&)) {
  std::vector<std::pair<std::string, std::string>> lines;  // remark, names
  for (const CurveFormula* of : formulas) {
    for (const std::string& warning : remarks_of(*of)) {
      const auto found = std::ranges::find_if(lines, [&](const auto& line) { return line.first == warning; });
      if (found == lines.end()) {
        lines.emplace_back(warning, name_of(*of));
      } else {
        found->second += std::string(", ") + name_of(*of);
      }
    }
  }
  std::vector<std::string> texts;
  for (const auto& [remark, names] : lines) {
    const bool are_many = names.find(", ") != std::string::npos;
    texts.push_back(fmt::format("{} ({}): {}", are_many ? "formulas" : "formula", names, remark));
  }
  return texts;
}

// The formulas at one combination of the axes that are not in the formulas.
std::vector<const CurveFormula*> formulas_at(const BiasCurves& curves, const std::vector<Value>& others) {
  std::vector<const CurveFormula*> formulas;
  for (const CurveFormula& of : curves.formulas) {
    if (of.others == others) formulas.push_back(&of);
  }
  return formulas;
}

std::vector<std::vector<Value>> settings_of(const BiasCurves& curves) {
  std::vector<std::vector<Value>> settings;
  for (const CurveFormula& of : curves.formulas) {
    if (settings.empty() || settings.back() != of.others) settings.push_back(of.others);
  }
  return settings;
}

std::string ranges_text(const BiasFormula& formula) {
  const std::string texels = texel_range(formula.slope);
  const bool is_each = formula.depth_per_texel.values > 1 && texels.find(" to ") == std::string::npos;
  std::string text =
      fmt::format("fitted over texel sizes of {}, Δz of {} ({} times the texel size{})", length_range(formula.texel),
                  length_range(formula.depth_per_texel), texels, is_each ? " at each point of the fit" : "");
  if (printed_term(formula, FormulaTerm::slope_radius))
    text += fmt::format(", r of {} texels", texel_range(formula.radius));
  if (printed_term(formula, FormulaTerm::depth_step)) text += ", δ of " + length_range(formula.depth_step);
  return text;
}

// Over the resolution alone, the bias against the texel size; else what each formula misses at each of its points.
PlotFigure formula_plot(const BiasCurves& curves, const std::vector<Value>& setting) {
  const bool is_over_texel = curves.formula_axes.size() == 1 && curves.formula_axes.front().name == resolution_key;
  PlotFigure plot;
  plot.stem = is_over_texel ? "bias_fit" : "formula";
  plot.title = is_over_texel ? "Bias against texel size" : "Bias by the formula less the measured bias";
  plot.conditions = setting_text(curves.of_a_formula, setting);
  plot.caption = is_over_texel ? "Rings: the measured biases, one for each resolution and formula. Lines: the biases "
                                 "that each formula predicts for the same resolutions."
                               : fmt::format(
                                     "Points: one for each combination of {}. Above 0 the formula's bias is "
                                     "larger.",
                                     names_of(curves.formula_axes));
  plot.series = "formula";
  plot.series_label = "formula of";
  plot.is_scatter = !is_over_texel;
  if (is_over_texel) plot.mark = "measured";
  for (const char* name : {"x", "y", "formula", "measured"}) plot.data.columns.push_back({name, "", ""});
  double least = std::numeric_limits<double>::infinity();
  double largest = -least;
  for (const CurveFormula* of : formulas_at(curves, setting)) {
    if (!of->formula) continue;
    for (const FormulaPoint& point : of->points) {
      const double bias = bias_of(*of->formula, point);
      if (!std::isfinite(bias)) continue;
      const std::string name = name_of(*of);
      if (is_over_texel) {
        plot.data.rows.push_back({point.texel, bias, name, false});
        plot.data.rows.push_back({point.texel, point.bias, name, true});
        continue;
      }
      const double missed = bias - point.bias;
      const bool is_rounding = std::abs(missed) < formula_rounding * of->formula->axis_step;
      least = std::min(least, point.bias);
      largest = std::max(largest, point.bias);
      plot.data.rows.push_back({point.bias, is_rounding ? 0.0 : missed / point.texel, name, true});
    }
    plot.caption +=
        fmt::format(" {}: {}, {}.", sentence(name_of(*of)), formula_text(*of->formula), residual_text(*of->formula));
  }
  if (const std::string symbols = symbols_text(formulas_at(curves, setting)); !symbols.empty())
    plot.caption += " " + symbols + ".";
  plot.x = {"x", "measured bias [m]", least > 0.0 && largest > 10.0 * least};
  plot.x.round_ticks = true;
  plot.y = {"y", "formula less measured bias [texels]"};
  if (is_over_texel) {
    plot.x.label = "mean texel size [m]";
    plot.y.label = "constant bias [m]";
  }
  return plot;
}

// The ranges of the formulas of one setting: once where all have the same.
// "fitted over ...", or for each range "Least error: fitted over ..." where they differ; without the last full stop.
std::string ranges_of(const std::vector<const CurveFormula*>& formulas) {
  std::vector<std::pair<std::string, std::string>> ranges;  // text, names
  for (const CurveFormula* of : formulas) {
    if (!of->formula) continue;
    const std::string text = ranges_text(*of->formula);
    const auto found = std::ranges::find_if(ranges, [&](const auto& each) { return each.first == text; });
    if (found == ranges.end()) {
      ranges.emplace_back(text, name_of(*of));
    } else {
      found->second += std::string(", ") + name_of(*of);
    }
  }
  if (ranges.size() == 1) return ranges.front().first;
  return joined(ranges, "; ", [](const auto& each) { return each.second + ": " + each.first; });
}

Json range_json(const FormulaRange& range) { return {range.min, range.max}; }

// The right side of "bias =", in metres, as C, GLSL and HLSL have it.
std::string expression(const BiasFormula& formula) {
  constexpr std::array<const char*, formula_term_count> lengths = {"", " * depth_per_texel",
                                                                   " * radius * depth_per_texel", " * depth_step"};
  std::string text;
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    const std::optional<Fitted> fitted = printed_term(formula, static_cast<FormulaTerm>(t));
    if (!fitted) continue;
    const double value = text.empty() ? fitted->value : std::abs(fitted->value);
    text += fmt::format("{}{:.6g}{}", text.empty() ? "" : fitted->value < 0.0 ? " - " : " + ", value, lengths[t]);
  }
  return text.empty() ? "0" : text;
}

Json formula_json(const BiasCurves& curves, const CurveFormula& of) {
  Json object = {{"bias", name_of(of)},           {"at", row_json(curves.of_a_formula, of.others)},
                 {"slope_bias_texels", of.slope}, {"points", of.points.size()},
                 {"left_out", of.left_out},       {"warnings", of.warnings}};
  if (!of.formula) return object;
  const BiasFormula& formula = *of.formula;
  constexpr std::array<const char*, formula_term_count> keys = {"c0_m", "per_depth_per_texel",
                                                                "per_radius_and_depth_per_texel", "per_depth_step"};
  object["independent_points"] = formula.independent;
  object["bias_m"] = expression(formula);
  for (std::size_t t = 0; t < formula_term_count; ++t) {
    if (const std::optional<Fitted>& term = formula.terms[t])
      object[keys[t]] = {{"value", term->value}, {"standard_error", term->standard_error}};
  }
  object["not_in_the_formula"] = formula.refused;
  object["residual_m"] = formula.residual;
  object["residual_texels"] = formula.residual_texels;
  object["largest_residual_m"] = formula.worst_residual;
  object["fitted_over"] = {{"texel_m", range_json(formula.texel)},
                           {"depth_per_texel_m", range_json(formula.depth_per_texel)},
                           {"depth_per_texel_texels", range_json(formula.slope)},
                           {"depth_step_m", range_json(formula.depth_step)}};
  if (formula.radius.values > 0) object["fitted_over"]["radius_texels"] = range_json(formula.radius);
  return object;
}

}  // namespace

void present_formulas(Presentation& presentation, const BiasCurves& curves) {
  if (curves.formulas.empty()) return;
  ReportSection& section = presentation.section;
  if (std::ranges::none_of(curves.formulas, [](const CurveFormula& of) { return of.formula.has_value(); })) {
    std::array<std::size_t, formula_names.size()> inside{};
    std::size_t needed = 0;
    std::size_t distinct = 0;
    for (const CurveFormula& of : curves.formulas) {
      const FormulaSupport support = support_of(of.points);
      std::size_t& independent = inside[static_cast<std::size_t>(of.of)];
      independent = std::max(independent, support.independent);
      needed = std::max(needed, support.needed);
      distinct = std::max(distinct, of.distinct);
    }
    std::string counts;
    for (std::size_t f = 0; f < formula_names.size(); ++f)
      counts += fmt::format("{}{} for {}", counts.empty() ? "" : ", ", inside[f], formula_names[f]);
    const std::string text =
        fmt::format(
            "no formula for the bias over {}: one needs {} combinations that differ in texel size, depth per "
            "texel Δz, filter radius or depth step; ",
            names_of(curves.formula_axes), needed) +
        (distinct < needed
             ? fmt::format("there {} {}; vary more values, such as more resolutions", distinct == 1 ? "is" : "are",
                           distinct)
             : fmt::format("{} do, but not enough of them have their bias inside the axis{} ({}); extend the axis of "
                           "the bias",
                           distinct, curves.varies_slope ? " at the slope-scaled bias nearest to 0" : "", counts));
    section.text += "\n\nThere is " + text + ".";
    return;
  }
  section.tables.push_back({"Formulas of the bias",
                            formulas_table(curves),
                            {"left out", "error of the constant part", "error for Δz", "error for r·Δz", "error for δ",
                             "residual in texels", "largest residual"}});
  const std::vector<const CurveFormula*> all = mapped(curves.formulas, [](const CurveFormula& of) { return &of; });
  const std::string symbols = symbols_text(all);
  section.text += fmt::format(
      "\n\nThe table 'Formulas of the bias' predicts the bias for values of {} that were not swept, within the range "
      "that each formula was fitted over. Each is fitted to one point for each {}: {}. {}{}",
      names_of(curves.formula_axes),
      curves.formula_axes.size() == 1 ? "swept value" : "combination of the swept values", method, symbols,
      symbols.empty() ? "" : ".");
  const std::vector<std::vector<Value>> settings = settings_of(curves);
  for (std::size_t i = 0; i < std::min(settings.size(), max_formula_plots); ++i) {
    PlotFigure plot = formula_plot(curves, settings[i]);
    if (plot.data.rows.empty()) continue;
    if (settings.size() > 1) plot.stem += fmt::format("_{}", i);
    add_figure(presentation, std::move(plot));
  }
  for (const std::vector<Value>& setting : settings) {
    const std::vector<const CurveFormula*> formulas = formulas_at(curves, setting);
    const std::string at = setting.empty() ? "" : setting_text(curves.of_a_formula, setting) + ", ";
    for (const CurveFormula* of : formulas) {
      if (!of->formula) continue;
      const std::string slope = curves.varies_slope || of->slope != 0.0
                                    ? ", slope-scaled bias " + with_unit(fmt::format("{:g}", of->slope), "texels")
                                    : "";
      const std::string errors = errors_text(*of->formula);
      section.text +=
          fmt::format("\n\nFormula ({}{}{}): {}{}; {}; {}.", at, name_of(*of), slope, formula_text(*of->formula),
                      errors.empty() ? "" : "; " + errors, residual_text(*of->formula), points_text(*of));
    }
    if (const std::string ranges = ranges_of(formulas); !ranges.empty())
      section.text += "\n\n" + sentence(ranges) + ".";
    for (const std::string& reason : remarks_on(formulas, refused_of))
      section.text += "\n\n" + sentence(at + reason) + ".";
    for (const std::string& warning : remarks_on(formulas, warnings_of)) {
      section.text += "\n\nWarning: " + at + warning + ".";
    }
  }
}

nlohmann::ordered_json formulas_json(const BiasCurves& curves) {
  Json list = Json::array();
  for (const CurveFormula& of : curves.formulas) list.push_back(formula_json(curves, of));
  return list;
}

}  // namespace umbrameter
