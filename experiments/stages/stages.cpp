#include "experiments/stages/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/lists.h"
#include "raster/gl/timer.h"
#include "raster/shadow/map_layer.h"
#include "raytrace/pixel_shadow.h"
#include "scenes/ground.h"

namespace umbrameter {
namespace {

// Both sides multiply three lengths in single precision, whose range is about 1e-38 to 1e38.
void require_measurable(const Bounds& bounds, const dvec3& origin, const std::string& name) {
  constexpr double longest = 1e12;
  constexpr double shortest = 1e-10;
  const dvec3 corner = glm::max(glm::abs(origin + bounds.min), glm::abs(origin + bounds.max));
  const double reach = std::max({corner.x, corner.y, corner.z});
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::unreadable_input, name, why,
                "scale the scene or set --scene.unit; 'umbrameter info' shows its bounds");
  };
  if (reach > longest)
    refuse(fmt::format("it extends to {:.3g} m from its origin; the limit is {:g} m", reach, longest));
  if (bounds.radius() < shortest) {
    refuse(fmt::format("its size is {:.3g} m; the minimum is {:g} m", 2.0 * bounds.radius(), shortest));
  }
}

}  // namespace

Stages::Stages(Scene scene, StageOptions options, const Console& console)
    : scene_(std::move(scene)),
      options_(std::move(options)),
      console_(console),
      bounds_(bounds_of(scene_), ground_of(scene_), boxes_of(scene_)),
      cache_(options_.cache, console) {
  add_notes(scene_.notes);
  if (bounds().empty()) {
    throw Error(ExitCode::unreadable_input, options_.source, "the scene has no triangles",
                "give a scene with meshes, or a built-in one ('umbrameter scenes')");
  }
  require_measurable(bounds(), scene_.origin, options_.source);
  std::vector<std::string> assumed;
  add_missing_light(scene_, assumed);
  add_notes(assumed);
  facts_ = facts_of(scene_);
}

void Stages::add_notes(const std::vector<std::string>& notes) {
  for (const std::string& text : notes) {
    if (std::ranges::find(notes_, text) != notes_.end()) continue;
    notes_.push_back(text);
    note(console_, text);
  }
}

std::vector<std::uint32_t> Stages::lights(const std::string& name_or_index) const {
  return select_lights(scene_, name_or_index);
}

void require_sense(const Experiment& experiment, std::span<const Light> lights) {
  require_sense(experiment.light, lights);
  require_sense(experiment.shadow.map, experiment.shadow.fit, lights);
}

void Stages::check_is_meaningful(const Experiment& experiment, const std::vector<std::uint32_t>& lights) const {
  require_sense(experiment, mapped(lights, [&](const std::uint32_t light) { return scene_.lights[light]; }));
}

void Stages::keep_cases(std::size_t cases, bool with_maps) {
  const auto keep = [&](auto&... memos) { (memos.keep(cases), ...); };
  keep(surfels_, gpu_surfels_, layout_, counted_, hard_truth_, sampled_truth_, gpu_truth_, ao_truth_);
  if (with_maps) keep(map_, stored_depths_, filtered_map_);
}

WorkClock Stages::work_clock() {
  return has_engine() || !context().device().software ? clock_seconds : processor_seconds;
}

GroupTime Stages::time_stages(const std::function<void()>& work) {
  clock_->begin(work_clock(), [this] {
    if (context_) gl::wait_for_device();
  });
  work();
  return clock_->end();
}

ProgressBar Stages::bar(const char* stage) const {
  if (tracing_) return ProgressBar(Progress());
  return ProgressBar(console_, stage);
}

ProgressBar Stages::tracing_bar(const char* stage, std::function<std::uint64_t()> count_rays) const {
  if (tracing_) return ProgressBar(tracing_);
  return ProgressBar(console_, stage, std::move(count_rays));
}

const Tracer& Stages::tracer() {
  if (!tracer_) {
    ProgressBar progress = bar("acceleration structure");
    tracer_.emplace(scene_, progress.callback());
    costs_.build = tracer_->build_statistics();
  }
  return *tracer_;
}

