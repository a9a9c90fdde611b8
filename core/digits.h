// Significant digits of decimal numbers.
#pragma once

#include <cmath>

namespace umbrameter {

/// By how much a number changes with the last of its significant digits: 0.01 of 2.04 with three. 1 for 0.
inline double step_of_last_digit(double number, int digits) {
  return number == 0.0 ? 1.0 : std::pow(10.0, std::floor(std::log10(std::abs(number))) - (digits - 1));
}

}  // namespace umbrameter
