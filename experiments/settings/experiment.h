// The complete configuration of a run: the scene and all parameters.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/parameters.h"
#include "core/table.h"
#include "experiments/settings/engine_params.h"
#include "experiments/settings/frame_params.h"
#include "scenes/emitter.h"
#include "scenes/scene_params.h"
#include "scenes/view.h"
#include "techniques/ao/technique.h"
#include "techniques/shading/parameters.h"
#include "techniques/shadow/technique.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {

/// How wrong taps are classified. fast: by the two-plane rule. exact: ray tests confirm or reclassify the taps that the
/// rule calls false occlusion.
enum class ClassRule : int { fast, exact };

/// What is measured. automatic: compare measures shadows and ambient occlusion, a sweep what its axes vary. visibility
/// and ao: that alone. image: shadows, ambient occlusion and the shaded image; in a sweep the image alone.
enum class SweepMeasure : int { automatic, visibility, ao, image };

/// The run.* parameters.
struct RunParams {
  int seed = 1;
  ClassRule classes = ClassRule::exact;
  SweepMeasure measure = SweepMeasure::automatic;
  bool shimmer = false;
  bool ao_stages = false;
  std::string metrics;  ///< names of image metrics, comma-separated
  bool write_maps = false;
  bool write_ao_inputs = false;
  std::string overlay;      ///< names of debug views, comma-separated
  std::string for_engines;  ///< as parse_bias_targets() reads it
};
Parameters describe(RunParams& params);

struct Experiment {
  std::string scene;
  SceneParams scene_params;  ///< scene.*
  ViewParams view;
  LightParams light;
  ShadowParams shadow;
  AoParams ao;
  ShadingParams shading;
  EngineParams engine = engine_in_use();
  FrameParams frame;
  TruthParams truth;
  RunParams run;
  /// The axes of a sweep: full parameter name, axis text.
  std::vector<std::pair<std::string, std::string>> axes;
};

/// Whether compare, trace or raster measures shadows, and whether it measures ambient occlusion.
inline bool measures_shadows(const Experiment& experiment) { return experiment.run.measure != SweepMeasure::ao; }
inline bool measures_ao(const Experiment& experiment) { return experiment.run.measure != SweepMeasure::visibility; }

/// Whether compare, trace or raster also makes the shaded image: run.measure asks for it, or run.overlay, which shows
/// it.
inline bool measures_image(const Experiment& experiment) {
  return experiment.run.measure == SweepMeasure::image || !experiment.run.overlay.empty();
}

/// The built-in scene's name, or the file's name without its folder; followed by the selected scene of the file.
std::string scene_title(const Experiment& experiment);

/// What takes the place of our own techniques: "three.js 0.187.0", "frame of mask.exr"; empty: nothing does.
std::string renderer_title(const Experiment& experiment);

/// Converts the lengths of ambient occlusion to metres. An automatic truth.ao-distance becomes the experiment's
/// ao.radius, so that technique and reference use the same distance. scene_size is the diagonal of the scene's bounds,
/// metres.
Experiment in_metres(Experiment experiment, double scene_size);

/// Throws Error (usage) if a length of ambient occlusion is not in metres.
void require_metres(AoParams params);
void require_metres(TruthParams params);

/// All parameters, bound to the members of this experiment.
Parameters describe(Experiment& experiment);

/// The values of some parameters as one text. Two texts are equal if and only if the values are equal.
std::string key_of(const Parameters& parameters);

/// The reference page of all parameters, Markdown.
std::string parameter_reference();

/// Every parameter with its value, unit and meaning. A varied parameter has its axis in place of the value.
Table settings_table(Experiment experiment);

}  // namespace umbrameter
