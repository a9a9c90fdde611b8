// The stages of ambient occlusion: the reference and the technique's.
#include <chrono>

#include "experiments/stages/stages.h"

namespace umbrameter {

AoInBackground::~AoInBackground() {
  is_cancelled = true;
  if (traced.valid()) traced.wait();
}

void Stages::begin_ao_truth(const Experiment& experiment) {
  struct Cancelled {};
  require_metres(experiment.truth);
  const Experiment read = declared(Stage::ao_reference, experiment);
  ao_in_background_ = std::make_unique<AoInBackground>();
  AoInBackground& work = *ao_in_background_;
  // All that the thread reads is computed here, because it must not run stages.
  work.traced = std::async(
      std::launch::async,
      [&work, &rays = tracer(), surfels = surfels(read), params = read.truth,
       seed = static_cast<std::uint32_t>(read.run.seed), key = reference_key(read, Stage::ao_reference, "ao"),
       title = CacheTitle{scene_title(read), "ambient occlusion" + of_camera(surfels(read)->view)},
       folder = options_.cache, console = console_] {
        ReferenceCache cache(folder, console);
        const std::function<TracedAo()> trace = [&] {
          return trace_ao(rays, surfels->gbuffer, params, seed, [&work](double share) {
            if (work.is_cancelled) throw Cancelled{};
            work.share = share;
          });
        };
        return cache.get(key, title, trace);
      });
  work.key = key_of(Stage::ao_reference, experiment);
}

std::shared_ptr<const TracedAo> Stages::ao_truth(const Experiment& experiment) {
  require_metres(experiment.truth);
  const std::string key = key_of(Stage::ao_reference, experiment);
  const auto counted = [&](TracedAo traced) {
    add(costs_.hemisphere, traced.statistics);
    costs_.largest_offset = std::max(costs_.largest_offset, traced.statistics.largest_offset);
    return traced;
  };
  return ao_truth_.get(key, [&] {
    const Experiment read = declared(Stage::ao_reference, experiment);
    if (ao_in_background_ && ao_in_background_->key == key) {
      const std::unique_ptr<AoInBackground> work = std::move(ao_in_background_);
      const Tracer& rays = tracer();
      ProgressBar progress = tracing_bar("hemisphere rays", [&] { return rays.rays_traced(); });
      while (work->traced.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
        progress.show(work->share);
      }
      return counted(work->traced.get());
    }
    const std::function<TracedAo()> trace = [&] {
      const Tracer& rays = tracer();
      ProgressBar progress = tracing_bar("hemisphere rays", [&] { return rays.rays_traced(); });
      return trace_ao(rays, surfels(read)->gbuffer, read.truth, static_cast<std::uint32_t>(read.run.seed),
                      progress.callback());
    };
    return counted(cache_.get(reference_key(read, Stage::ao_reference, "ao"),
                              {scene_title(read), "ambient occlusion" + of_camera(surfels(read)->view)}, trace));
  });
}

Image<float> Stages::draw_ao(const Experiment& experiment) {
  if (has_engine()) return engine_frames({&experiment, 1}, lights(experiment.view.light).front(), true).front().image;
  Image<float> ao =
      *get(ao_, Stage::ao, experiment, [&](const Experiment& read) { return draw_ao_of(*gpu_surfels(read), read); });
  const auto seen = surfels(experiment);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    ao[i] = with_tone(ao[i], at_surface(experiment.ao.tone, seen->gbuffer, i));
  }
  return ao;
}

void Stages::draw_ao_response(const Experiment& experiment, const AoAxes& axes, const AoResponseSink& sink) {
  require_metres(experiment.ao);
  const auto seen = surfels(experiment);
  const auto gpu = gpu_surfels(experiment);
  umbrameter::draw_ao_response(context(), *gpu, seen->view, experiment.ao,
                               static_cast<std::uint32_t>(experiment.run.seed), axes, sink);
}

AoSurfelImages Stages::read_ao_surfels(const Experiment& experiment) {
  const auto seen = surfels(experiment);
  return umbrameter::read_ao_surfels(context(), *gpu_surfels(experiment), seen->view, experiment.ao);
}

Image<float> Stages::draw_ao_of(const GpuGBuffer& surfels, const Experiment& experiment) {
  require_metres(experiment.ao);
  const auto seen = this->surfels(experiment);
  return umbrameter::draw_ao(context(), surfels, seen->view, experiment.ao,
                             static_cast<std::uint32_t>(experiment.run.seed));
}

}  // namespace umbrameter
