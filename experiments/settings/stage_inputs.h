// Declares the stages of a run and the parameters that each reads. Memo keys, the cost of varying a parameter in a
// sweep, and the parameters in the reference cache's key all derive from this declaration.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/experiment.h"

namespace umbrameter {

enum class Stage {
  surfels,           ///< G-buffer of the view
  light,             ///< the selected light
  emitter,           ///< the light's extent
  layout,            ///< the projection of the light's map
  counted,           ///< the counted pixels
  map,               ///< the shadow map
  filtered_map,      ///< the technique's filtered map, if it has one
  visibility,        ///< the technique's visibility
  binary_reference,  ///< shadow rays to a light without extent, or to the centre of one with extent
  area_reference,    ///< shadow rays to an area light
  pixel_reference,   ///< shadow rays from all of a pixel
  stored_gbuffer,    ///< the G-buffer of the deferred path
  shading,           ///< the technique's image
  ao,                ///< the technique's ambient occlusion after its blur
  finished_ao,       ///< the same with its intensity and power
  ao_reference,      ///< hemisphere rays
};
inline constexpr std::size_t stage_count = static_cast<std::size_t>(Stage::ao_reference) + 1;

struct StageInputs {
  std::string_view name;
  Parameters (*reads)(Experiment& experiment);  ///< the parameters that the stage itself reads
  std::vector<Stage> after;                     ///< the stages whose results it reads
  double cost = 0.0;                            ///< relative time, for the order in which a sweep varies its axes
};
const StageInputs& inputs_of(Stage stage);

/// The values of all parameters that the stage's result depends on: its own and those of the stages before it. Equal
/// keys give equal results.
std::string key_of(Stage stage, Experiment experiment);

/// The experiment as the stage sees it: parameters that neither it nor a stage before it reads have their defaults, so
/// that its result depends on nothing that its key leaves out. Those of the scene, which is loaded before any stage,
/// stay.
Experiment declared(Stage stage, Experiment experiment);

/// The values of the parameters that the stage itself reads.
std::string own_key_of(Stage stage, Experiment experiment);

/// Whether the stage's result depends on the parameter with this full name.
bool depends_on(Stage stage, std::string_view parameter);

/// Sum of StageInputs::cost over all stages that run again when the parameter changes.
double cost_of_change(std::string_view parameter);

}  // namespace umbrameter
