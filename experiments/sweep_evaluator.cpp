#include "experiments/sweep_evaluator.h"

#include <algorithm>

#include "compare/bias_response.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "experiments/measure.h"

namespace umbrameter {
namespace {

std::vector<Value> measure_cell(Workbench& workbench, const Experiment& experiment, Measure measure) {
  if (measure == Measure::ao) return to_row(*measure_ao(workbench, experiment, {}).statistics);
  const std::uint32_t light = workbench.lights(experiment.view.light).front();
  const TracedVisibility& truth = workbench.truth(experiment, light);
  const RasterVisibility raster = workbench.draw(experiment, light, false);
  return to_row(analyze_soft_visibility(raster.visibility, sampled(truth), workbench.fit(experiment, light).counted));
}

void measure_cells(Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                   Measure measure, const CellGroup& group, const RowSink& keep) {
  // Extents are varied: not every combination of them need make sense.
  const Experiment of_group = at_cell(experiment, axes, group.values);
  if (measure != Measure::ao) workbench.require_sense_for(of_group, swept_lights(workbench, experiment, axes));
  for (std::size_t c = 0; c < group.constant_bias.values.size(); ++c) {
    for (std::size_t s = 0; s < group.slope_bias.values.size(); ++s) {
      throw_if_interrupted();
      keep(c, s, measure_cell(workbench, at_cell(experiment, axes, values_at(group, c, s)), measure));
    }
  }
}

std::vector<float> to_floats(const std::vector<double>& values) {
  std::vector<float> floats;
  for (const double value : values) floats.push_back(static_cast<float>(value));
  return floats;
}

// All of the group from one pass.
void measure_biases(Workbench& workbench, const Experiment& experiment, const CellGroup& group, const RowSink& keep) {
  const std::uint32_t light = workbench.lights(experiment.view.light).front();
  const std::vector<float> constant = to_floats(group.constant_bias.values);
  BiasAxes biases{constant, to_floats(group.slope_bias.values), experiment.shadow.constant_bias.unit};
  std::sort(biases.constant.begin(), biases.constant.end());
  biases.constant.erase(std::unique(biases.constant.begin(), biases.constant.end()), biases.constant.end());
  const BiasHistogram histogram = workbench.bias_response(experiment, light, biases);
  const TruthCounts truth =
      count_truth(workbench.truth(experiment, light).visibility, workbench.fit(experiment, light).counted);
  for (std::size_t s = 0; s < biases.slope.size(); ++s) {
    const std::vector<VisibilitySums> sums = sums_at_biases(histogram, s);
    for (std::size_t c = 0; c < constant.size(); ++c) {
      const auto found = std::lower_bound(biases.constant.begin(), biases.constant.end(), constant[c]);
      keep(c, s, to_row(to_statistics(sums[static_cast<std::size_t>(found - biases.constant.begin())], truth)));
    }
  }
}

}  // namespace

bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group) {
  return std::any_of(axes.begin(), axes.end(), [&](const SweepAxis& axis) { return axis.key.rfind(group, 0) == 0; });
}

Measure choose_measure(SweepMeasure given, const std::vector<SweepAxis>& axes) {
  if (given == SweepMeasure::visibility) return Measure::visibility;
  if (given == SweepMeasure::ao) return Measure::ao;
  const bool ao = varies_group(axes, "ao.") || varies_group(axes, "truth.");
  if (ao && (varies_group(axes, "shadow.") || varies_group(axes, "light."))) {
    throw Error(ExitCode::usage, "sweep", "the axes vary both shadows and ambient occlusion",
                "choose what to measure: --measure visibility or --measure ao");
  }
  return ao ? Measure::ao : Measure::visibility;
}

std::vector<std::uint32_t> swept_lights(const Workbench& workbench, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes) {
  std::vector<std::string> names = {experiment.view.light};
  for (const SweepAxis& axis : axes) {
    if (axis.key != "view.light") continue;
    names.clear();
    for (const Value& value : axis.values) names.push_back(to_string(value));
  }
  std::vector<std::uint32_t> lights;
  for (const std::string& name : names) lights.push_back(workbench.lights(name).front());
  return lights;
}

bool has_soft_cells(const Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes) {
  if (varies_group(axes, "light.")) return true;
  const std::vector<std::uint32_t> lights = swept_lights(workbench, experiment, axes);
  return std::any_of(lights.begin(), lights.end(),
                     [&](std::uint32_t light) { return is_area(workbench.light(experiment, light)); });
}

std::vector<Column> columns_of(Measure measure) {
  if (measure == Measure::ao) return ao_columns();
  return measure == Measure::soft_visibility ? soft_visibility_columns() : visibility_columns();
}

std::vector<Value> sample_row(Measure measure) {
  if (measure == Measure::ao) return to_row(AoStatistics{});
  return measure == Measure::soft_visibility ? to_row(SoftVisibilityStatistics{}) : to_row(VisibilityStatistics{});
}

Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values) {
  const Parameters parameters = describe(experiment);
  for (std::size_t a = 0; a < axes.size(); ++a) set_value(parameters, axes[a], values[a]);
  return experiment;
}

EvaluateGroup make_evaluator(Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             Measure measure) {
  return [&workbench, experiment, axes, measure](const CellGroup& group, const RowSink& keep) {
    if (measure == Measure::visibility) {
      measure_biases(workbench, at_cell(experiment, axes, group.values), group, keep);
    } else {
      measure_cells(workbench, experiment, axes, measure, group, keep);
    }
  };
}

}  // namespace umbrameter
