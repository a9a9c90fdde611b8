#include "experiments/measure/measure_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_space.h"
#include "compare/shadow_edges.h"
#include "compare/visibility.h"
#include "core/error.h"

namespace umbrameter {
namespace {

double mean_absolute(const Image<float>& change, const GBuffer& gbuffer) {
  double sum = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    sum += std::abs(static_cast<double>(change[i]));
    ++pixels;
  }
  return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0;
}

Image<vec3> sum_of(const Image<vec3>& a, const Image<vec3>& b) {
  Image<vec3> sum = a;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += b[i];
  return sum;
}

// Adds to the GPU's image the change that replacing an input makes to the CPU's image.
Image<float> with_replaced(const Image<float>& raster, const Image<float>& same_inputs, Image<float> replaced) {
  for (std::size_t i = 0; i < replaced.size(); ++i) replaced[i] = raster[i] + (replaced[i] - same_inputs[i]);
  return replaced;
}

// Shades on the CPU, light by light: the reference, the technique's image with the same inputs as the GPU's, and that
// image with one input replaced. finish() adds the ambient light and compares.
class Images {
 public:
  Images(Stages& stages, const Experiment& experiment, Sides sides)
      : stages_(stages),
        experiment_(experiment),
        sides_(sides),
        surfels_(stages.surfels(experiment)),
        exact_(surfels_->gbuffer),
        view_(surfels_->view),
        shading_(stages.shading_surfels(experiment)),
        same_inputs_(blank()),
        with_true_shadows_(blank()),
        with_exact_gbuffer_(blank()),
        truth_(blank()),
        variance_(exact_.width, exact_.height, 0.0f),
        samples_(exact_.width, exact_.height, 0.0f),
        edge_distance_(exact_.width, exact_.height, std::numeric_limits<float>::infinity()) {}

  void add(std::uint32_t index) {
    const Light light = stages_.light(experiment_, index);
    if (sides_.truth) add_truth(index, light);
    if (!sides_.raster) return;
    Image<float> exact = stages_.draw(experiment_, index, false).visibility;
    Image<float> drawn = shading_.is_exact ? exact : stages_.draw_visibility_of(*shading_.gpu, experiment_, index);
    if (sides_.truth) {
      add_edges(index);
      add_light(same_inputs_, *shading_.gbuffer, view_, light, drawn, experiment_.shading);
      add_light(with_true_shadows_, *shading_.gbuffer, view_, light, stages_.truth(experiment_, index)->visibility,
                experiment_.shading);
      add_light(with_exact_gbuffer_, exact_, view_, light, exact, experiment_.shading);
      if (!shading_.is_exact) change_.visibility.push_back(signed_error(drawn, exact));
    }
    lights_.push_back(light);
    visibilities_.push_back(std::move(drawn));
  }

  ImageMeasurement finish() {
    ImageMeasurement measurement;
    measurement.experiment = experiment_;
    const float exposure = static_cast<float>(experiment_.shading.exposure);
    Image<float> exact_ao, drawn_ao;
    if (sides_.raster) {
      exact_ao = stages_.draw_ao(experiment_);
      drawn_ao = shading_.is_exact ? exact_ao : stages_.draw_ao_of(*shading_.gpu, experiment_);
      measurement.raster = draw(drawn_ao);
    }
    if (!sides_.truth) return measurement;
    const auto true_ao = stages_.ao_truth(experiment_);
    measurement.truth = sum_of(truth_, ambient(exact_, true_ao->ao));
    add_ao_noise(*true_ao);
    if (!sides_.raster) return finish_truth(std::move(measurement));

    const Image<float> raster = luminance(measurement.raster->radiance, exposure);
    const Image<vec3> drawn_ambient = ambient(*shading_.gbuffer, drawn_ao);
    const Image<float> same_inputs = luminance(sum_of(same_inputs_, drawn_ambient), exposure);
    const auto replaced = [&](const Image<vec3>& lights, const Image<vec3>& ambient_light) {
      return with_replaced(raster, same_inputs, luminance(sum_of(lights, ambient_light), exposure));
    };
    const Image<float> true_shadows = replaced(with_true_shadows_, drawn_ambient);
    const Image<float> true_occlusion = replaced(same_inputs_, ambient(*shading_.gbuffer, true_ao->ao));
    const Image<float> exact_gbuffer = replaced(with_exact_gbuffer_, ambient(exact_, exact_ao));
    const Image<float> truth = luminance(*measurement.truth, exposure);
    const ImageErrorInput input{raster,
                                {truth, variance_, samples_, degrees_of_freedom_, false},
                                {&true_shadows, &true_occlusion, &exact_gbuffer, &same_inputs},
                                edge_distance_,
                                exact_};
    measurement.statistics = analyze_image(input);
    if (!shading_.is_exact) {
      change_.ao = signed_error(drawn_ao, exact_ao);
      change_.image = signed_error(raster, exact_gbuffer);
      ImageStatistics& statistics = *measurement.statistics;
      for (const Image<float>& change : change_.visibility) {
        statistics.gbuffer_visibility += mean_absolute(change, exact_) / static_cast<double>(change_.visibility.size());
      }
      statistics.gbuffer_ao = mean_absolute(change_.ao, exact_);
      statistics.gbuffer_image = mean_absolute(change_.image, exact_);
      measurement.gbuffer_change = std::move(change_);
    }
    measurement.causes = classify_image(input, visible_step);
    return finish_truth(std::move(measurement));
  }

