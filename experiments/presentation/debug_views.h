// Pictures of what a renderer works with: buffers, shadow maps, the scene as a light sees it. Each is a figure, and an
// overlay in a corner of the picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/presentation/presentation.h"

namespace umbrameter {

struct DebugView {
  std::string stem;   ///< of the figure: "shadow_map_sun_1"
  std::string title;  ///< "Shadow map: sun, view 1"
  std::string caption;
  Image<glm::u8vec3> picture;
};

/// What run.overlay may list, for messages: "depth, normal, …, shadow-map:LIGHT".
std::string debug_view_names();

/// Throws Error (usage) for a name of the comma-separated list that does not exist or that this experiment does not
/// have: an unknown view or light, a light buffer without deferred shading. Before any work.
void check_debug_views(const Stages& stages, const Experiment& experiment);

/// The views that run.overlay lists, in that order; "all" is every one. The measurement has the technique's results,
/// with its image.
std::vector<DebugView> make_debug_views(Stages& stages, const Measurement& measurement);

/// The image with the views as overlays, and each view as a figure.
Presentation present_debug_views(Stages& stages, const Measurement& measurement);

/// Draws the views as quads along the lower edge, from the left, a fifth of the width each; rows above as needed. What
/// does not fit into the image is left out.
void draw_overlays(Image<glm::u8vec3>& picture, const std::vector<DebugView>& views);

}  // namespace umbrameter