const gl::Context& Stages::context() {
  if (!context_) {
    context_ = options_.context;
    if (!context_) {
      context_ = std::make_shared<gl::Context>(gl::Context::make({options_.gl_device, options_.threads}));
    }
    if (!context_->note().empty()) add_notes({context_->note()});
  }
  return *context_;
}

const UploadedScene& Stages::uploaded() {
  if (!uploaded_) uploaded_ = std::make_unique<UploadedScene>(upload(context(), scene_));
  return *uploaded_;
}

std::shared_ptr<const Surfels> Stages::surfels(const Experiment& experiment) {
  return get(surfels_, Stage::surfels, experiment, [&](const Experiment& read) {
    const ViewParams& params = read.view;
    const double aspect = static_cast<double>(params.size.width) / params.size.height;
    std::vector<std::string> assumed;
    View view{params.size.width, params.size.height, select_camera(scene_, params.camera, aspect, assumed)};
    add_notes(assumed);
    GBuffer gbuffer;
    if (params.surfels == SurfelSource::traced || has_engine()) {
      ProgressBar progress = bar("primary rays");
      gbuffer = trace_gbuffer(tracer(), view, progress.callback());
    } else {
      gbuffer = read_back(context(), draw_gbuffer(context(), uploaded(), view));
    }
    if (has_engine()) gbuffer = aligned_surfels(read, view, std::move(gbuffer));
    return Surfels{std::move(view), std::move(gbuffer)};
  });
}

std::shared_ptr<const GpuGBuffer> Stages::gpu_surfels(const Experiment& experiment) {
  const auto both = surfels(experiment);
  return gpu_surfels_.get(key_of(Stage::surfels, experiment), [&] { return upload(context(), both->gbuffer); });
}

std::string Stages::key(Stage stage, const Experiment& experiment, std::uint32_t light) const {
  return key_of(stage, experiment) + "of light " + std::to_string(light);
}

std::shared_ptr<const MapLayout> Stages::layout(const Experiment& experiment, std::uint32_t light) {
  return get(layout_, Stage::layout, experiment, light, [&](const Experiment& read) {
    const auto seen = surfels(read);
    ShadowMapParams map = read.shadow.map;
    map.resolution = map_size_of(read.engine).value_or(map.resolution);
    return with_point_map(fit_map(scene_.lights[light], bounds_, map, {seen->gbuffer, seen->view}, read.shadow.fit),
                          read.shadow.map_depth.point_map);
  });
}

std::shared_ptr<const CountedPixels> Stages::counted(const Experiment& experiment, std::uint32_t light) {
  return get(counted_, Stage::counted, experiment, light, [&](const Experiment& read) {
    const auto seen = surfels(read);
    const auto count = [&](const Image<std::uint8_t>& unlit) {
      return count_pixels(seen->gbuffer, this->light(read, light), *layout(read, light), unlit);
    };
    return has_engine() ? count_lit(framed(seen->view, light), count) : count({});
  });
}

ReferenceKey Stages::reference_key(const Experiment& experiment, Stage stage, const std::string& kind) {
  if (!cache_.enabled()) return {};
  return {kind,
          *tracer_identity_.get("", tracer_identity),
          *scene_content_.get("", [&] { return scene_content(scene_); }),
          *surfel_content_.get(key_of(Stage::surfels, experiment),
                               [&] { return surfel_content(surfels(experiment)->gbuffer); }),
          "",
          own_key_of(stage, experiment),
          static_cast<std::uint32_t>(experiment.run.seed)};
}

Light Stages::light(const Experiment& experiment, std::uint32_t light) const {
  Light lamp = with_extent(scene_.lights[light], experiment.light);
  if (experiment.truth.shadow == ShadowReference::point) lamp.emitter = std::monostate{};
  return lamp;
}

Stage Stages::reference_stage(const Experiment& experiment, std::uint32_t light) const {
  if (experiment.truth.shadow == ShadowReference::pixel) return Stage::pixel_reference;
  return is_area(this->light(experiment, light)) ? Stage::area_reference : Stage::binary_reference;
}

