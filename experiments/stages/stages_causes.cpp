// The stages that assign a cause to each wrong tap, at one bias or at every bias of an axis.
#include "experiments/stages/stages.h"
#include "raster/rasterizer.h"
#include "raytrace/surface_judge.h"

namespace umbrameter {
namespace {

std::uint64_t sum_of(const uvec4& v) { return std::uint64_t{v.x} + v.y + v.z + v.w; }

}  // namespace

BiasHistogram Stages::bias_response(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes) {
  BiasHistogram histogram = draw_bias_response(context(), shadow_lookup(experiment, light, true).lookup, axes);
  if (experiment.run.classes == ClassRule::fast) return histogram;
  test_unresolved_taps(experiment, light, axes, true, [&](auto taps, auto is_same_surface) {
    umbrameter::reclassify(histogram, taps, is_same_surface);
  });
  return histogram;
}

TapFlips Stages::tap_flips(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes) {
  TapFlips flips = draw_tap_flips(context(), shadow_lookup(experiment, light, true).lookup, axes);
  if (experiment.run.classes == ClassRule::fast) return flips;
  const auto seen = surfels(experiment);
  test_unresolved_taps(experiment, light, axes, true, [&](auto taps, auto is_same_surface) {
    for (std::size_t i = 0; i < taps.size(); ++i) {
      if (is_same_surface[i] != 0) flips.cause[pixel_of(taps[i], seen->gbuffer)] = Cause::acne;
    }
  });
  return flips;
}

void Stages::test_unresolved_taps(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes, bool of_lit,
                                  const TestedTaps& take) {
  const HeldLookup held = shadow_lookup(experiment, light, true);
  // Its time follows the unresolved taps, that of the look-up all taps.
  const StageClock::Running running(*clock_, Stage::visibility);
  const MapLayout& layout = held.lookup.map.layout;
  const auto seen = surfels(experiment);
  const Tracer& rays = tracer();
  const Continuity continuity = of_lit ? Continuity::seen : Continuity::own_layer;
  ProgressBar progress = bar("classes");
  list_unresolved_taps(context(), held.lookup, axes, of_lit, [&](std::span<const UnresolvedTap> taps) {
    const std::vector<TapSurfaces> surfaces = surfaces_of(scene_, layout, seen->gbuffer, taps);
    take(taps, test_same_surface(rays, layout, surfaces, continuity, progress.callback()));
  });
}

ClassAgreement Stages::reclassify(const Experiment& experiment, std::uint32_t light, WrongTaps& wrong) {
  ClassAgreement agreement;
  for (const uvec4& weights : wrong.weights.pixels) agreement.wrong += sum_of(weights);
  const auto seen = surfels(experiment);
  const Length& bias = experiment.shadow.bias.constant;
  const BiasAxes biases{
      {static_cast<float>(bias.number)}, {static_cast<float>(experiment.shadow.bias.slope)}, bias.unit};
  test_unresolved_taps(experiment, light, biases, true, [&](auto taps, auto is_same_surface) {
    umbrameter::reclassify(wrong, seen->gbuffer, taps, is_same_surface);
    add_reclassified(agreement, taps, is_same_surface);
  });
  test_unresolved_taps(experiment, light, biases, false,
                       [&](auto taps, auto is_own_layer) { add_blocked(agreement, taps, is_own_layer); });
  return agreement;
}

}  // namespace umbrameter
