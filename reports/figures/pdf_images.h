// Images in a PDF as the PNG has them compressed. cairo would compress each again, which takes longer than all the rest
// of a figure. It draws small markers instead, and these are replaced.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"
#include "reports/files/png.h"

namespace umbrameter {

/// Size in pixels of the marker for images[index] of with_images(). The height tells the index. No other image that
/// cairo draws may have this width.
ivec2 marker_size(std::size_t index);

/// cairo's PDF with images[i] in place of the marker of index i. The PDF must have a table of references, as up to
/// PDF 1.4. Throws Error (partial) when it has none, or not one marker for each image.
std::string with_images(std::string_view pdf, const std::vector<const DeflatedImage*>& images);

}  // namespace umbrameter