std::shared_ptr<const TracedVisibility> Stages::truth(const Experiment& experiment, std::uint32_t light) {
  const Stage stage = reference_stage(experiment, light);
  if (stage == Stage::binary_reference) return hard_truth(experiment, light);
  return get(sampled_truth_, stage, experiment, light,
             [&](const Experiment& read) { return trace(read, stage, light); });
}

std::shared_ptr<const TracedVisibility> Stages::hard_truth(const Experiment& experiment, std::uint32_t light) {
  constexpr Stage stage = Stage::binary_reference;
  return get(hard_truth_, stage, experiment, light, [&](const Experiment& read) { return trace(read, stage, light); });
}

TracedVisibility Stages::trace(const Experiment& experiment, Stage reference, std::uint32_t light) {
  Light lamp = this->light(experiment, light);
  const bool is_over_pixel = reference == Stage::pixel_reference;
  if (reference == Stage::binary_reference) lamp.emitter = std::monostate{};
  ReferenceKey key = reference_key(experiment, reference, "visibility");
  key.light = light_content(lamp);
  const auto seen = surfels(experiment);
  if (is_over_pixel) key.surfels += camera_content(seen->view.camera);
  const std::function<TracedVisibility()> trace = [&] {
    const Tracer& rays = tracer();
    ProgressBar progress = tracing_bar("shadow rays", [&] { return rays.rays_traced(); });
    const TruthSampling sampling{experiment.truth, static_cast<std::uint32_t>(experiment.run.seed)};
    if (is_over_pixel) {
      return trace_pixel_visibility(rays, seen->gbuffer, seen->view, lamp, sampling, progress.callback());
    }
    return trace_visibility(rays, seen->gbuffer, lamp, sampling, progress.callback());
  };
  const char* of = is_over_pixel                          ? "shadow over each pixel of "
                   : reference == Stage::binary_reference ? "hard shadow of "
                                                          : "soft shadow of ";
  TracedVisibility traced =
      cache_.get(key, {scene_title(experiment), of + title(light) + of_camera(seen->view)}, trace);
  add(costs_.shadow, traced.statistics);
  costs_.largest_offset = std::max(costs_.largest_offset, traced.statistics.largest_offset);
  return traced;
}

Experiment Stages::in_metres(const Experiment& experiment) const {
  return umbrameter::in_metres(experiment, 2.0 * bounds().radius());
}

std::shared_ptr<const ShadowMap> Stages::map(const Experiment& experiment, std::uint32_t light) {
  return map_.remake(key(Stage::map, experiment, light), [&](std::optional<ShadowMap> last) {
    const Experiment read = declared(Stage::map, experiment);
    const auto layout = this->layout(read, light);
    // Software drivers clear every page of a new texture, which takes longer than drawing a small scene.
    ShadowMap drawn = last && has_textures_for(*last, *layout) ? std::move(*last) : make_shadow_map(context(), *layout);
    drawn.layout = *layout;
    redraw_shadow_map(context(), uploaded(), scene_.lights[light], drawn, read.shadow.map_depth);
    return drawn;
  });
}

std::shared_ptr<const StoredDepths> Stages::stored_depths(const Experiment& experiment, std::uint32_t light) {
  return get(stored_depths_, Stage::map, experiment, light, [&](const Experiment& read) {
    const MapDepthParams& params = read.shadow.map_depth;
    const auto map = this->map(read, light);
    StoredDepths depths;
    depths.polygon_offset_unit = measure_offset_unit(context(), params.format);
    depths.range = depth_range_of(context(), *map);
    if (depths.range) {
      depths.step_at_nearest = depth_step(params, map->layout, depths.range->nearest);
      depths.step_at_farthest = depth_step(params, map->layout, depths.range->farthest);
    }
    return depths;
  });
}

