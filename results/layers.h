// The layers of images.exr.
#pragma once

#include "reports/files/exr.h"
#include "results/layer_description.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// Makes measurement.layers: those that results/layer_description.h names, as far as they were measured. Of a hard
/// shadow with taps the causes, of others the counted pixels; the share of each cause if there are several taps a
/// pixel. Positions are NaN on the background. docs/output.md says what each layer holds. The images of the parts, and
/// of the surfels all but their instances, are then dropped: what is shown and stored comes from the layers.
void move_to_layers(const SceneFacts& scene, Measurement& measurement);

/// Null if there is no such layer of one value a pixel, or no such channel.
const Image<float>* find_values(const LayeredImage& layers, Layer layer, std::string_view light = {});
const Image<float>* find_channel(const LayeredImage& layers, std::string_view name);

/// A layer of R, G and B; empty if there is none.
Image<vec3> colors_of(const LayeredImage& layers, Layer layer);

/// The layers of such an image, each once, in its order.
std::vector<NamedLayer> named_layers(const LayeredImage& image);

}  // namespace umbrameter
