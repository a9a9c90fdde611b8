// Frames that another renderer wrote to files.
#pragma once

#include "experiments/engine/frame_source.h"
#include "experiments/settings/frame_params.h"

namespace umbrameter {

/// Reads frame.* of the experiment. Images must have the view's size; a PNG of visibility or occlusion holds its code
/// values as they are, one of light is decoded. `origin` is Scene::origin, by which positions are moved. Throws Error
/// (usage) for files that contradict one another, and Error (unreadable_input) naming the file.
FrameSource frames_of(const FrameParams& params, const dvec3& origin);

}  // namespace umbrameter