HeldLookup Stages::shadow_lookup(const Experiment& experiment, std::uint32_t light, bool with_truth) {
  const auto seen = surfels(experiment);
  const auto gpu = gpu_surfels(experiment);
  const auto map = this->map(experiment, light);
  std::shared_ptr<const gl::Texture> gpu_truth;
  if (with_truth) {
    const Stage reference = reference_stage(experiment, light);
    gpu_truth = gpu_truth_.get(key(reference, experiment, light) + key(Stage::counted, experiment, light), [&] {
      const auto traced = truth(experiment, light);
      return upload_truth(context(), traced->visibility, counted(experiment, light)->exclusion);
    });
  }
  const ShadowTechnique technique =
      make_technique(experiment.shadow, half_size(with_extent(scene_.lights[light], experiment.light).emitter));
  const auto filtered = get(filtered_map_, Stage::filtered_map, experiment, light, [&](const Experiment& read) {
    return filter_map({context(), uploaded(), scene_.lights[light], *map, read.shadow.map_depth},
                      make_technique(read.shadow));
  });
  return {{uploaded(), *gpu, *map, scene_.lights[light], experiment.shadow.bias, technique, gpu_truth.get(),
           filtered.get(), &seen->view},
          {gpu, map, gpu_truth, filtered, seen}};
}

RasterVisibility Stages::draw(const Experiment& experiment, std::uint32_t light, bool with_truth) {
  if (has_engine()) return draw_engine(experiment, light, with_truth);
  return draw_visibility(context(), shadow_lookup(experiment, light, with_truth).lookup);
}

std::vector<Image<float>> Stages::draw_lookups(std::span<const Experiment> experiments, std::uint32_t light) {
  if (has_engine()) return engine_visibility(experiments, light);
  const StageClock::Running running(*clock_, Stage::visibility);
  const HeldLookup held = shadow_lookup(experiments.front(), light, false);
  const std::vector<PrefilteredLookup> lookups = mapped(experiments, [](const Experiment& each) {
    return lookup_of(each.shadow.bias, std::get<Prefiltered>(make_technique(each.shadow)));
  });
  return umbrameter::draw_lookups(context(), held.lookup, std::get<Prefiltered>(held.lookup.technique), lookups);
}

std::shared_ptr<const StoredSurfels> Stages::stored_surfels(const Experiment& experiment) {
  const auto exact = gpu_surfels(experiment);
  return get(stored_surfels_, Stage::stored_gbuffer, experiment, [&](const Experiment& read) {
    const auto seen = surfels(read);
    StoredGBuffer stored = store_gbuffer(context(), *exact, seen->view, read.shading);
    GpuGBuffer gpu = decode_surfels(context(), stored, *exact, seen->view);
    GBuffer gbuffer = read_back(context(), gpu);
    return StoredSurfels{std::move(stored), std::move(gpu), std::move(gbuffer)};
  });
}

ShadingSurfels Stages::shading_surfels(const Experiment& experiment) {
  if (experiment.shading.path == ShadingPath::forward) {
    const auto exact = surfels(experiment);
    return {gpu_surfels(experiment), {exact, &exact->gbuffer}, true};
  }
  const auto stored = stored_surfels(experiment);
  return {{stored, &stored->gpu}, {stored, &stored->gbuffer}, false};
}

Image<float> Stages::draw_visibility_of(const GpuGBuffer& surfels, const Experiment& experiment, std::uint32_t light) {
  const HeldLookup held = shadow_lookup(experiment, light, false);
  const ShadowLookup& exact = held.lookup;
  return draw_visibility(context(), {exact.scene, surfels, exact.map, exact.light, exact.bias, exact.technique, nullptr,
                                     exact.drawn, exact.view})
      .visibility;
}

ShadedImage Stages::shade(const Experiment& experiment, std::span<const LitLight> lights, const Image<float>& ao) {
  const auto seen = surfels(experiment);
  const auto exact = gpu_surfels(experiment);
  if (experiment.shading.path == ShadingPath::forward) {
    return draw_forward(context(), {uploaded(), *exact, seen->view, experiment.shading}, lights, ao);
  }
  const auto stored = stored_surfels(experiment);
  return draw_deferred(context(), {stored->stored, *exact, seen->view, experiment.shading}, lights, ao);
}

}  // namespace umbrameter
