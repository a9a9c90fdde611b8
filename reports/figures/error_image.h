// What makes errors visible in a picture: the scene in light grey behind them, single wrong pixels enlarged, and the
// region of most error as an inset. It changes pictures, not values: images.exr and statistics keep theirs.
#pragma once

#include <string>
#include <vector>

#include "reports/figures/figures.h"

namespace umbrameter {

/// A pixel counts as wrong from this share of its scale's reach on: half of it.
inline constexpr double wrong_share = 0.5;

/// [px]
ivec2 image_size(const ImageFigure& figure);

/// Each wrong pixel as a square of dot × dot, an odd number; wrong pixels keep their own value. Where squares meet, the
/// nearest wrong pixel wins, then the first in reading order.
Image<float> enlarge_errors(const Image<float>& values, const ColorScale& scale, int dot);
Image<std::uint8_t> enlarge_errors(const Image<std::uint8_t>& category, const std::vector<bool>& is_wrong, int dot);

/// Whether wrong pixels stand among right ones: at least half of the pixels have no error at all. A map with errors
/// everywhere, as of ambient occlusion, shows them without being enlarged.
bool has_single_errors(const ImageFigure& figure, const ErrorImage& error);

/// Colours of an error image over a grey picture of the same size: the smaller the error, the more of the picture shows
/// through; at the ends of the scale the colour is that of colorize().
Image<glm::u8vec3> colorize_over(const Image<float>& values, const ColorScale& scale,
                                 const Image<std::uint8_t>& backdrop);

/// Linear luminance, 1 is white, as the light grey of a backdrop: each is lighter than every error beyond a third of
/// its scale, also in a grey print. Values below 0 are background and become white.
std::uint8_t backdrop_grey(double luminance);

/// Adds an inset to the images of each part: the region, an eighth of the image wide and high, whose absolute errors
/// have the largest sum over all error maps of the part. A part without errors gets none.
void add_worst_insets(const std::vector<Figure>& figures, ErrorImages& errors);

/// Completes captions with what the drawing does to the images, and adds the insets that the style asks for.
void complete_error_images(std::vector<Figure>& figures, ErrorImages& errors, const FigureStyle& style);

}  // namespace umbrameter
