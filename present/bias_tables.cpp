#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "present/bias_formulas.h"
#include "present/plateau_text.h"
#include "present/plot_axes.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_console_curves = 6;
constexpr std::size_t max_rows_by_slope = 400;

const Value nothing = std::string();

Value known(double number) { return std::isfinite(number) ? Value(number) : nothing; }

// A value of an axis, as it was given.
Value on_axis(const std::vector<double>& axis, double value) {
  return with_minus(fmt::format("{:.{}g}", value, digits_on_axis(axis, value)));
}

// In metres, of an axis in `unit`.
Value metres_of(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  return curves.unit == LengthUnit::metres ? on_axis(curves.constants, cell.constant)
                                           : known(in_units(curves, curve, cell).metres);
}
Value texels_of(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  return curves.unit == LengthUnit::texels ? on_axis(curves.constants, cell.constant)
                                           : known(in_units(curves, curve, cell).texels);
}
Value depth_of(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  if (curves.unit == LengthUnit::map_depth) return on_axis(curves.constants, cell.constant);
  const double depth = in_units(curves, curve, cell).depth;
  return std::isfinite(depth) ? Value(depth_text(depth)) : nothing;
}

// One recommended bias of one curve.
struct NamedBias {
  const char* name;
  std::optional<BiasCell> cell;
};

std::vector<NamedBias> choices_of(const BiasCurve& curve, const BiasCurves& curves) {
  const BiasOptima& optima = curve.optima;
  const BiasLine& line = flattest(optima);
  std::optional<BiasCell> recommended;
  if (curve.plateau && !curve.withheld) recommended = curve.plateau->recommended;
  std::vector<NamedBias> choices = {{"recommended", recommended},
                                    {formula_names[0], least_error(optima)},
                                    {formula_names[1], line.little_acne},
                                    {formula_names[2], line.acne_free},
                                    {"least error without acne", best_without_acne(optima)},
                                    {"knee of the Pareto front", knee(optima.front)}};
  if (!curves.varies_constant) {
    choices.erase(choices.begin() + 2, choices.begin() + 4);
    choices.erase(choices.begin());
  }
  return choices;
}

