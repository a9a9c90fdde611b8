#include "results/layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "results/layer_description.h"

namespace umbrameter {
namespace {

constexpr const char* color_channels[] = {"R", "G", "B"};

void add_shadow(LayeredImage& image, const std::string& light, const ShadowMeasurement& shadow) {
  if (shadow.truth) add_layer(image, layer_name(Layer::truth_visibility, light), shadow.truth->visibility);
  if (shadow.truth && shadow.is_sampled) {
    add_layer(image, layer_name(Layer::truth_visibility_standard_error, light), shadow.truth->standard_error);
    add_layer(image, layer_name(Layer::truth_visibility_variance, light), shadow.truth->variance);
    add_layer(image, layer_name(Layer::truth_visibility_samples, light), shadow.truth->samples);
  }
  if (shadow.raster) add_layer(image, layer_name(Layer::raster_visibility, light), shadow.raster->visibility);
  if (!shadow.truth || !shadow.raster) return;
  add_layer(image, layer_name(Layer::error_visibility, light),
            signed_error(shadow.raster->visibility, shadow.truth->visibility));
  if (by_cause(shadow) == nullptr) {
    Image<float> counted(shadow.counted.exclusion.width, shadow.counted.exclusion.height);
    for (std::size_t i = 0; i < counted.size(); ++i) {
      counted[i] = shadow.counted.exclusion[i] == PixelExclusion::none ? 1.0f : 0.0f;
    }
    add_layer(image, layer_name(Layer::counted, light), counted);
    return;
  }
  Image<PixelClass> classes = classify(shadow.raster->wrong, shadow.counted);
  if (!renderer_title(shadow.experiment).empty()) {
    // A frame is never quite 1 where it is lit: what no picture could show has no cause.
    const Image<float> error = signed_error(shadow.raster->visibility, shadow.truth->visibility);
    for (std::size_t i = 0; i < classes.size(); ++i) {
      const bool is_wrong = classes[i] != PixelClass::not_counted && classes[i] != PixelClass::background;
      if (is_wrong && std::abs(error[i]) < visible_step) classes[i] = PixelClass::correct;
    }
  }
  Image<float> numbers(classes.width, classes.height);
  for (std::size_t i = 0; i < classes.size(); ++i) numbers[i] = static_cast<float>(classes[i]);
  add_layer(image, layer_name(Layer::classes, light), numbers);
  const WrongTaps& wrong = shadow.raster->wrong;
  if (wrong.weight_sum == 1) return;
  for (std::size_t c = 0; c < cause_count; ++c) {
    Image<float> share(classes.width, classes.height);
    for (std::size_t i = 0; i < share.size(); ++i) {
      share[i] = static_cast<float>(wrong.weights[i][static_cast<int>(c)]) / static_cast<float>(wrong.weight_sum);
    }
    add_layer(image, layer_name(layer_of(static_cast<Cause>(c)), light), share);
  }
}

void add_ao(LayeredImage& image, const AoMeasurement& ao) {
  if (ao.truth) {
    add_layer(image, layer_name(Layer::truth_ao), ao.truth->ao);
    add_layer(image, layer_name(Layer::truth_ao_standard_error), ao.truth->standard_error);
    add_layer(image, layer_name(Layer::truth_ao_variance), ao.truth->variance);
    add_layer(image, layer_name(Layer::truth_ao_samples), ao.truth->samples);
    if (!ao.truth->bent_normal.empty()) add_layer(image, layer_name(Layer::truth_bent_normal), ao.truth->bent_normal);
    if (!ao.truth->hit_distance.empty())
      add_layer(image, layer_name(Layer::truth_ao_hit_distance), ao.truth->hit_distance);
  }
  if (ao.raster) add_layer(image, layer_name(Layer::raster_ao), *ao.raster);
  if (ao.statistics) add_layer(image, layer_name(Layer::error_ao), signed_error(*ao.raster, ao.truth->ao));
  if (!ao.stages) return;
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const auto stage = static_cast<AoStage>(k);
    add_layer(image, layer_name(layer_of(stage)), stage_difference(ao.stages->images, stage));
  }
}

void add_image(LayeredImage& image, const SceneFacts& scene, const ImageMeasurement& shaded) {
  const auto exposure = static_cast<float>(shaded.experiment.shading.exposure);
  if (shaded.truth) add_color_layer(image, layer_name(Layer::truth_image), *shaded.truth);
  if (!shaded.standard_error.empty())
    add_layer(image, layer_name(Layer::truth_image_standard_error), shaded.standard_error);
  if (shaded.raster) add_color_layer(image, layer_name(Layer::raster_image), shaded.raster->radiance);
  if (shaded.raster && !shaded.raster->light_buffer.empty()) {
    add_color_layer(image, layer_name(Layer::raster_light_buffer), shaded.raster->light_buffer);
  }
  if (!shaded.statistics) return;
  add_layer(image, layer_name(Layer::error_image),
            signed_error(luminance(shaded.raster->radiance, exposure), luminance(*shaded.truth, exposure)));
  Image<float> causes(shaded.causes.width, shaded.causes.height);
  for (std::size_t i = 0; i < causes.size(); ++i) causes[i] = static_cast<float>(shaded.causes[i]);
  add_layer(image, layer_name(Layer::cause_image), causes);
  if (!shaded.gbuffer_change) return;
  add_layer(image, layer_name(Layer::gbuffer_change_image), shaded.gbuffer_change->image);
  add_layer(image, layer_name(Layer::gbuffer_change_ao), shaded.gbuffer_change->ao);
  for (std::size_t i = 0; i < shaded.lights.size(); ++i) {
    add_layer(image, layer_name(Layer::gbuffer_change_visibility, scene.layer(shaded.lights[i])),
              shaded.gbuffer_change->visibility[i]);
  }
}

void add_picture(LayeredImage& image, const Image<vec3>& picture, const GBuffer& gbuffer) {
  for (int c = 0; c < 3; ++c) {
    Channel channel{color_channels[c], Image<float>(picture.width, picture.height)};
    for (std::size_t i = 0; i < picture.size(); ++i) channel.values[i] = picture[i][c];
    image.channels.push_back(std::move(channel));
  }
  Channel alpha{"A", Image<float>(picture.width, picture.height)};
  for (std::size_t i = 0; i < picture.size(); ++i) alpha.values[i] = gbuffer.is_surface(i) ? 1.0f : 0.0f;
  image.channels.push_back(std::move(alpha));
  image.channels.push_back({layer_name(Layer::depth), gbuffer.depth});
}

// A background pixel has no position; the G-buffer's zeros would read as points at the origin.
Image<vec3> surface_positions(const GBuffer& gbuffer) {
  Image<vec3> positions = gbuffer.position;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!gbuffer.is_surface(i)) positions[i] = vec3(std::numeric_limits<float>::quiet_NaN());
  }
  return positions;
}

