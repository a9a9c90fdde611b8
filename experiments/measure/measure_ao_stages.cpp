#include "experiments/measure/measure_ao_stages.h"

#include "core/error.h"
#include "core/random.h"
#include "raytrace/visible_surface.h"

namespace umbrameter {
namespace {

constexpr int many_draws = 4;

// The mean of draws with many samples and different seeds.
Image<float> draw_many(Stages& stages, Experiment experiment) {
  const auto seed = static_cast<std::uint32_t>(experiment.run.seed);
  experiment.ao = with_many_samples(experiment.ao);
  Image<float> mean(experiment.view.size.width, experiment.view.size.height, 0.0f);
  for (int draw = 0; draw < many_draws; ++draw) {
    experiment.run.seed = static_cast<int>(hash(seed, static_cast<std::uint32_t>(draw)) >> 1u);
    const Image<float> drawn = stages.draw_ao(experiment);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += drawn[i] / static_cast<float>(many_draws);
  }
  return mean;
}

Image<float> sum(Image<float> a, const Image<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

}  // namespace

AoStageImages ao_stage_images(const TracedAo& truth, TracedIntegral traced, AoDraws drawn) {
  AoStageImages images;
  images.reference_variance = truth.variance;
  images.reference_samples = truth.samples;
  images.degrees_of_freedom = std::min(truth.degrees_of_freedom, traced.degrees_of_freedom);
  const auto at = [](AoStage stage) { return static_cast<std::size_t>(stage); };
  images.accessibility[0] = truth.ao;
  for (std::size_t k = 0; k < occluder_kinds; ++k) {
    images.accessibility[k + 1] = std::move(traced.accessibility[k]);
    images.variance[k] = std::move(traced.step_variance[k]);
    images.samples[k] = traced.samples;
  }
  images.variance[at(AoStage::model)] = sum(std::move(images.variance[at(AoStage::model)]), truth.variance);
  images.accessibility[at(AoStage::approximation) + 1] = std::move(drawn.with_many_samples);
  images.variance[at(AoStage::approximation)] = std::move(traced.variance[static_cast<std::size_t>(Occluders::solid)]);
  images.samples[at(AoStage::approximation)] = std::move(traced.samples);
  images.accessibility[at(AoStage::sampling) + 1] = std::move(drawn.without_blur);
  images.accessibility[at(AoStage::blur) + 1] = std::move(drawn.result);
  return images;
}

AoStages measure_ao_stages(Stages& stages, const Experiment& experiment, const TracedAo& truth,
                           const Image<float>& drawn, const Console& console) {
  require_metres(experiment.ao);
  require_metres(experiment.truth);
  std::optional<AoIntegral> integral = find_integral(make_technique(experiment.ao));
  if (!integral) {
    throw Error(ExitCode::usage, "run.ao-stages",
                "the stages need the integral that the technique approximates, which is not known for a bitmask with "
                "weights by angle",
                "use ao.bitmask-weight cosine, or leave out run.ao-stages");
  }
  const auto held = stages.surfels(experiment);
  const Surfels& surfels = *held;
  // Intensity and power are what the method shows, no approximation of it.
  integral->shown = [&, tone = experiment.ao.tone](double output, std::size_t pixel) {
    return static_cast<double>(with_tone(static_cast<float>(output), at_surface(tone, surfels.gbuffer, pixel)));
  };
  const Tracer& tracer = stages.tracer();
  TracedIntegral traced;
  {
    ProgressBar bar(console, "AO stages", [&] { return tracer.rays_traced(); });
    // Another seed than that of the reference, so that the two are independent.
    const AoIntegralParams params{experiment.truth.spp, hash(static_cast<std::uint32_t>(experiment.run.seed), 1u)};
    traced = trace_integral(tracer, surfels.gbuffer, surfels.view, *integral, params, bar.callback());
  }
  AoStages result;
  result.integral = integral->formula;
  result.many_draws = many_draws;
  result.integrals = traced.statistics;
  Experiment unblurred = experiment;
  unblurred.ao.blur.kind = AoBlur::none;
  result.images =
      ao_stage_images(truth, std::move(traced), {draw_many(stages, experiment), stages.draw_ao(unblurred), drawn});
  const AoStageImages& images = result.images;
  const GBuffer& gbuffer = surfels.gbuffer;
  result.statistics = analyze_ao_stages(images, [&](std::size_t i) { return gbuffer.is_surface(i); });
  const VisibleSurface surface(gbuffer, surfels.view);
  result.bins = split_ao_stages(images, gbuffer, surfels.view,
                                [&](std::size_t a, std::size_t b) { return surface.is_joined(a, b); });
  return result;
}

}  // namespace umbrameter
