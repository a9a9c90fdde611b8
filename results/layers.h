// The layers of images.exr.
#pragma once

#include "reports/files/exr.h"
#include "results/layer_description.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// The layers that results/layer_description.h names, as far as they were measured. Of a hard shadow with taps the
/// causes, of others the counted pixels; the share of each cause if there are several taps a pixel. Positions are NaN
/// on the background. docs/output.md says what each layer holds.
LayeredImage layers_of(const SceneFacts& scene, const Measurement& measurement);

/// The layers of such an image, each once, in its order.
std::vector<NamedLayer> named_layers(const LayeredImage& image);

}  // namespace umbrameter
