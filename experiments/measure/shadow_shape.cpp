#include "experiments/measure/shadow_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "compare/shimmer.h"
#include "experiments/measure/measure.h"
#include "raytrace/casters.h"
#include "results/number_text.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

// The surfels that a moved view sees, as the experiment makes them.
GBuffer surfels_of(Stages& stages, const Experiment& experiment, const View& view) {
  if (experiment.view.surfels == SurfelSource::traced) return trace_gbuffer(stages.tracer(), view);
  return read_back(stages.context(), draw_gbuffer(stages.context(), stages.uploaded(), view));
}

// The visibility of the measured technique from a map that is drawn with this layout, at these surfels, which `view`
// sees.
Image<float> draw_visibility_with(Stages& stages, const ShadowMeasurement& shadow, const MapLayout& layout,
                                  const GpuGBuffer& surfels, const View& view) {
  const Experiment& experiment = shadow.experiment;
  const gl::Context& context = stages.context();
  const UploadedScene& scene = stages.uploaded();
  const Light light = stages.light(experiment, shadow.light);
  const ShadowTechnique technique = make_technique(experiment.shadow, half_size(light.emitter));
  const ShadowMap map = draw_shadow_map(context, scene, light, layout, experiment.shadow.map_depth);
  const TechniqueMap filtered = filter_map({context, scene, light, map, experiment.shadow.map_depth}, technique);
  return draw_visibility(context,
                         {scene, surfels, map, light, experiment.shadow.bias, technique, nullptr, &filtered, &view})
      .visibility;
}

// The camera's steps for FitShimmer: right, up and forward, in texels of the finest view. No whole number, so that a
// fit which does not move in whole texels changes.
constexpr double step_texels = 2.3;
const std::array<dvec3, 3> steps = {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, -1)};

bool follows_camera(const ShadowMeasurement& shadow) {
  return shadow.layout.kind == MapKind::orthographic &&
         (shadow.layout.views.size() > 1 || shadow.experiment.shadow.fit.fit == MapFit::view);
}

SeamStatistics measure_seams(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  MapLayout layout = shadow.layout;
  layout.blend = 0.0;
  const Image<std::uint8_t> seams = find_seams(surfels->gbuffer, layout, shadow.counted);
  const Image<float> own = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
  layout.uses_neighbour = true;
  const Image<float> neighbour = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
  return analyze_seams(seams, own, neighbour, shadow.counted);
}

FitShimmer measure_fit_shimmer(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  const Light light = stages.light(experiment, shadow.light);
  double finest = shadow.layout.views.front().half_extent;
  for (const MapView& view : shadow.layout.views) finest = std::min(finest, view.half_extent);
  FitShimmer shimmer;
  shimmer.step = step_texels * 2.0 * finest / shadow.layout.resolution;
  for (const dvec3& step : steps) {
    View view = surfels->view;
    view.camera.world_from_camera[3] = view.camera.world_from_camera * dvec4(shimmer.step * step, 1.0);
    const GBuffer seen = surfels_of(stages, experiment, view);
    const MapLayout layout =
        fit_map(light, stages.mapped_bounds(), experiment.shadow.map, {seen, view}, experiment.shadow.fit);
    CountedPixels both = count_pixels(surfels->gbuffer, light, layout);
    for (std::size_t i = 0; i < both.exclusion.size(); ++i) {
      if (shadow.counted.exclusion[i] != PixelExclusion::none) both.exclusion[i] = shadow.counted.exclusion[i];
    }
    const Image<float> after = draw_visibility_with(stages, shadow, layout, *gpu_surfels, surfels->view);
    const Flips flips = count_flips(shadow.raster->visibility, after, both);
    shimmer.pixels += flips.pixels;
    shimmer.mean_change += flips.share / static_cast<double>(steps.size());
    shimmer.largest_change = std::max(shimmer.largest_change, flips.share);
  }
  return shimmer;
}

