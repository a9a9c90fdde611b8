// Both sides' answers for one configuration, and their difference.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "compare/ao.h"
#include "compare/by_object.h"
#include "compare/edge_statistics.h"
#include "compare/metrics/metric.h"
#include "compare/soft_visibility.h"
#include "compare/visibility.h"
#include "experiments/presentation/bias_advice.h"
#include "experiments/presentation/shadow_shape.h"
#include "experiments/stages.h"

namespace umbrameter {

/// Which side's answers a command wants; the difference is there where both are.
struct Sides {
  bool raster = true;
  bool truth = true;
};

/// What can be said of a shadow error. Against a binary reference, of a technique that sums comparisons: its causes. Of
/// another technique: how the error lies about the reference's edges. Against an area light: its sign, with intervals.
using ShadowStatistics = std::variant<VisibilityStatistics, EdgeStatistics, SoftVisibilityStatistics>;

/// The same, or ambient occlusion: what the cells of a sweep hold.
using CellStatistics = std::variant<VisibilityStatistics, EdgeStatistics, SoftVisibilityStatistics, AoStatistics>;

inline Statistics describe(CellStatistics& statistics) {
  return std::visit([](auto& each) { return describe(each); }, statistics);
}

/// One of run.metrics.
struct MetricScore {
  const Metric* metric = nullptr;
  double score = 0.0;
};

struct ShadowMeasurement {
  Experiment experiment;  ///< what it was made with; whoever shows it reads parameters from here
  std::uint32_t light = 0;
  MapLayout frame;
  CountedPixels counted;
  std::optional<RasterVisibility> raster;
  std::optional<TracedVisibility> truth;
  Emitter emitter;
  std::optional<ShadowStatistics> statistics;  ///< where both sides are
  std::vector<MetricScore> metrics{};          ///< where both sides are
  std::optional<ClassAgreement> agreement{};   ///< where the classes are exact
  /// By the receiver's object and material, by falling weight; where statistics are.
  std::vector<PartError> objects{};
  std::vector<PartError> materials{};
  std::optional<BiasAdvice> advice{};  ///< of compare, where any pixel is counted
  std::optional<ShadowShape> shape;    ///< of compare
};

/// Whether the reference is a share of the light, and sampled.
inline bool has_area_light(const ShadowMeasurement& shadow) {
  return !std::holds_alternative<std::monostate>(shadow.emitter);
}

/// The statistics by cause; nullptr where the error has none.
inline const VisibilityStatistics* by_cause(const ShadowMeasurement& shadow) {
  return shadow.statistics ? std::get_if<VisibilityStatistics>(&*shadow.statistics) : nullptr;
}

/// The truth of one light for the statistics, which it must outlive.
SampledImage sampled(const TracedVisibility& truth);

struct AoMeasurement {
  Experiment experiment;  ///< what it was made with
  std::optional<Image<float>> raster;
  std::optional<TracedAo> truth;
  std::optional<AoStatistics> statistics;
  std::vector<MetricScore> metrics{};  ///< where both sides are
};

struct Measurement {
  Experiment experiment;  ///< that of all its parts
  Surfels surfels;
  std::vector<ShadowMeasurement> shadows;
  std::optional<AoMeasurement> ao;
};

/// Of a technique's visibility against the binary reference of a light without extent.
EdgeStatistics measure_edges(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             const Image<float>& drawn);

ShadowMeasurement measure_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, Sides sides);
AoMeasurement measure_ao(Stages& stages, const Experiment& experiment, Sides sides);

}  // namespace umbrameter