// So that equal runs store equal bytes.
void drop_time(TraceStatistics& statistics) {
  statistics.seconds = 0.0;
  statistics.from_cache = false;
}

void drop_images(ShadowMeasurement& shadow) {
  shadow.counted.exclusion = {};
  if (shadow.raster) {
    shadow.raster->visibility = {};
    shadow.raster->wrong.weights = {};
  }
  if (!shadow.truth) return;
  drop_time(shadow.truth->statistics);
  for (Image<float> TracedVisibility::*image : {&TracedVisibility::visibility, &TracedVisibility::standard_error,
                                                &TracedVisibility::variance, &TracedVisibility::samples}) {
    (*shadow.truth).*image = {};
  }
}

void drop_images(AoMeasurement& ao) {
  if (ao.raster) *ao.raster = {};
  if (ao.stages) {
    ao.stages->images = {};
    drop_time(ao.stages->integrals);
  }
  if (!ao.truth) return;
  drop_time(ao.truth->statistics);
  for (Image<float> TracedAo::*image :
       {&TracedAo::ao, &TracedAo::standard_error, &TracedAo::variance, &TracedAo::samples, &TracedAo::hit_distance}) {
    (*ao.truth).*image = {};
  }
  ao.truth->bent_normal = {};
}

void drop_images(ImageMeasurement& shaded) {
  if (shaded.raster) {
    shaded.raster->radiance = {};
    shaded.raster->light_buffer = {};
  }
  if (shaded.truth) *shaded.truth = {};
  shaded.standard_error = {};
  shaded.causes = {};
  if (shaded.gbuffer_change) shaded.gbuffer_change = ImageMeasurement::GBufferChange{};
}

}  // namespace

void move_to_layers(const SceneFacts& scene, Measurement& measurement) {
  LayeredImage& image = measurement.layers;
  GBuffer& gbuffer = measurement.surfels.gbuffer;
  for (const ShadowMeasurement& shadow : measurement.shadows) add_shadow(image, scene.layer(shadow.light), shadow);
  if (measurement.ao) add_ao(image, *measurement.ao);
  if (measurement.image) add_image(image, scene, *measurement.image);
  add_layer(image, layer_name(Layer::gbuffer_position), surface_positions(gbuffer));
  add_layer(image, layer_name(Layer::gbuffer_normal), gbuffer.geometric_normal);
  add_picture(image, measurement.picture, gbuffer);
  const dmat4 view_from = view_from_world(measurement.surfels.view);
  image.world_to_camera = mat4(view_from);
  image.world_to_ndc = mat4(clip_from_view(measurement.surfels.view) * view_from);
  measurement.picture = {};
  for (ShadowMeasurement& shadow : measurement.shadows) drop_images(shadow);
  if (measurement.ao) drop_images(*measurement.ao);
  if (measurement.image) drop_images(*measurement.image);
  GBuffer kept;
  kept.width = gbuffer.width;
  kept.height = gbuffer.height;
  kept.instance = std::move(gbuffer.instance);
  gbuffer = std::move(kept);
}

const Image<float>* find_channel(const LayeredImage& layers, std::string_view name) {
  const auto found = std::ranges::find(layers.channels, name, &Channel::name);
  return found == layers.channels.end() ? nullptr : &found->values;
}

const Image<float>* find_values(const LayeredImage& layers, Layer layer, std::string_view light) {
  return find_channel(layers, layer_name(layer, light) + ".Y");
}

Image<vec3> colors_of(const LayeredImage& layers, Layer layer) {
  const std::string name = layer_name(layer);
  Image<vec3> colors;
  for (int c = 0; c < 3; ++c) {
    const Image<float>* values = find_channel(layers, (name.empty() ? "" : name + ".") + color_channels[c]);
    if (values == nullptr) return {};
    if (colors.empty()) colors = Image<vec3>(values->width, values->height);
    for (std::size_t i = 0; i < values->size(); ++i) colors[i][c] = (*values)[i];
  }
  return colors;
}

std::vector<NamedLayer> named_layers(const LayeredImage& image) {
  std::vector<NamedLayer> layers;
  std::string last = "none";
  for (const Channel& channel : image.channels) {
    const std::size_t dot = channel.name.rfind('.');
    const bool is_depth = channel.name == layer_name(Layer::depth);
    std::string name = dot != std::string::npos ? channel.name.substr(0, dot) : is_depth ? channel.name : "";
    if (name == last) continue;
    if (const std::optional<NamedLayer> layer = find_layer(name)) layers.push_back(*layer);
    last = std::move(name);
  }
  return layers;
}

}  // namespace umbrameter
