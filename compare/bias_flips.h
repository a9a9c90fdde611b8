// Tells peter-panning from light leaks in frames of another renderer by the biases at which pixels become lit, where
// frames at several biases exist. Not for our own taps, whose causes are known (techniques/shadow/causes.h).
//
// The map holds either a pixel's own surface or what stands before it. Depth differences on the own surface are those
// that cause acne, of either sign, so the acne of the frame of least bias measures up to which bias pixels flip because
// of their own surface. A pixel in shadow that is lit at that bias leaks; one that is lit later had its blocker in the
// map, and the bias removed it.
#pragma once

#include <functional>

#include "techniques/shadow/causes.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The bias at which two thirds of the acne of the least bias are lit is taken for that of the own surface. Measured on
/// our own rasteriser: fewer call leaks peter-panning, more call peter-panning leaks (docs/evaluate.md).
inline constexpr double own_surface_share = 2.0 / 3.0;
/// If more are lit, the step before that bias is too long: it may have removed blockers as well.
inline constexpr double most_own_surface_share = 0.99;
/// Least share of the lit pixels that the acne of the least bias must cover. Without bias it is about a half.
inline constexpr double least_acne_share = 0.1;

/// Why biases do not separate the causes.
enum class FlipProblem { none, little_acne, too_short, too_coarse };

struct OwnSurfaceFlips {
  FlipProblem problem = FlipProblem::none;
  std::size_t bias = 0;       ///< index of the bias
  Image<float> visibility{};  ///< the frame at that bias; empty if there is a problem
};

/// Finds the bias of the own surface by bisection of `biases` biases in the order in which they light more; frame()
/// draws at the bias of an index. `least` are the causes by rays of frame(0).
OwnSurfaceFlips find_own_surface_flips(const WrongTaps& least, const Image<PixelExclusion>& exclusion,
                                       const Image<float>& truth, std::size_t biases,
                                       const std::function<Image<float>(std::size_t)>& frame);

/// Assigns what is too bright: light leak as far as `own_surface`, the frame at the bias of the own surface, is lit
/// there as well, else peter-panning. What is too dark keeps its causes.
void separate_too_bright(WrongTaps& wrong, const Image<float>& own_surface);

}  // namespace umbrameter
