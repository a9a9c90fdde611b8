// What each layer of images.exr is: name, title, unit, role and colour scale, written once for file, page, figures and
// report.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/ao_stages.h"
#include "reports/figures/figures.h"
#include "reports/page/viewer_data.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

/// The kinds of layer. Of a light, each light has one.
enum class Layer : int {
  truth_visibility,
  truth_visibility_standard_error,
  truth_visibility_variance,
  truth_visibility_samples,
  raster_visibility,
  error_visibility,
  counted,
  classes,
  acne,
  false_occlusion,
  peter_panning,
  leak,
  truth_ao,
  truth_ao_standard_error,
  truth_ao_variance,
  truth_ao_samples,
  truth_bent_normal,
  truth_ao_hit_distance,
  raster_ao,
  error_ao,
  ao_stage_model,
  ao_stage_off_screen,
  ao_stage_hidden,
  ao_stage_thin,
  ao_stage_approximation,
  ao_stage_sampling,
  ao_stage_blur,
  truth_image,
  truth_image_standard_error,
  raster_image,
  raster_light_buffer,
  error_image,
  cause_image,
  gbuffer_change_visibility,
  gbuffer_change_ao,
  gbuffer_change_image,
  gbuffer_position,
  gbuffer_normal,
  picture,
  depth,
};

/// What a layer is about.
enum class LayerSubject { light, ao, image, scene };

struct LayerDescription {
  Layer layer{};
  std::string_view name;  ///< in images.exr, of a light without the light's: "truth_visibility"
  LayerSubject subject{};
  std::string_view title;  ///< "Reference"
  std::string_view unit;   ///< "1" of shares and luminance, empty of indices and directions
  ViewerRole role = ViewerRole::other;
  ViewerKind kind = ViewerKind::number;
  double reach = 1.0;  ///< the colour scale ends at this, that of an error at both ±reach; 0: it depends on the values
  std::string_view scale_label{};  ///< of a colour scale
  bool is_for_programs = false;    ///< the viewer leaves it out: incompressible, and of no use to the eye
};

/// In the order of Layer.
const std::vector<LayerDescription>& layer_descriptions();
const LayerDescription& describe(Layer layer);

inline Layer layer_of(Cause cause) {
  return static_cast<Layer>(static_cast<int>(Layer::acne) + static_cast<int>(cause));
}

inline Layer layer_of(AoStage stage) {
  return static_cast<Layer>(static_cast<int>(Layer::ao_stage_model) + static_cast<int>(stage));
}

/// "truth_ao", or "truth_visibility_sun" of the light whose layers end so.
std::string layer_name(Layer layer, std::string_view light = {});

/// The layer with this name in images.exr, and the ending of its light.
struct NamedLayer {
  const LayerDescription* description = nullptr;
  std::string light{};
};
std::optional<NamedLayer> find_layer(std::string_view name);

/// The same for all images of the layer, so that two runs can be compared.
ColorScale color_scale(Layer layer);

}  // namespace umbrameter
