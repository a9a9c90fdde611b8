// Regions of an image drawn enlarged beside it.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "reports/figures/style.h"

namespace umbrameter {

/// Where an enlarged region stands, in pixels of the drawing from the image's top left.
struct PlacedInset {
  Inset region;        ///< of the image
  int scale = 1;       ///< pixels of the drawing for one of the image
  ivec2 corner{0, 0};  ///< of its top left
};

/// The image and its insets: right of the image one below the other, or below it side by side, whichever enlarges more.
struct InsetLayout {
  int image_scale = 1;  ///< the image is enlarged, too, where that brings the insets nearer to their room
  ivec2 size{0, 0};     ///< of image and insets [px]
  bool is_below = false;
  std::vector<PlacedInset> insets;
};

/// `image_scale` is the least enlargement of the image, `gap` the distance between pictures. Without insets the layout
/// is the image. Throws Error (partial) naming an inset that is too large to be drawn larger than in the image.
InsetLayout place_insets(const std::vector<Inset>& insets, ivec2 image, int image_scale, int gap);

/// Each pixel as a square: no value between two pixels is made up.
Image<glm::u8vec3> crop_enlarged(const Image<glm::u8vec3>& image, const Inset& region, int scale);

/// SVG of frames and connecting lines, in a colour and a dash pattern for each inset. `origin` is the image's top left
/// in the drawing, `stroke` the width of the lines.
std::string inset_marks(const InsetLayout& layout, ivec2 origin, double stroke);

}  // namespace umbrameter
