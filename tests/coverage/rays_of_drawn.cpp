// What the GPU draws stays as it is; the reference is traced with many seeds.
#include "compare/ao_stages.h"
#include "coverage.h"
#include "experiments/measure/measure_ao_stages.h"
#include "experiments/measure/measure_image.h"
#include "scenes/builtin.h"

namespace umbrameter::coverage {
namespace {

constexpr int seed_of_truth = 1000003;

Experiment small(int rays) {
  Experiment experiment;
  experiment.view.size = {96, 54};
  experiment.truth.spp = rays;
  return experiment;
}

void measure_image(const Options& options) {
  for (const double angle : {0.0, 8.0}) {
    const std::string name = fmt::format("contact-box, sun of {:g}°, shaded image, 64 rays", angle);
    if (!options.selects(name)) continue;
    Stages stages(load_scene("contact-box"), {}, {.quiet = true});
    const std::uint32_t light = 0;
    const auto statistics = [&](int rays, int seed) {
      Experiment experiment = stages.in_metres(small(rays));
      experiment.light.angle = angle;
      experiment.ao.tone.intensity = 0.0;  // the technique's AO has random rotations, of the same seed
      experiment.run.seed = seed;
      return *umbrameter::measure_image(stages, experiment, {&light, 1}, {}).statistics;
    };
    ImageStatistics right = statistics(options.rays, seed_of_truth);
    print_seeds(name, options.seeds, describe(right),
                [&](std::uint32_t seed) { return statistics(64, static_cast<int>(seed)); });
  }
}

void measure_stages(const Options& options) {
  const std::string name = "courtyard, AO by stage, 64 rays";
  if (!options.selects(name)) return;
  Stages stages(load_scene("courtyard"), {}, {.quiet = true});
  const Experiment experiment = stages.in_metres(small(64));
  const auto held = stages.surfels(experiment);
  const Surfels& surfels = *held;
  const AoIntegral integral = *find_integral(make_technique(experiment.ao));
  Experiment unblurred = experiment;
  unblurred.ao.blur.kind = AoBlur::none;
  Experiment many = experiment;
  many.ao = with_many_samples(many.ao);
  const AoDraws drawn{stages.draw_ao(many), stages.draw_ao(unblurred), stages.draw_ao(experiment)};
  const auto statistics = [&](int rays, std::uint32_t seed) {
    TruthParams params = experiment.truth;
    params.spp = rays;
    const TracedAo truth = trace_ao(stages.tracer(), surfels.gbuffer, params, 2 * seed);
    TracedIntegral traced =
        trace_integral(stages.tracer(), surfels.gbuffer, surfels.view, integral, {rays, 2 * seed + 1});
    return analyze_ao_stages(ao_stage_images(truth, std::move(traced), drawn),
                             [&](std::size_t i) { return surfels.gbuffer.is_surface(i); });
  };
  AoStageStatistics right = statistics(options.rays, seed_of_truth);
  print_seeds(name, options.seeds, describe(right), [&](std::uint32_t seed) { return statistics(64, seed); });
}

}  // namespace

void measure_rays_of_drawn(const Options& options) {
  measure_image(options);
  measure_stages(options);
}

}  // namespace umbrameter::coverage
