// Both sides' answers for one configuration, and their difference.
#pragma once

#include <optional>
#include <vector>

#include "compare/ao.h"
#include "compare/by_object.h"
#include "compare/soft_visibility.h"
#include "compare/visibility.h"
#include "experiments/presentation/bias_advice.h"
#include "experiments/presentation/shadow_shape.h"
#include "experiments/workbench.h"

namespace umbrameter {

/// Which side's answers a command wants; the difference is there where both are.
struct Sides {
  bool raster = true;
  bool truth = true;
};

struct ShadowMeasurement {
  Experiment experiment;  ///< what it was made with; whoever shows it reads parameters from here
  std::uint32_t light = 0;
  LightFrame frame;
  CountedPixels counted;
  std::optional<RasterVisibility> raster;
  std::optional<TracedVisibility> truth;
  Emitter emitter;
  /// Where both sides are: of a light without extent, and of one with.
  std::optional<VisibilityStatistics> statistics;
  std::optional<SoftVisibilityStatistics> soft_statistics;
  std::optional<ClassAgreement> agreement{};  ///< where the classes are exact
  /// By the receiver's object and material, by falling weight; where statistics are.
  std::vector<PartError> objects{};
  std::vector<PartError> materials{};
  std::optional<BiasAdvice> advice{};  ///< of compare, where any pixel is counted
  std::optional<ShadowShape> shape;    ///< of compare
};

/// Whether the light has extent: its truth is then sampled, and its error has no causes.
inline bool is_soft(const ShadowMeasurement& shadow) { return !std::holds_alternative<std::monostate>(shadow.emitter); }

/// The truth of one light for the statistics, which it must outlive.
SampledImage sampled(const TracedVisibility& truth);

struct AoMeasurement {
  Experiment experiment;  ///< what it was made with
  std::optional<Image<float>> raster;
  std::optional<TracedAo> truth;
  std::optional<AoStatistics> statistics;
};

struct Measurement {
  Experiment experiment;  ///< that of all its parts
  Surfels surfels;
  std::vector<ShadowMeasurement> shadows;
  std::optional<AoMeasurement> ao;
};

ShadowMeasurement measure_shadow(Workbench& workbench, const Experiment& experiment, std::uint32_t light, Sides sides);
AoMeasurement measure_ao(Workbench& workbench, const Experiment& experiment, Sides sides);

}  // namespace umbrameter
