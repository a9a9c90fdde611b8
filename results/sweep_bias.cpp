#include "results/sweep_bias.h"

#include <cmath>

#include "results/number_text.h"

namespace umbrameter {

BiasInUnits in_units(const BiasCurves& curves, const BiasCurve& curve, const BiasCell& cell) {
  return in_units(Length{cell.constant, curves.unit}, curve.optima.mean_texel, curve.depth_unit);
}

std::string setting_text(const std::vector<Column>& columns, const std::vector<Value>& values) {
  std::string text;
  for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i) {
    text += (i > 0 ? ", " : "") + columns[i].name.substr(columns[i].name.find('.') + 1) + " " + short_text(values[i]);
  }
  return text;
}

Fitted rounded(const Fitted& fitted) {
  const double error = fitted.standard_error;
  if (!(error > 0.0) || !std::isfinite(error)) return fitted;
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(error)));
  const double scale = std::pow(10.0, std::abs(decimals));  // exact, unlike its reciprocal
  const auto round = [&](double number) {
    return decimals < 0 ? std::round(number / scale) * scale : std::round(number * scale) / scale;
  };
  return {round(fitted.value), round(error)};
}

}  // namespace umbrameter