// The error of each cascade or cube face, seams, and shimmer of the fit.
MapViews measure_map_views(Stages& stages, const ShadowMeasurement& shadow) {
  MapViews measured;
  const Experiment& experiment = shadow.experiment;
  if (shadow.layout.views.size() > 1) {
    const Light light = stages.light(experiment, shadow.light);
    const auto surfels = stages.surfels(experiment);
    const ShapeInput input{surfels->gbuffer, shadow.truth->visibility, shadow.counted, light, shadow.layout};
    measured.views =
        analyze_views(input, shadow.raster->visibility, by_cause(shadow) != nullptr ? &shadow.raster->wrong : nullptr);
    measured.seams = measure_seams(stages, shadow);
  }
  if (experiment.run.shimmer && follows_camera(shadow)) measured.shimmer = measure_fit_shimmer(stages, shadow);
  return measured;
}

// Quarters and halves of a texel or pixel, along one axis and along both.
const std::array<dvec2, 4> moves = {dvec2(0.25, 0.25), dvec2(0.5, 0.0), dvec2(0.0, 0.5), dvec2(0.5, 0.5)};

void add(Flips& sum, const Flips& flips) {
  sum.pixels += flips.pixels;
  sum.share += flips.share;
}

double counted_pixels(const ShadowMeasurement& shadow) {
  return static_cast<double>(shadow.counted.totals[static_cast<std::size_t>(PixelExclusion::none)]);
}

// Pixels whose error against an area light has no shadow in it.
void note_pixels_of_area_light(Stages& stages, const ShadowMeasurement& shadow, const Light& light,
                               const GBuffer& gbuffer) {
  if (!is_area(light)) return;
  Light centre = light;
  centre.emitter = std::monostate{};
  const auto* const sphere = std::get_if<SphereEmitter>(&light.emitter);
  std::uint64_t turned = 0;
  std::uint64_t inside = 0;
  for (std::size_t i = 0; i < gbuffer.position.size(); ++i) {
    if (shadow.counted.exclusion[i] != PixelExclusion::none) continue;
    const dvec3 position(gbuffer.position[i]);
    if (sphere != nullptr && glm::length(light.position() - position) < sphere->radius) {
      ++inside;
    } else if (!faces(centre, position, dvec3(gbuffer.geometric_normal[i]))) {
      ++turned;
    }
  }
  const auto share = [&](std::uint64_t pixels) { return static_cast<double>(pixels) / counted_pixels(shadow); };
  constexpr double many = 0.01;
  if (share(inside) > many) {
    stages.add_notes(
        {fmt::format("{}: {} of the counted pixels are inside the light, where its reference has no "
                     "shadow; make the light smaller",
                     stages.title(shadow.light), percent(share(inside)))});
  }
  if (share(turned) > many) {
    stages.add_notes(
        {fmt::format("{}: {} of the counted pixels do not face the light's centre, only a part of the "
                     "light; a technique that knows the centre alone has them dark, whatever its bias, also where "
                     "that part lights them",
                     stages.title(shadow.light), percent(share(turned)))});
  }
}

// Names the part of the error that is the light leak of casters which the map's planes cut off. The caster is the
// surface nearest to the receiver: if it is before the near plane, so is any other.
void note_casters_cut_off(Stages& stages, const ShadowMeasurement& shadow, const GBuffer& gbuffer,
                          const TracedCasters& traced) {
  const MapLayout encoded = with_depth_encoding(shadow.layout, shadow.experiment.shadow.map_depth);
  if (stages.has_engine() || !is_projective(encoded.kind) || encoded.encoded_near <= 0.0) return;
  const WrongTaps& wrong = shadow.raster->wrong;
  std::uint64_t before = 0;
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < wrong.weights.size(); ++i) {
    if (traced.instance[i] == no_id || shadow.counted.exclusion[i] != PixelExclusion::none) continue;
    const dvec3 receiver = dvec3(encoded.light_from_world * dvec4(gbuffer.position[i], 1.0));
    const dvec3 caster = receiver * (1.0 - traced.distance[i] / glm::length(receiver));
    const double depth = axis_depth(encoded, caster);
    if (depth < encoded.encoded_near) before += wrong.weights[i].w;
    if (depth > far_end_of(encoded)) beyond += wrong.weights[i].w;
  }
  const auto add_note = [&](std::uint64_t weight, const char* side, const char* plane, double depth,
                            const char* remedy) {
    const double share = static_cast<double>(weight) / wrong.weight_sum / counted_pixels(shadow);
    if (!(share > little_acne_share)) return;
    stages.add_notes(
        {fmt::format("{}: an error of {}, a part of the light leak, comes from casters {} the light than {}, {}: the "
                     "map leaves them out, whatever the bias; {} it",
                     stages.title(shadow.light), percent(share), side, plane, metres_text(depth), remedy)});
  };
  add_note(before, "nearer to", "shadow.depth-near", encoded.encoded_near, "lower");
  add_note(beyond, "farther from", "shadow.depth-far", far_end_of(encoded), "raise");
}

