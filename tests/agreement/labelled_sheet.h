// Pictures of one size in rows, each with its label above it.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

struct SheetCell {
  std::string label;
  Image<glm::u8vec3> picture;
};

/// An SVG of the cells in reading order. All pictures have the size of the first.
std::string labelled_sheet(const std::vector<SheetCell>& cells, int columns);

}  // namespace umbrameter
