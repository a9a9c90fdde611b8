// The stages of the technique's ambient occlusion.
#include "experiments/stages/stages.h"

namespace umbrameter {

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
