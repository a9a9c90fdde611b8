// Shadow error: what differs between a raster and a traced visibility image, counted over the surfels that the
// technique is answerable for, and taken apart by cause.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/gbuffer.h"
#include "core/image.h"
#include "core/statistics.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The cause that a pixel's error is mostly due to; the numbers of the class layer.
enum class PixelClass : std::uint8_t {
  correct,
  acne,
  false_occlusion,
  peter_panning,
  light_leak,
  not_counted,  ///< turned away, or outside the map, cone or range
  background,
};
inline constexpr std::array<std::string_view, 7> pixel_class_names = {
    "correct", "acne", "false occlusion", "peter-panning", "light leak", "not counted", "background"};

/// Of the causes, for people: the name, and what it means.
constexpr std::string_view cause_title(Cause cause) {
  return pixel_class_names[static_cast<std::size_t>(PixelClass::acne) + static_cast<std::size_t>(cause)];
}
std::string_view cause_meaning(Cause cause);

/// All shares are of the counted pixels, 0 to 1. With a binary truth mae = acne + false_occlusion + peter_panning +
/// leak.
struct VisibilityStatistics {
  std::uint64_t pixels = 0;  ///< counted: facing the light, inside its map, cone and range
  double lit = 0.0;          ///< share that the truth calls lit
  double blocked = 0.0;      ///< share that the truth calls blocked
  double mae = 0.0;          ///< mean |raster − truth|
  double rmse = 0.0;         ///< root of the mean of (raster − truth)²
  double mean_error = 0.0;   ///< mean of raster − truth: below 0 too dark, above 0 too bright
  double max_error = 0.0;    ///< largest |raster − truth|
  int max_x = -1;            ///< where it stands first, row by row from the top, px; −1 without an error
  int max_y = -1;            ///< and where only sums are known
  double acne = 0.0;
  double false_occlusion = 0.0;
  double peter_panning = 0.0;
  double leak = 0.0;
  double false_blocked = 0.0;  ///< truth lit, raster blocked: of a filtered pixel its blocked part
  double false_lit = 0.0;      ///< truth blocked, raster lit: of a filtered pixel its lit part
  double mean_texel = 0.0;     ///< mean side of a texel at the counted surfels, metres
};

Statistics describe(VisibilityStatistics& statistics);

inline constexpr const char* mean_texel_meaning = "mean size of a shadow-map texel at the counted pixels";

/// How many pixels each counting class holds, indexed by PixelExclusion.
using ExclusionTotals = std::array<std::uint64_t, 6>;
inline constexpr std::array<std::string_view, 6> exclusion_names = {"counted",     "background",   "turned_away",
                                                                    "outside_map", "outside_cone", "outside_range"};

/// Which pixels statistics count for a light, and why not the others.
struct CountedPixels {
  Image<PixelExclusion> exclusion;
  ExclusionTotals totals{};
  double mean_texel = 0.0;  ///< metres, over the counted ones
};
CountedPixels count_pixels(const GBuffer& gbuffer, const Light& light, const MapLayout& frame);

/// The counted pixels, and those of them that a binary truth calls lit.
struct TruthCounts {
  std::uint64_t pixels = 0;
  std::uint64_t lit = 0;
  double mean_texel = 0.0;  ///< metres
};
TruthCounts count_truth(const Image<float>& truth, const CountedPixels& counted);

/// What all statistics of a binary truth follow from: sums over the counted pixels, in weights of taps. Equal
/// configurations have equal sums, however they were measured.
struct VisibilitySums {
  std::uint32_t weight_sum = 1;
  std::array<std::uint64_t, cause_count> wrong{};
  WideCount squares = 0;      ///< of each pixel's wrong weight
  std::uint32_t largest = 0;  ///< of a pixel's wrong weight
  friend bool operator==(const VisibilitySums&, const VisibilitySums&) = default;
};

/// Of all causes together.
std::uint32_t wrong_weight(const uvec4& by_cause);

/// Images of one size.
VisibilitySums sum_wrong_taps(const WrongTaps& wrong, const CountedPixels& counted);
VisibilityStatistics to_statistics(const VisibilitySums& sums, const TruthCounts& truth);

/// Of one configuration, with the place of the largest error.
VisibilityStatistics analyze_visibility(const WrongTaps& wrong, const Image<float>& truth,
                                        const CountedPixels& counted);

/// raster − truth.
Image<float> signed_error(const Image<float>& raster, const Image<float>& truth);

/// The class with the largest share of each pixel's wrong taps; ties go to the first in PixelClass's order.
Image<PixelClass> classify(const WrongTaps& wrong, const CountedPixels& counted);

}  // namespace umbrameter
