// Whether an image fits its reference better after a shift by whole pixels or a flip: an error that is common where two
// images come from two programs.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// The test image read at another place: shifted, or flipped.
struct Misalignment {
  ivec2 shift{0};          ///< the test image's content lies this many pixels to the right and down of the reference's
  bool flips_x = false;    ///< left and right are exchanged
  bool flips_y = false;    ///< top and bottom are exchanged
  double remaining = 0.0;  ///< share of the squared difference that remains after it is undone, 0 to 1
};

/// Largest shift that is tried in each direction, pixels.
inline constexpr int max_alignment_shift = 8;
/// The squared difference that remains must be below this share.
inline constexpr double max_remaining_difference = 0.5;

/// The shift or flip that makes the images of equal size fit markedly better, if there is one. Differences are those of
/// compressed luminance, less their mean in each tile of 8 × 8 pixels, so that exposure and smooth shading do not
/// count. Undoing it must (1) leave less than half of the squared difference, (2) leave less than half of the
/// reference's own variance in tiles, (3) improve tiles by ten times as much as it worsens others, and (4) improve the
/// equivalent of four tiles or more, (Σ gain)² / Σ gain², so that a few bright pixels do not decide. Noise does not
/// satisfy (1): independent noise has the same expected difference at every shift. Of 1024 pixels, the least that must
/// count, ln of the ratio of two such differences has a standard deviation below √(4 / 1024) = 0.063, and ln ½ is 11 of
/// them away: a probability below 10⁻²⁴ for all shifts together. Reads pixels at least max_alignment_shift from the
/// border, in at most 1024 tiles, evenly spaced. Empty for images below 48 × 48 pixels.
std::optional<Misalignment> find_misalignment(const Image<vec3>& test, const Image<vec3>& reference,
                                              const std::function<bool(std::size_t)>& is_counted);

}  // namespace umbrameter
