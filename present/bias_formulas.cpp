#include "present/bias_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/number_text.h"

namespace umbrameter {
namespace {

int power_of(double number) { return static_cast<int>(std::floor(std::log10(std::abs(number)))); }

// As many significant digits as leave two of the standard error.
int digits_of(const Fitted& fitted) {
  const double error = fitted.standard_error;
  if (!(error > 0.0) || fitted.value == 0.0) return 3;
  return std::clamp(power_of(fitted.value) - power_of(error) + 2, 1, 4);
}

std::string factor_text(const Fitted& fitted) {
  return fmt::format("{:#.{}g}", std::abs(fitted.value), digits_of(fitted));
}

const char* sign_of(const Fitted& fitted) { return fitted.value < 0.0 ? " − " : " + "; }

}  // namespace

std::optional<Fitted> printed_term(const BiasFormula& formula, FormulaTerm which) {
  const std::optional<Fitted>& term = formula.term(which);
  if (!term || rounded(*term).value == 0.0) return std::nullopt;
  return rounded(*term);
}

std::string formula_text(const BiasFormula& formula) {
  const std::optional<Fitted> constant = printed_term(formula, FormulaTerm::constant);
  const std::optional<Fitted> slope = printed_term(formula, FormulaTerm::slope);
  const std::optional<Fitted> radius = printed_term(formula, FormulaTerm::slope_radius);
  const std::optional<Fitted> step = printed_term(formula, FormulaTerm::depth_step);
  std::string text;
  const auto add = [&](bool is_negative, const std::string& term) {
    text += text.empty() ? (is_negative ? "−" : "") : is_negative ? " − " : " + ";
    text += term;
  };
  if (constant) add(false, metres_text(constant->value, digits_of(*constant)));
  if (slope && radius) {
    add(false, fmt::format("({}{}{}{}·r)·Δz", slope->value < 0.0 ? "−" : "", factor_text(*slope), sign_of(*radius),
                           factor_text(*radius)));
  } else if (slope) {
    add(slope->value < 0.0, factor_text(*slope) + "·Δz");
  } else if (radius) {
    add(radius->value < 0.0, factor_text(*radius) + "·r·Δz");
  }
  if (step) add(step->value < 0.0, factor_text(*step) + "·δ");
  return "bias ≈ " + (text.empty() ? "0" : text);
}

std::string errors_text(const BiasFormula& formula) {
  std::string printed;
  std::string left_out;
  const auto add = [&](FormulaTerm which, const char* what) {
    const std::optional<Fitted>& term = formula.term(which);
    if (!term) return;
    const bool is_length = which == FormulaTerm::constant;
    const std::string error =
        is_length ? metres_text(term->standard_error, 2) : fmt::format("{:.2g}", term->standard_error);
    if (printed_term(formula, which)) {
      printed += fmt::format("{}{} {}", printed.empty() ? "standard errors: " : ", ", what, error);
    } else {
      left_out += fmt::format("{}the {} rounds to 0 (standard error {}) and is left out", left_out.empty() ? "" : "; ",
                              what, error);
    }
  };
  add(FormulaTerm::constant, "constant");
  add(FormulaTerm::slope, "factor of Δz");
  add(FormulaTerm::slope_radius, "factor of r·Δz");
  add(FormulaTerm::depth_step, "factor of δ");
  return printed + (printed.empty() || left_out.empty() ? "" : "; ") + left_out;
}

std::string symbols_text(std::span<const CurveFormula* const> formulas) {
  const auto has = [&](FormulaTerm term) {
    return std::ranges::any_of(
        formulas, [&](const CurveFormula* of) { return of->formula && printed_term(*of->formula, term).has_value(); });
  };
  std::string text;
  const auto add = [&](bool is_used, const char* meaning) {
    if (is_used) text += (text.empty() ? "" : "; ") + std::string(meaning);
  };
  add(has(FormulaTerm::slope) || has(FormulaTerm::slope_radius),
      "Δz: how much a surface's depth changes from one texel to the next, texel size · tan θ · (|cos ψ| + |sin ψ|), "
      "with θ between light and normal and ψ the direction of the slope on the map; each point of the fit has the "
      "90th percentile of Δz over its counted pixels");
  add(has(FormulaTerm::slope_radius), "r: reach of the filter in texels");
  add(has(FormulaTerm::depth_step), "δ: step of the stored depth");
  return text;
}

}  // namespace umbrameter
