// Why a screen-space method of ambient occlusion is wrong: its error as a sum of stages, from the requested reference
// to the blurred result. Knows only images; experiments/measure/measure_ao_stages.h makes them.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/sampled_error.h"
#include "core/gbuffer.h"
#include "core/image.h"
#include "scenes/view.h"

namespace umbrameter {

/// What a stage changes, in order. model: the method's own integral replaces the requested reference. off_screen,
/// hidden: occluders outside the view, and those inside it that no pixel sees, vanish. thin: all behind the visible
/// surface is solid, as thick as the method takes it. approximation: the method with very many samples replaces the
/// integral. sampling: with its own number. blur: its blur and upsampling.
enum class AoStage : int { model, off_screen, hidden, thin, approximation, sampling, blur };
inline constexpr std::size_t ao_stage_count = 7;
inline constexpr std::array<std::string_view, ao_stage_count> ao_stage_names = {
    "model", "off_screen", "hidden", "thin", "approximation", "sampling", "blur"};
inline constexpr std::array<std::string_view, ao_stage_count> ao_stage_titles = {
    "model", "off-screen", "hidden", "thin", "approximation", "sampling", "blur"};

/// Accessibility before the first stage (the requested reference) and after each; the last is the method's result.
struct AoStageImages {
  std::array<Image<float>, ao_stage_count + 1> accessibility;
  /// Unbiased estimates of the variance of each stage's difference; empty if it is exact.
  std::array<Image<float>, ao_stage_count> variance;
  /// Rays behind each stage's difference in a pixel; empty if it is exact.
  std::array<Image<float>, ao_stage_count> samples;
  Image<float> reference_variance;  ///< of the requested reference
  Image<float> reference_samples;
  int degrees_of_freedom = 0;  ///< of each pixel's variance
};

/// What a stage adds to accessibility: after − before.
Image<float> stage_difference(const AoStageImages& images, AoStage stage);

/// One stage's share of the error.
struct AoStageError {
  Estimate mean;           ///< below 0: it darkens
  Estimate rms;            ///< corrected for the variance of the references
  double srgb_mean = 0.0;  ///< mean difference of sRGB-encoded accessibility
};

/// Means are signed and add up: mean_error is the sum of the stages' means.
struct AoStageStatistics {
  SampledError total;  ///< method − requested reference
  std::array<AoStageError, ao_stage_count> stages;
  double srgb_mean_error = 0.0;
  double srgb_mse = 0.0;   ///< corrected for the variance of the reference, to first order
  double srgb_psnr = 0.0;  ///< dB, peak 1
};
Statistics describe(AoStageStatistics& statistics);

AoStageStatistics analyze_ao_stages(const AoStageImages& images, const IsCounted& is_counted);

/// The pixels that share a property.
struct AoStageBin {
  std::string split;  ///< "depth"
  std::string unit;   ///< of first and last
  double first = 0.0;
  double last = 0.0;  ///< pixels have first ≤ value < last
  AoStageStatistics statistics;
};

/// By depth (quarters of the pixels), cosine between normal and viewer, distance to a depth edge and to the image's
/// edge, and total error (over-occluded, within 0.01, under-occluded; without intervals, because the measured error
/// selects the pixels). `is_joined`: whether two neighbouring pixels see one surface, without a depth edge.
std::vector<AoStageBin> split_ao_stages(const AoStageImages& images, const GBuffer& gbuffer, const View& view,
                                        const std::function<bool(std::size_t, std::size_t)>& is_joined);

/// One row for all pixels (split "all") and one per bin.
Table ao_stage_table(const AoStageStatistics& all, const std::vector<AoStageBin>& bins);

}  // namespace umbrameter
