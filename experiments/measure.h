// Measures one configuration: the results of technique and reference, and their difference.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "compare/ao.h"
#include "compare/by_object.h"
#include "compare/edge_statistics.h"
#include "compare/soft_visibility.h"
#include "compare/visibility.h"
#include "experiments/measure_ao_stages.h"
#include "experiments/measure_image.h"
#include "experiments/metric_scores.h"
#include "experiments/presentation/bias_advice.h"
#include "experiments/presentation/shadow_shape.h"
#include "experiments/stages.h"

namespace umbrameter {

/// Statistics of a shadow error. VisibilityStatistics: by cause, for a binary reference and a technique that sums
/// comparisons. EdgeStatistics: by distance to the reference's edges, for a binary reference and any other technique.
/// SoftVisibilityStatistics: by sign, with intervals, for an area light and for a reference over the pixel.
using ShadowStatistics = std::variant<VisibilityStatistics, EdgeStatistics, SoftVisibilityStatistics>;

/// Statistics of a cell of a sweep: a shadow error, ambient occlusion or the shaded image.
using CellStatistics =
    std::variant<VisibilityStatistics, EdgeStatistics, SoftVisibilityStatistics, AoStatistics, ImageStatistics>;

inline Statistics describe(CellStatistics& statistics) {
  return std::visit([](auto& each) { return describe(each); }, statistics);
}

struct ShadowMeasurement {
  Experiment experiment;  ///< the parameters of this measurement
  std::uint32_t light = 0;
  MapLayout layout;
  double depth_unit = 0.0;  ///< mean_depth_unit()
  CountedPixels counted;
  std::optional<RasterVisibility> raster;
  std::optional<TracedVisibility> truth;
  Emitter emitter;
  /// Whether the reference is sampled and takes values between 0 and 1: of an area light, or over the pixel.
  bool is_sampled = false;
  std::optional<StoredDepths> stored_depths{};  ///< if raster is present
  std::optional<ShadowStatistics> statistics;   ///< if raster and truth are present
  std::vector<MetricScore> metrics{};           ///< if raster and truth are present
  std::optional<ClassAgreement> agreement{};    ///< with run.classes=exact
  /// By the receiver's object and by its material, in descending order of weight; if statistics are present.
  std::vector<PartError> objects{};
  std::vector<PartError> materials{};
  std::optional<BiasAdvice> advice{};  ///< set by the compare command, if any pixel is counted
  std::optional<ShadowShape> shape;    ///< set by the compare command
};

/// The statistics by cause; nullptr if the error has no causes.
inline const VisibilityStatistics* by_cause(const ShadowMeasurement& shadow) {
  return shadow.statistics ? std::get_if<VisibilityStatistics>(&*shadow.statistics) : nullptr;
}

/// Refers to one light's truth, for the statistics. `truth` must outlive the result.
SampledImage sampled(const TracedVisibility& truth);

struct AoMeasurement {
  Experiment experiment;  ///< the parameters of this measurement
  std::optional<Image<float>> raster;
  std::optional<TracedAo> truth;
  std::optional<AoStatistics> statistics;  ///< if raster and truth are present
  std::vector<MetricScore> metrics{};      ///< if raster and truth are present
  std::optional<AoStages> stages{};        ///< set by the compare command, with run.ao-stages
};

struct Measurement {
  Experiment experiment;  ///< the parameters of all parts
  Surfels surfels;
  std::vector<ShadowMeasurement> shadows;
  std::optional<AoMeasurement> ao;
  std::optional<ImageMeasurement> image;
};

/// Compares visibility `drawn` by the technique with the binary reference of a light without extent.
EdgeStatistics measure_edges(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             const Image<float>& drawn);

ShadowMeasurement measure_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, Sides sides);
AoMeasurement measure_ao(Stages& stages, const Experiment& experiment, Sides sides);

}  // namespace umbrameter
