// Everything that decides what a run measures: the scene and every described parameter.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/parameters.h"
#include "core/table.h"
#include "raytrace/parameters.h"
#include "scenes/emitter.h"
#include "scenes/scene_params.h"
#include "scenes/view.h"
#include "techniques/ao/parameters.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

/// Who settles the taps that the two-plane rule takes for another surface's: the rule itself, or rays.
enum class ClassRule : int { fast, exact };

/// What a sweep measures: what its axes belong to, shadows, or ambient occlusion.
enum class SweepMeasure : int { automatic, visibility, ao };

/// The run.* parameters.
struct RunParams {
  int seed = 1;
  ClassRule classes = ClassRule::exact;
  SweepMeasure measure = SweepMeasure::automatic;
  bool shimmer = false;
  std::string metrics;  ///< names of image metrics, comma-separated
};
Parameters describe(RunParams& params);

struct Experiment {
  std::string scene;
  SceneParams reading;  ///< scene.*
  ViewParams view;
  LightParams light;
  ShadowParams shadow;
  AoParams ao;
  TruthParams truth;
  RunParams run;
  /// What a sweep varies: full parameter name, axis text.
  std::vector<std::pair<std::string, std::string>> axes;
};

/// The built-in scene's name, or the file's name without its folder, with the scene chosen in it.
std::string scene_title(const Experiment& experiment);

/// With the lengths of ambient occlusion in metres; an automatic truth.ao-distance becomes the experiment's own
/// ao.radius, so that both sides look equally far. scene_size is the diagonal of the scene's bounds, metres.
Experiment in_metres(Experiment experiment, double scene_size);

/// All parameters, bound to this experiment.
Parameters describe(Experiment& experiment);

/// The values of some parameters as one text: equal exactly when the values are equal.
std::string key_of(const Parameters& parameters);

/// The reference page of all parameters, Markdown.
std::string parameter_reference();

/// Every parameter with its value, unit and meaning; of a varied one the axis in place of the value.
Table settings_table(Experiment experiment);

}  // namespace umbrameter
