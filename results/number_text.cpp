#include "results/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbrameter {
namespace {

// Without the sign of a number that is rounded to 0.
std::string rounded(double number, int decimals) {
  const std::string text = fmt::format("{:.{}f}", number, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals) : text;
}

}  // namespace

int decimals_of(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return 0;
  constexpr double rounding = 1e-9;  // 0.1 may have become 0.0999999999999
  const double power = std::floor(std::log10(std::abs(number) * (1.0 + rounding)));
  return std::clamp(digits - 1 - static_cast<int>(power), 0, 9);
}

std::string share_text(double share) { return fmt::format("{:.4f}", 100.0 * share); }

std::string percent(double share) {
  if (!std::isfinite(share)) return "—";
  const double value = 100.0 * share;
  if (value != 0.0 && std::abs(value) < 0.0001) return fmt::format("{:.0e} %", value);
  return fmt::format("{:.{}f} %", value, decimals_of(value, 3));
}

std::string percent(const Estimate& share) {
  if (!std::isfinite(share.value)) return "—";
  if (!(share.upper > share.lower)) return percent(share.value);
  return estimate_text({100.0 * share.value, 100.0 * share.lower, 100.0 * share.upper}, "%");
}

std::string estimate_text(const Estimate& estimate, std::string_view unit) {
  const int decimals = decimals_of(0.5 * (estimate.upper - estimate.lower), 2);
  return fmt::format("{}{}{} [{}, {}]", rounded(estimate.value, decimals), unit.empty() ? "" : " ", unit,
                     rounded(estimate.lower, decimals), rounded(estimate.upper, decimals));
}

std::string length_text(const Length& any) {
  return any.unit == LengthUnit::metres ? metres_text(any.number)
                                        : fmt::format("{:.4g} {}", any.number, unit_name(any.unit));
}

std::string metres_text(double metres, int digits) {
  if (!std::isfinite(metres)) return "—";
  const double size = std::abs(metres);
  if (size >= 1000.0) return fmt::format("{:.{}g} km", metres / 1000.0, digits);
  if (size < 1e-9) return "0 m";
  if (size >= 1.0) return fmt::format("{:.{}g} m", metres, digits);
  if (size >= 0.01) return fmt::format("{:.{}g} cm", metres * 100.0, digits);
  return fmt::format("{:.{}g} mm", metres * 1000.0, digits);
}

std::string short_text(const Value& value) {
  const auto* real = std::get_if<double>(&value);
  return real != nullptr ? fmt::format("{:.6g}", *real) : to_string(value);
}

}  // namespace umbrameter
