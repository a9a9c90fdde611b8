// Numbers in the notes of a scene: three significant digits.
#pragma once

#include <cstdio>
#include <string>

namespace umbrameter {

inline std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace umbrameter