Table choices_table(const BiasCurves& curves) {
  Table table;
  table.columns = curves.others;
  const std::vector<Column> rest = {
      {"choice", "",
       std::string("which bias; 'acne at most 0.1 %' and 'no acne' are the smallest such") +
           (curves.varies_slope ? ", at the slope-scaled bias nearest to 0" : "")},
      {"constant bias", "m", "along the light"},
      {"in texels", "texels",
       "multiple of the texel size at each receiver; metres are converted at the mean texel size"},
      {"in depth", "1", "constant bias in the depth that the map stores, from 0 to 1"},
      {"slope bias", "texels", "slope-scaled bias"},
      {"error", "%", "mean absolute error of visibility"},
      {"extra error", "percentage points", "error minus that of 'least error'"}};
  table.columns.insert(table.columns.end(), rest.begin(), rest.end());
  for (const Cause cause : {Cause::acne, Cause::false_occlusion, Cause::peter_panning, Cause::light_leak}) {
    table.columns.push_back({std::string(cause_title(cause)), "%", std::string(cause_meaning(cause))});
    if (cause != Cause::peter_panning) continue;
    table.columns.push_back({"extra peter-panning", "percentage points", "peter-panning minus that of 'least error'"});
  }
  for (const BiasCurve& curve : curves.curves) {
    const BiasCell least = *least_error(curve.optima);
    for (const NamedBias& choice : choices_of(curve, curves)) {
      std::vector<Value> row = curve.others;
      row.push_back(std::string(choice.name));
      if (!choice.cell) {
        row.emplace_back("—");
        row.resize(table.columns.size(), nothing);
        table.rows.push_back(std::move(row));
        continue;
      }
      const BiasCell& cell = *choice.cell;
      const std::vector<Value> values = {metres_of(curves, curve, cell),
                                         texels_of(curves, curve, cell),
                                         depth_of(curves, curve, cell),
                                         on_axis({}, cell.slope),
                                         100.0 * cell.mae,
                                         100.0 * (cell.mae - least.mae),
                                         100.0 * cell.acne,
                                         100.0 * cell.false_occlusion,
                                         100.0 * cell.peter_panning,
                                         100.0 * (cell.peter_panning - least.peter_panning),
                                         100.0 * cell.leak};
      row.insert(row.end(), values.begin(), values.end());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table slopes_table(const BiasCurves& curves) {
  Table table;
  table.columns = curves.others;
  const std::vector<Column> rest = {
      {"slope bias", "texels", "slope-scaled bias"},
      {"least error", "%", "of all constant biases at this slope bias"},
      {"at", "m", "constant bias of least error"},
      {"at, in texels", "texels", "the same as a multiple of the texel size at each receiver"},
      {"acne at most 0.1 % from", "m", "smallest such constant bias"},
      {"from, in texels", "texels", "the same as a multiple of the texel size at each receiver"},
      {"no acne from", "m", "smallest such constant bias"},
      {"none from, in texels", "texels", "the same as a multiple of the texel size at each receiver"}};
  table.columns.insert(table.columns.end(), rest.begin(), rest.end());
  for (const BiasCurve& curve : curves.curves) {
    for (const BiasLine& line : curve.optima.lines) {
      if (!line.least_error || table.rows.size() >= max_rows_by_slope) continue;
      std::vector<Value> row = curve.others;
      row.insert(row.end(), {line.slope, 100.0 * line.least_error->mae});
      for (const std::optional<BiasCell>& cell : {line.least_error, line.little_acne, line.acne_free}) {
        row.push_back(cell ? metres_of(curves, curve, *cell) : nothing);
        row.push_back(cell ? texels_of(curves, curve, *cell) : nothing);
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

// No axis of biases justifies more digits. The values of the axes, in front, stay as they are.
Table in_digits(Table table, std::size_t first_column) {
  for (std::vector<Value>& row : table.rows) {
    for (std::size_t c = first_column; c < row.size(); ++c) {
      if (const auto* const number = std::get_if<double>(&row[c])) row[c] = digits_text(*number);
    }
  }
  return table;
}

// A value of the axis, as it was given.
std::string on_axis_text(const BiasCurves& curves, double constant) {
  const int digits = digits_on_axis(curves.constants, constant);
  return curves.unit == LengthUnit::metres
             ? metres_text(constant, digits)
             : with_minus(fmt::format("{:.{}g} {}", constant, digits, unit_name(curves.unit)));
}

// "3.6 texels (4.28 cm on average)".
std::string constant_text(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  const BiasInUnits bias = in_units(curves, curve, cell);
  const int digits = digits_of_step(curves.constants, cell.constant);
  std::string text = on_axis_text(curves, cell.constant);
  const char* average = curve.texels_differ ? " on average" : "";
  if (curves.unit == LengthUnit::texels) {
    text += fmt::format(" ({}{})", metres_text(bias.metres, digits), average);
  } else if (std::isfinite(bias.texels)) {
    text += with_minus(fmt::format(" ({:.{}g} texels{})", halves_up(bias.texels), digits, average));
  }
  return text;
}

// What the sweep says of one curve, after the name of its setting.
std::string answer_of(const BiasCurves& curves, const BiasCurve& curve) {
  const BiasCell least = *least_error(curve.optima);
  const std::string least_text =
      fmt::format("least error {} at {}", percent(least.mae), bias_text(curves, curve, least));
  if (!curve.plateau) return least_text;
  const BiasPlateau& plateau = *curve.plateau;
  if (curve.withheld) {
    return fmt::format("no bias recommended: {}; {}", withheld_text(*curve.withheld, curve.evidence), least_text);
  }
  const BiasCell& recommended = plateau.recommended;
  std::string text = fmt::format(
      "use bias {}{}{}: error {}{}; {}{}", bias_text(curves, curve, recommended), reason_text(plateau),
      least_error_text(plateau), percent(recommended.mae),
      plateau.has_little_acne() ? "" : ", acne " + percent(recommended.acne),
      plateau.first.constant == plateau.last.constant ? "" : "swept biases from ",
      range_text(plateau, curves.unit, "error", percent(plateau.least.mae), only_of_axis, curves.constants));
  if (!plateau.has_little_acne()) {
    const auto line = std::ranges::find(curve.optima.lines, recommended.slope, &BiasLine::slope);
    const std::optional<BiasCell>& little = line->little_acne;
    text += less_acne_text(little, little ? constant_text(curves, curve, *little) : "", true);
  }
  if (plateau.open_below || plateau.open_above) text += "; the range may go on beyond the axis";
  if (curve.coarse) {
    text += fmt::format("; between {} and {} a bias that was not swept may have less than half this error",
                        on_axis_text(curves, curve.coarse->first), on_axis_text(curves, curve.coarse->second));
  }
  return text;
}

std::string explanation(const BiasCurves& curves) {
  std::string text =
      "\n\nThe table 'Recommended biases' gives each constant bias in metres along the light, in texels and as "
      "normalised depth";
  if (curves.varies_constant) {
    text +=
        std::string("; a dash means that no bias of the axis qualifies") +
        (std::ranges::any_of(curves.curves, [](const BiasCurve& curve) { return curve.withheld.has_value(); })
             ? " or, at 'recommended', that none is recommended: the answer or a remark below the table says why. "
             : ". ") +
        rule_text() +
        " 'Acne at most 0.1 %' and 'no acne' are the smallest such biases, whatever their error; 'least error without "
        "acne' is the best of those without any";
    if (curves.varies_slope) text += ", at the slope-scaled bias nearest to 0";
  }
  text += ". 'Extra error' and 'extra peter-panning' compare each choice with 'least error'.";
  if (curves.formulas.empty()) {
    text +=
        " A sweep of the constant bias over a second axis (resolution, light, camera or filter) also fits a formula "
        "that gives the bias from it; this one has none.";
  }
  if (curves.curves.size() < curves.combinations) {
    text += fmt::format(" The table lists {} of {} combinations of the other axes.", curves.curves.size(),
                        curves.combinations);
  }
  return text;
}

}  // namespace

std::string bias_text(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  const std::string text = constant_text(curves, curve, cell);
  return curves.varies_slope ? text + ", slope-scaled bias " + with_unit(to_string(on_axis({}, cell.slope)), "texels")
                             : text;
}

void present_bias(Presentation& presentation, const BiasCurves& curves) {
  ReportSection& section = presentation.section;
  section.text += explanation(curves);
  section.tables.push_back({"Recommended biases",
                            in_digits(choices_table(curves), curves.others.size()),
                            {"in texels", "in depth", "extra error", "extra peter-panning"}});
  if (std::ranges::any_of(curves.curves, &BiasCurve::texels_differ))
    section.tables.back().remarks.push_back(average_text(curves.unit));
  // The answers give the reasons of those before.
  for (std::size_t c = max_console_curves; c < curves.curves.size(); ++c) {
    const BiasCurve& curve = curves.curves[c];
    if (!curve.plateau || !curve.withheld) continue;
    section.tables.back().remarks.push_back(fmt::format("{}: no bias recommended: {}.",
                                                        setting_text(curves.others, curve.others),
                                                        withheld_text(*curve.withheld, curve.evidence)));
  }
  if (curves.varies_slope && curves.varies_constant)
    section.tables.push_back({"Constant biases by slope-scaled bias",
                              in_digits(slopes_table(curves), curves.others.size() + 1),
                              {"at, in texels", "from, in texels", "none from, in texels"}});
  present_formulas(presentation, curves);

  std::size_t printed = 0;
  for (const BiasCurve& curve : curves.curves) {
    if (printed++ == max_console_curves) {
      presentation.answers.push_back(fmt::format("… and {} more: see the table 'Recommended biases' of the report",
                                                 curves.curves.size() - max_console_curves));
      break;
    }
    const std::string setting = setting_text(curves.others, curve.others);
    presentation.answers.push_back((setting.empty() ? "" : setting + ": ") + answer_of(curves, curve));
  }
}

}  // namespace umbrameter
