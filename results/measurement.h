// What one configuration measured: the results of technique and reference, and their difference. Plain values, from
// which files, page and figures are made; experiments/measure/ makes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compare/ao.h"
#include "compare/ao_stages.h"
#include "compare/by_object.h"
#include "compare/edge_statistics.h"
#include "compare/image_error.h"
#include "compare/soft_visibility.h"
#include "compare/unresolved_taps.h"
#include "compare/visibility.h"
#include "experiments/settings/experiment.h"
#include "reports/files/exr.h"
#include "results/bias_advice.h"
#include "results/metric_columns.h"
#include "results/shadow_shape.h"
#include "scenes/view.h"
#include "techniques/shading/shaded_image.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/truth/traced.h"

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

/// The surfels of a view, for technique and reference.
struct Surfels {
  View view;
  GBuffer gbuffer;
};

/// The depths in a shadow map, and how finely it stores them.
struct StoredDepths {
  std::optional<DepthRange> range{};  ///< nothing if the light hits no surface
  double step_at_nearest = 0.0;       ///< metres
  double step_at_farthest = 0.0;      ///< metres
  double polygon_offset_unit = 0.0;   ///< share of the stored range, at a stored depth of ½; as measured
};

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
  std::string cause_source{};                   ///< how causes were found, of an engine or a frame; else empty
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
inline SampledImage sampled(const TracedVisibility& truth) {
  return {truth.visibility, truth.variance, truth.samples, truth.degrees_of_freedom};
}

struct AoStages {
  std::string integral;  ///< the method's own integral, for people
  AoStageImages images;
  AoStageStatistics statistics;
  std::vector<AoStageBin> bins;
  int many_draws = 0;         ///< draws with many samples, each with another seed, whose mean is the approximation
  TraceStatistics integrals;  ///< cost of the rays of the method's integral
};

struct AoMeasurement {
  Experiment experiment;  ///< the parameters of this measurement
  std::optional<Image<float>> raster;
  std::optional<TracedAo> truth;
  std::optional<AoStatistics> statistics;  ///< if raster and truth are present
  std::vector<MetricScore> metrics{};      ///< if raster and truth are present
  std::optional<AoStages> stages{};        ///< set by the compare command, with run.ao-stages
};

struct ImageMeasurement {
  Experiment experiment;  ///< the parameters of this measurement
  std::vector<std::uint32_t> lights;
  std::optional<ShadedImage> raster;
  std::optional<Image<vec3>> truth;           ///< linear, without exposure
  Image<float> standard_error;                ///< of the truth's luminance × exposure; empty if nothing was sampled
  std::optional<ImageStatistics> statistics;  ///< if raster and truth are present
  std::vector<MetricScore> metrics{};  ///< of run.metrics, of the displayed image; if raster and truth are present
  Image<std::uint8_t> causes;          ///< classify_image(); if raster and truth are present
  /// What the compact G-buffer changes, G-buffer − exact; of the deferred path, if raster and truth are present.
  struct GBufferChange {
    std::vector<Image<float>> visibility;  ///< per light
    Image<float> ao;
    Image<float> image;  ///< luminance × exposure
  };
  std::optional<GBufferChange> gbuffer_change;
};

/// Errors below this step of an 8-bit image have no cause in ImageMeasurement::causes.
inline constexpr float visible_step = 1.0f / 255.0f;

/// A picture of what the renderer works with.
struct DebugView {
  std::string stem;   ///< of the figure: "shadow_map_sun_1"
  std::string title;  ///< "Shadow map: sun, view 1"
  std::string caption;
  Image<glm::u8vec3> picture;
};

/// While it is measured, each part has its own images; move_to_layers() then makes one set of named layers of them.
struct Measurement {
  Experiment experiment;  ///< the parameters of all parts
  Surfels surfels;
  Image<vec3> picture{};  ///< the view, shaded; linear, 1 is about white
  LayeredImage layers{};  ///< images.exr
  std::vector<ShadowMeasurement> shadows{};
  std::optional<AoMeasurement> ao{};
  std::optional<ImageMeasurement> image{};
  std::vector<DebugView> debug_views{};  ///< that run.overlay lists
};

}  // namespace umbrameter
