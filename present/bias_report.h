// The report of a sweep on the bias: recommended biases and fits from its rows, shown as tables, console lines, figures
// and in summary.json. Only for hard shadows, because it needs the causes of wrong taps.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "present/presentation.h"
#include "results/sweep_bias.h"

namespace umbrameter {

/// Adds the tables, a paragraph and lines for the console.
void present_bias(Presentation& presentation, const BiasCurves& curves);

/// A bias for people: "12.5 mm (0.43 texels)", with the slope-scaled bias if that is varied.
std::string bias_text(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell);
/// "curves" of summary.json.
nlohmann::ordered_json to_json(const BiasCurves& curves);

}  // namespace umbrameter