Flips mean_of(Flips sum) { return {sum.pixels / moves.size(), sum.share / static_cast<double>(moves.size())}; }

}  // namespace

ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto hard_truth = shadow.is_sampled ? stages.hard_truth(experiment, shadow.light) : nullptr;
  const Light light = stages.light(experiment, shadow.light);
  const ShapeInput input{surfels->gbuffer,
                         shadow.truth->visibility,
                         shadow.counted,
                         light,
                         shadow.layout,
                         &shadow.truth->variance,
                         hard_truth ? &hard_truth->visibility : nullptr};
  const VisibilityStatistics* causes = by_cause(shadow);
  if (causes == nullptr) {
    note_pixels_of_area_light(stages, shadow, light, surfels->gbuffer);
    ShadowShape shape{analyze_error_shape(input, shadow.raster->visibility)};
    if (!shadow.is_sampled) shape.error.outside_penumbra.reset();
    if (!stages.has_engine()) shape.views = measure_map_views(stages, shadow);
    return shape;
  }
  const TracedCasters traced = trace_casters(stages.tracer(), surfels->gbuffer, light);
  note_casters_cut_off(stages, shadow, surfels->gbuffer, traced);
  const RasterVisibility& raster = *shadow.raster;
  CasterShapes casters = analyze_casters(
      {input, raster.visibility, raster.wrong, traced.instance, traced.distance, stages.scene(), surfels->view});
  const std::string missing = missing_contacts_text(casters.search);
  // As little as acne that nobody sees.
  if (!missing.empty() && causes->peter_panning > little_acne_share) {
    stages.add_notes({stages.title(shadow.light) + ": there is peter-panning, but " + missing});
  }
  return {analyze_error_shape(input, raster.wrong), std::move(casters.casters), casters.search, std::nullopt,
          stages.has_engine() ? MapViews{} : measure_map_views(stages, shadow)};
}

Shimmer measure_shimmer(Stages& stages, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const auto surfels = stages.surfels(experiment);
  const auto gpu_surfels = stages.gpu_surfels(experiment);
  const Light light = stages.light(experiment, shadow.light);
  const Image<float>& before = shadow.raster->visibility;

  Shimmer shimmer;
  for (const dvec2& move : moves) {
    const MapLayout shifted = shift_grid(shadow.layout, move, stages.mapped_bounds().all());
    const Image<float> after = draw_visibility_with(stages, shadow, shifted, *gpu_surfels, surfels->view);
    const double share = count_flips(before, after, shadow.counted).share;
    shimmer.grid_mean += share / static_cast<double>(moves.size());
    shimmer.grid_largest = std::max(shimmer.grid_largest, share);
  }

  Flips drawn;
  Flips traced;
  for (const dvec2& move : moves) {
    const View view = shift_view(surfels->view, move);
    const GBuffer moved = surfels_of(stages, experiment, view);
    const Image<float> after =
        draw_visibility_with(stages, shadow, shadow.layout, upload(stages.context(), moved), view);
    add(drawn, count_flips(before, after, shadow.counted, surfels->gbuffer, moved));
    if (shadow.is_sampled) continue;
    const Image<float> truth = trace_visibility(stages.tracer(), moved, light).visibility;
    add(traced, count_flips(shadow.truth->visibility, truth, shadow.counted, surfels->gbuffer, moved));
  }
  shimmer.camera = mean_of(drawn);
  if (!shadow.is_sampled) shimmer.camera_truth = mean_of(traced);
  return shimmer;
}

}  // namespace umbrameter
