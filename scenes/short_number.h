// Numbers in the notes of a scene: three significant digits, and all before the point up to ten million.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace umbrameter {

inline std::string text_of(double value) {
  const double size = std::abs(value);
  const double last = size >= 999.5 && size < 1e7 ? std::pow(10.0, std::floor(std::log10(size)) - 2.0) : 0.0;
  char text[32];
  if (last > 0.0) {
    std::snprintf(text, sizeof text, "%.0f", std::round(value / last) * last);
  } else {
    std::snprintf(text, sizeof text, "%.3g", value);
  }
  return text;
}

}  // namespace umbrameter
