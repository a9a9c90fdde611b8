#include "results/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbrameter {
namespace {

std::string rounded(double number, int decimals) {
  return with_minus(fmt::format("{:.{}f}", halves_up(number), decimals));
}

// Halves that differ by less show as the same two digits or nearly so.
bool is_symmetric(const Estimate& estimate) {
  constexpr double slack = 0.1;  // of the half width
  const double below = estimate.value - estimate.lower;
  const double above = estimate.upper - estimate.value;
  if (estimate.lower == 0.0 && above > below) return false;  // ± would pass 0, where the interval was cut
  const double half = 0.5 * (estimate.upper - estimate.lower);
  const auto is_above_0 = [half](double end) { return end > 1e-9 * half; };
  const auto keeps_side = [&](double shown, double end) { return is_above_0(shown) == is_above_0(end); };
  if (!keeps_side(estimate.value - half, estimate.lower) || !keeps_side(estimate.value + half, estimate.upper))
    return false;
  return std::abs(above - below) <= slack * half;
}

}  // namespace

double halves_up(double number) { return number * (1.0 + std::numeric_limits<double>::epsilon()); }

int decimals_of(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return 0;
  constexpr double rounding = 1e-9;  // 0.1 may have become 0.0999999999999
  const double power = std::floor(std::log10(std::abs(number) * (1.0 + rounding)));
  return std::clamp(digits - 1 - static_cast<int>(power), 0, 9);
}

std::string depth_text(double depth) {
  return std::isfinite(depth) ? with_minus(fmt::format("{:.3g}", halves_up(depth))) : "—";
}

std::string with_minus(std::string text) {
  const bool is_0 = text.find_first_not_of("-0.") >= text.find(' ');
  if (text.starts_with('-')) text.replace(0, 1, is_0 ? "" : "−");
  return text;
}

std::string with_sign(std::string text) {
  text = with_minus(std::move(text));
  return text.find_first_of("123456789") >= text.find(' ') || text.starts_with("−") ? text : "+" + text;
}

std::string digits_text(double number, int digits) {
  constexpr double least_with_digits = 1e-4;
  constexpr double least_in_decimals = 1e-6;
  if (!std::isfinite(number)) return "—";
  if (number != 0.0 && std::abs(number) < least_in_decimals) return with_minus(fmt::format("{:.1g}", number));
  if (std::abs(number) < least_with_digits) return rounded(number, decimals_of(number, 1));
  // 9.996 is 10.0 and not 10.00.
  const int decimals = decimals_of(number, digits);
  const double half = 0.5 * std::pow(10.0, -decimals);
  return rounded(number, std::min(decimals, decimals_of(std::abs(number) + half, digits)));
}

std::string share_text(double share) { return digits_text(100.0 * share); }

std::string share_text(const Estimate& share) {
  return estimate_text({100.0 * share.value, 100.0 * share.lower, 100.0 * share.upper}, "");
}

std::string percent(double share) { return std::isfinite(share) ? share_text(share) + " %" : "—"; }

std::string percent(const Estimate& share) { return std::isfinite(share.value) ? share_text(share) + " %" : "—"; }

std::string estimate_text(const Estimate& estimate, std::string_view unit) {
  if (!std::isfinite(estimate.value)) return "—";
  const std::string of_unit = unit.empty() ? "" : fmt::format(" {}", unit);
  const double half = 0.5 * (estimate.upper - estimate.lower);
  if (!(half > 0.0)) return digits_text(estimate.value) + of_unit;
  int decimals = decimals_of(half, 2);
  if (!is_symmetric(estimate)) {
    // An end beside 0 shows its side.
    for (const double end : {estimate.lower, estimate.upper}) {
      for (int more = 0; more < 2 && end != 0.0 && rounded(end, decimals) == rounded(0.0, decimals); ++more) ++decimals;
    }
    return rounded(estimate.lower, decimals) + " to " + rounded(estimate.upper, decimals) + of_unit;
  }
  // Where the interval just ends before 0, or just behind it, two digits would not show on which side.
  const double size = std::abs(estimate.value);
  for (int more = 0; more < 2 && size != half && rounded(size, decimals) == rounded(half, decimals); ++more) ++decimals;
  return rounded(estimate.value, decimals) + " ± " + rounded(half, decimals) + of_unit;
}

std::string with_unit(std::string number, std::string_view unit) {
  if (unit.empty() || unit == "1") return number;
  if (number == "1" && unit.ends_with('s')) unit.remove_suffix(1);
  return number + " " + std::string(unit);
}

std::string length_text(const Length& any) {
  if (any.unit == LengthUnit::metres) return metres_text(any.number);
  const int digits = std::abs(any.number) < 1000.0 ? 3 : 4;
  return with_unit(with_minus(fmt::format("{:.{}g}", halves_up(any.number), digits)), unit_name(any.unit));
}

std::string metres_text(double metres, int digits) {
  if (!std::isfinite(metres)) return "—";
  const auto in = [&](double factor, const char* unit) {
    return with_minus(fmt::format("{:.{}g} {}", halves_up(metres * factor), digits, unit));
  };
  const double size = std::abs(metres);
  if (size >= 1000.0) return in(1e-3, "km");
  if (size < 1e-15) return "0 m";
  if (size >= 1.0) return in(1.0, "m");
  if (size >= 0.01) return in(100.0, "cm");
  if (size >= 1e-5) return in(1000.0, "mm");
  return size >= 1e-6 ? in(1e6, "µm") : size >= 1e-10 ? in(1e9, "nm") : in(1e12, "pm");
}

std::string short_text(const Value& value) {
  const auto* real = std::get_if<double>(&value);
  return real != nullptr ? fmt::format("{:.6g}", *real) : to_string(value);
}

}  // namespace umbrameter
