// Shadow error: the difference between a raster and a traced visibility image over the counted pixels, by cause.
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

/// The main cause of a pixel's error. The values are those of the class layer in images.exr.
enum class PixelClass : std::uint8_t {
  correct,
  acne,
  false_occlusion,
  peter_panning,
  light_leak,
  not_counted,  ///< back-facing, or outside the map, cone or range
  background,
};
inline constexpr std::array<std::string_view, 7> pixel_class_names = {
    "correct", "acne", "false occlusion", "peter-panning", "light leak", "not counted", "background"};

/// Name and meaning of a cause, for titles and tables.
constexpr std::string_view cause_title(Cause cause) {
  return pixel_class_names[static_cast<std::size_t>(PixelClass::acne) + static_cast<std::size_t>(cause)];
}
std::string_view cause_meaning(Cause cause);

/// All shares are of the counted pixels, 0 to 1. With a binary truth mae = acne + false_occlusion + peter_panning +
/// leak.
struct VisibilityStatistics {
  std::uint64_t pixels = 0;  ///< counted: facing the light, inside its map, cone and range
  double lit = 0.0;          ///< share that is lit in the truth
  double blocked = 0.0;      ///< share that is blocked in the truth
  double mae = 0.0;          ///< mean |raster − truth|
  double rmse = 0.0;         ///< root of the mean of (raster − truth)²
  double mean_error = 0.0;   ///< mean of raster − truth: below 0 too dark, above 0 too bright
  double max_error = 0.0;    ///< largest |raster − truth|
  int max_x = -1;            ///< first pixel with max_error, row by row from the top, px
  int max_y = -1;            ///< both are −1 if there is no error or only sums are known
  double acne = 0.0;
  double false_occlusion = 0.0;
  double peter_panning = 0.0;
  double leak = 0.0;
  double false_blocked = 0.0;  ///< truth lit, raster blocked; for a filtered pixel its blocked part
  double false_lit = 0.0;      ///< truth blocked, raster lit; for a filtered pixel its lit part
  double mean_texel = 0.0;     ///< mean side of a texel at the counted surfels, metres
};

Statistics describe(VisibilityStatistics& statistics);

inline constexpr const char* mean_texel_meaning = "mean size of a shadow-map texel at the counted pixels";

/// Number of pixels for each PixelExclusion.
using ExclusionTotals = std::array<std::uint64_t, 6>;
inline constexpr std::array<std::string_view, 6> exclusion_names = {"counted",     "background",   "back_facing",
                                                                    "outside_map", "outside_cone", "outside_range"};

/// The counted pixels of a light, and why the others are excluded.
struct CountedPixels {
  Image<PixelExclusion> exclusion;
  ExclusionTotals totals{};
  double mean_texel = 0.0;  ///< mean over the counted pixels, metres
};
/// `unlit`: the pixels that a frame does not light even without shadows count as back-facing; empty: none.
CountedPixels count_pixels(const GBuffer& gbuffer, const Light& light, const MapLayout& layout,
                           const Image<std::uint8_t>& unlit = {});

/// The number of counted pixels, and of those that are lit in a binary truth.
struct TruthCounts {
  std::uint64_t pixels = 0;
  std::uint64_t lit = 0;
  double mean_texel = 0.0;  ///< metres
};
TruthCounts count_truth(const Image<float>& truth, const CountedPixels& counted);

/// Sums over the counted pixels, in weights of taps, from which all statistics against a binary truth are computed.
/// Equal configurations have equal sums, whether rendered or taken from a histogram.
struct VisibilitySums {
  std::uint32_t weight_sum = 1;
  std::array<std::uint64_t, cause_count> wrong{};
  WideCount squares = 0;      ///< sum of the squares of each pixel's wrong weight
  std::uint32_t largest = 0;  ///< largest wrong weight of a pixel
  friend bool operator==(const VisibilitySums&, const VisibilitySums&) = default;
};

/// Sum of the weights over all causes.
std::uint32_t wrong_weight(const uvec4& by_cause);

/// The images have the same size.
VisibilitySums sum_wrong_taps(const WrongTaps& wrong, const CountedPixels& counted);
VisibilityStatistics to_statistics(const VisibilitySums& sums, const TruthCounts& truth);

/// Statistics of one configuration, including the pixel with the largest error.
VisibilityStatistics analyze_visibility(const WrongTaps& wrong, const Image<float>& truth,
                                        const CountedPixels& counted);

/// raster − truth.
Image<float> signed_error(const Image<float>& raster, const Image<float>& truth);

/// The class with the largest share of each pixel's wrong taps; ties go to the first in PixelClass's order.
Image<PixelClass> classify(const WrongTaps& wrong, const CountedPixels& counted);

}  // namespace umbrameter
