#include "present/plot_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace umbrameter {

std::string label_of(const SweepAxis& axis) {
  std::string label = axis.key.substr(axis.key.find('.') + 1);
  std::replace(label.begin(), label.end(), '-', ' ');
  return label + (axis.unit.empty() || axis.unit == "1" ? "" : " [" + axis.unit + "]");
}

bool is_logarithmic(const SweepAxis& axis) {
  std::vector<double> values;
  for (const Value& value : axis.values) {
    if (!std::holds_alternative<double>(value) && !std::holds_alternative<std::int64_t>(value)) return false;
    values.push_back(to_number(value));
  }
  std::ranges::sort(values);
  if (values.size() < 2 || values.front() <= 0.0) return false;
  if (axis.text.ends_with(":log") || axis.key.ends_with("resolution")) return true;
  constexpr double slack = 0.01;  // of a ratio: lists are written with few digits
  const double ratio = values[1] / values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (std::abs(values[i] / values[i - 1] / ratio - 1.0) > slack) return false;
  }
  return values.size() > 2 && values.back() / values.front() > 2.0;
}

int digits_of_step(const std::vector<double>& axis, double value) {
  const auto place = std::lower_bound(axis.begin(), axis.end(), value);
  const bool is_between = place != axis.begin() && place != axis.end() && std::next(place) != axis.end();
  if (!is_between || value == 0.0) return 3;
  const double step = 0.5 * (*std::next(place) - *std::prev(place)) / std::abs(value);
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step))), 3, 6);
}

int digits_on_axis(const std::vector<double>& axis, double value) {
  constexpr int most = 6;  // more are those of a computed value
  const int of_step = digits_of_step(axis, value);
  for (int digits = of_step; digits <= most; ++digits) {
    const double printed = std::stod(fmt::format("{:.{}g}", value, digits));
    if (std::abs(printed - value) <= 1e-12 * std::abs(value)) return digits;
  }
  return of_step;
}

Thinned thin(std::size_t count, std::size_t most) {
  Thinned thinned;
  while (count > 1 && (count - 2) / thinned.step + 2 > most) ++thinned.step;
  for (std::size_t i = 0; i < count; i += thinned.step) thinned.indices.push_back(i);
  if (thinned.indices.back() != count - 1) thinned.indices.push_back(count - 1);
  return thinned;
}

std::string thinning_text(const Thinned& thinned, const std::string& key) {
  if (thinned.step == 1) return "";
  return fmt::format(" The figure shows one of every {1} values of {0}; sweep.csv has all.", key, thinned.step);
}

}  // namespace umbrameter
