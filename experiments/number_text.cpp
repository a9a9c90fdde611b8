#include "experiments/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbrameter {
namespace {

// Decimals with which a number shows that many significant digits.
int decimals_of(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(number)))), 0, 9);
}

}  // namespace

std::string share_text(double share) { return fmt::format("{:.4f}", 100.0 * share); }

std::string percent(double share) {
  if (!std::isfinite(share)) return "—";
  const double value = 100.0 * share;
  if (value != 0.0 && std::abs(value) < 0.0001) return fmt::format("{:.0e} %", value);
  return fmt::format("{:.{}f} %", value, decimals_of(value, 3));
}

std::string percent(const Estimate& share) {
  if (!std::isfinite(share.value)) return "—";
  const double half_width = 50.0 * (share.upper - share.lower);
  if (!(half_width > 0.0)) return percent(share.value);
  const int decimals = decimals_of(half_width, 2);
  return fmt::format("{:.{}f} % [{:.{}f}, {:.{}f}]", 100.0 * share.value, decimals, 100.0 * share.lower, decimals,
                     100.0 * share.upper, decimals);
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

}  // namespace umbrameter
