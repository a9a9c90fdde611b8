// Formulas of the bias over the axes of a sweep besides biases, for engines: from the bias curves, as text, table,
// figure and JSON.
#pragma once

#include <span>

#include "present/bias_report.h"

namespace umbrameter {

/// Share of a step of the bias axis below which a length is the rounding of 0.
inline constexpr double formula_rounding = 1e-6;

/// "bias ≈ 0.31 mm + (0.502 + 1.003·r)·Δz", of printed_term().
std::string formula_text(const BiasFormula& formula);

/// "standard errors: factor of Δz 0.12; the constant, 0 within its standard error of 1.7 cm, is left out".
std::string errors_text(const BiasFormula& formula);

/// A term of the formula, rounded(); empty if it is absent or nothing of it is left.
std::optional<Fitted> printed_term(const BiasFormula& formula, FormulaTerm which);

/// The meaning of the symbols that formula_text() has for any of these formulas; empty if it has none.
std::string symbols_text(std::span<const CurveFormula* const> formulas);

/// Adds table, text and figures of what each formula misses at its points.
void present_formulas(Presentation& presentation, const BiasCurves& curves);

/// "formulas" of the curves in summary.json.
nlohmann::ordered_json formulas_json(const BiasCurves& curves);

}  // namespace umbrameter
