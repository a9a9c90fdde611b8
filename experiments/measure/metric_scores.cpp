#include "experiments/measure/metric_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/edge_scale.h"

namespace umbrameter {
namespace {

MetricResult measure(const Metric& metric, const ComparedImages& compared, const LeftOut& is_left_out) {
  const auto is_counted = [&](std::size_t i) { return compared.is_counted(i) && !(is_left_out && is_left_out(i)); };
  if (const auto* scalar = std::get_if<ScalarImages>(&compared.images)) {
    return measure_scalar(metric, {scalar->test, scalar->reference, is_counted, compared.edge_scale});
  }
  const auto& color = std::get<ColorImages>(compared.images);
  ColorMetricParams params;
  params.exposure = std::log2(color.exposure);
  return measure_color(metric, {color.test, color.reference, is_counted, ImageContent::scene, params});
}

}  // namespace

ComparedImages compared_visibility(Stages& stages, const Experiment& experiment, std::uint32_t light,
                                   Image<float> drawn) {
  const auto surfels = stages.surfels(experiment);
  const auto counted = stages.counted(experiment, light);
  const auto layout = stages.layout(experiment, light);
  return {ScalarImages{std::move(drawn), stages.truth(experiment, light)->visibility},
          [counted](std::size_t i) { return counted->exclusion[i] == PixelExclusion::none; },
          edge_scale(surfels->gbuffer, surfels->view, stages.light(experiment, light), *layout)};
}

ComparedImages compared_ao(Stages& stages, const Experiment& experiment, Image<float> drawn) {
  return {ScalarImages{std::move(drawn), stages.ao_truth(experiment)->ao},
          [surfels = stages.surfels(experiment)](std::size_t i) { return surfels->gbuffer.is_surface(i); }};
}

ComparedImages compared_image(Stages& stages, const Experiment& experiment, ColorImages images) {
  images.exposure = experiment.shading.exposure;
  return {std::move(images),
          [surfels = stages.surfels(experiment)](std::size_t i) { return surfels->gbuffer.is_surface(i); }};
}

std::vector<MetricScore> score(std::span<const MetricColumn> columns, const ComparedImages& images,
                               const LeftOut& is_left_out) {
  std::vector<MetricScore> scores;
  const Metric* measured = nullptr;
  MetricResult result;
  for (const MetricColumn& column : columns) {
    if (column.metric != measured) result = measure(*(measured = column.metric), images, is_left_out);
    const std::size_t unit = column.other_unit;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double in_unit = unit <= result.in_other_units.size() && unit > 0 ? result.in_other_units[unit - 1] : nan;
    scores.push_back({column, unit == 0 ? result.score : in_unit});
  }
  return scores;
}

}  // namespace umbrameter
