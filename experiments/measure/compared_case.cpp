#include "experiments/measure/compared_case.h"

#include <memory>
#include <utility>

#include "experiments/measure/measure.h"
#include "experiments/measure/measure_image.h"

namespace umbrameter {
namespace {

ShadowKind shadow_kind(const CellStatistics& kind) {
  if (std::holds_alternative<VisibilityStatistics>(kind)) return ShadowKind::by_cause;
  return std::holds_alternative<EdgeStatistics>(kind) ? ShadowKind::by_edges : ShadowKind::sampled;
}

ComparedCase compare_visibility(Stages& stages, const Experiment& experiment, ShadowKind kind,
                                const std::function<Image<float>()>& draw_visibility) {
  const std::uint32_t light = stages.lights(experiment.view.light).front();
  RasterVisibility drawn;
  if (kind == ShadowKind::by_cause) {
    if (stages.has_engine() && draw_visibility) draw_visibility();  // with others in one request; drawing finds it then
    std::optional<ClassAgreement> agreement;
    drawn = draw_causes(stages, experiment, light, agreement);
  } else {
    drawn.visibility = draw_visibility ? draw_visibility() : stages.draw(experiment, light, false).visibility;
  }
  const auto kept = std::make_shared<const RasterVisibility>(std::move(drawn));
  return {
      [&stages, experiment, light, kind, kept](const LeftOut& is_left_out) {
        const auto analyze = [&](const CountedPixels& counted) {
          return std::visit([](const auto& each) -> CellStatistics { return each; },
                            analyze_shadow(stages, experiment, light, kind, *kept, counted));
        };
        const auto all = stages.counted(experiment, light);
        if (!is_left_out) return analyze(*all);
        CountedPixels rest = *all;
        for (std::size_t i = 0; i < rest.exclusion.size(); ++i) {
          if (is_left_out(i)) rest.exclusion[i] = PixelExclusion::background;
        }
        return analyze(rest);
      },
      [&stages, experiment, light, kept] { return compared_visibility(stages, experiment, light, kept->visibility); }};
}

ComparedCase compare_ao(Stages& stages, const Experiment& experiment) {
  const auto drawn = std::make_shared<const Image<float>>(stages.draw_ao(experiment));
  return {[&stages, experiment, drawn](const LeftOut& is_left_out) -> CellStatistics {
            const auto truth = stages.ao_truth(experiment);
            const SampledImage reference{truth->ao, truth->variance, truth->samples, truth->degrees_of_freedom};
            const auto surfels = stages.surfels(experiment);
            return AoStatistics{analyze_sampled(*drawn, reference, [&](std::size_t i) {
              return surfels->gbuffer.is_surface(i) && !(is_left_out && is_left_out(i));
            })};
          },
          [&stages, experiment, drawn] { return compared_ao(stages, experiment, *drawn); }};
}

ComparedCase compare_image(Stages& stages, const Experiment& experiment) {
  const auto measured = std::make_shared<const ImageMeasurement>(
      measure_image(stages, experiment, stages.lights(experiment.view.light), {}));
  return {[measured](const LeftOut&) -> CellStatistics { return *measured->statistics; },
          [&stages, experiment, measured] {
            return compared_image(stages, experiment, {measured->raster->radiance, *measured->truth});
          }};
}

}  // namespace

ComparedCase compare_case(Stages& stages, const Experiment& experiment, const CellStatistics& kind,
                          const std::function<Image<float>()>& draw_visibility) {
  const SweptQuantity quantity = quantity_of(kind);
  if (quantity == SweptQuantity::ao) return compare_ao(stages, experiment);
  if (quantity == SweptQuantity::image) return compare_image(stages, experiment);
  return compare_visibility(stages, experiment, shadow_kind(kind), draw_visibility);
}

}  // namespace umbrameter