 private:
  Image<vec3> blank() const { return Image<vec3>(exact_.width, exact_.height, vec3(0)); }

  Image<vec3> ambient(const GBuffer& gbuffer, const Image<float>& ao) const {
    Image<vec3> image = blank();
    add_ambient(image, gbuffer, view_, ao, experiment_.shading);
    return image;
  }

  void add_truth(std::uint32_t index, const Light& light) {
    const auto truth = stages_.truth(experiment_, index);
    add_light(truth_, exact_, view_, light, truth->visibility, experiment_.shading);
    if (truth->variance.empty()) return;
    Image<vec3> unshadowed = blank();
    add_light(unshadowed, exact_, view_, light, Image<float>(exact_.width, exact_.height, 1.0f), experiment_.shading);
    add_noise(unshadowed, truth->variance, truth->samples, truth->degrees_of_freedom);
  }

  void add_edges(std::uint32_t index) {
    const auto hard = stages_.hard_truth(experiment_, index);
    const auto counted = stages_.counted(experiment_, index);
    const NearestEdges edges = nearest_edges(find_shadow_edges(hard->visibility, exact_, *counted));
    for (std::size_t i = 0; i < edge_distance_.size(); ++i) {
      edge_distance_[i] = std::min(edge_distance_[i], edges.distance[i]);
    }
  }

  void add_ao_noise(const TracedAo& ao) {
    if (ao.variance.empty()) return;
    add_noise(ambient(exact_, Image<float>(exact_.width, exact_.height, 1.0f)), ao.variance, ao.samples,
              ao.degrees_of_freedom);
  }

  void add_noise(const Image<vec3>& factor, const Image<float>& variance, const Image<float>& samples, int degrees) {
    const auto exposure = static_cast<float>(experiment_.shading.exposure);
    for (std::size_t i = 0; i < variance_.size(); ++i) {
      const float weight = exposure * static_cast<float>(luminance(factor[i]));
      variance_[i] += weight * weight * variance[i];
      samples_[i] += samples[i];
    }
    degrees_of_freedom_ = degrees_of_freedom_ == 0 ? degrees : std::min(degrees_of_freedom_, degrees);
  }

  ImageMeasurement finish_truth(ImageMeasurement measurement) const {
    if (degrees_of_freedom_ == 0) return measurement;
    measurement.standard_error = variance_;
    for (float& value : measurement.standard_error.pixels) value = std::sqrt(value);
    return measurement;
  }

  ShadedImage draw(const Image<float>& ao) {
    std::vector<LitLight> lit;
    for (std::size_t i = 0; i < lights_.size(); ++i) lit.push_back({&lights_[i], &visibilities_[i]});
    return stages_.shade(experiment_, lit, ao);
  }

  Stages& stages_;
  const Experiment& experiment_;
  Sides sides_;
  std::shared_ptr<const Surfels> surfels_;
  const GBuffer& exact_;
  const View& view_;
  ShadingSurfels shading_;
  Image<vec3> same_inputs_, with_true_shadows_, with_exact_gbuffer_, truth_;
  Image<float> variance_;       // of the truth's luminance × exposure
  Image<float> samples_;        // rays to all lights and over the hemisphere
  int degrees_of_freedom_ = 0;  // 0: nothing was sampled
  Image<float> edge_distance_;
  ImageMeasurement::GBufferChange change_;
  std::vector<Light> lights_;
  std::vector<Image<float>> visibilities_;
};

}  // namespace

void check_shading(const Stages& stages, const Experiment& experiment) {
  if (experiment.shading.path != ShadingPath::deferred || experiment.scene_params.blend != BlendMode::opaque) return;
  for (const Material& material : stages.scene().materials) {
    if (material.alpha_mode != AlphaMode::blend && !(material.transmission > 0.0f)) continue;
    throw Error(ExitCode::usage, "shading.path=deferred",
                "a G-buffer holds one surface per pixel, and the material '" + material.name + "' is transparent",
                "choose --scene.blend mask or leave-out, or shade it as opaque with --shading.path forward");
  }
}

ImageMeasurement measure_image(Stages& stages, const Experiment& experiment, std::span<const std::uint32_t> lights,
                               Sides sides) {
  check_shading(stages, experiment);
  Images images(stages, experiment, sides);
  for (const std::uint32_t light : lights) images.add(light);
  ImageMeasurement measurement = images.finish();
  if (measurement.statistics) {
    const std::vector<MetricColumn> columns = metric_columns(experiment.run, false);
    if (!columns.empty()) {
      measurement.metrics =
          score(columns, compared_image(stages, experiment, {measurement.raster->radiance, *measurement.truth}));
    }
  }
  measurement.lights.assign(lights.begin(), lights.end());
  return measurement;
}

}  // namespace umbrameter
