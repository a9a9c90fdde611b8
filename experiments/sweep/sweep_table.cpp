#include "experiments/sweep/sweep_table.h"

#include "experiments/sweep/sweep_evaluator.h"

namespace umbrameter {

Table sweep_table(Stages& stages, const Experiment& given, const std::vector<std::string>& assignments) {
  Experiment experiment = stages.in_metres(given);
  const Parameters parameters = describe(experiment);
  std::vector<SweepAxis> axes;
  experiment.axes.clear();
  for (const std::string& assignment : assignments) {
    axes.push_back(parse_axis(parameters, assignment));
    experiment.axes.push_back(split_assignment(assignment));
  }
  const SweptQuantity quantity = choose_quantity(experiment.run.measure, axes);
  const SweepPlan plan = plan_sweep(parameters, axes, cost_of_change, inner_keys(experiment, axes, quantity));
  const CellStatistics statistics = choose_statistics(stages, experiment, axes, quantity);
  const EvaluateGroup evaluate = make_evaluator(stages, experiment, axes, statistics);

  Table table;
  for (const SweepAxis& axis : axes) {
    table.columns.push_back({axis.key, axis.unit, require(parameters, axis.key).description.meaning});
  }
  const std::vector<Column> measured = measured_columns(experiment, statistics);
  table.columns.insert(table.columns.end(), measured.begin(), measured.end());
  table.rows.resize(plan.cells);
  for (std::size_t g = 0; g < count_groups(plan); ++g) {
    const CellGroup group = group_at(plan, g);
    evaluate(group, [&](std::size_t place, std::span<const Value> values) {
      std::vector<Value>& row = table.rows[group.cell(place)];
      row = values_at(group, place);
      row.insert(row.end(), values.begin(), values.end());
    });
  }
  return table;
}

}  // namespace umbrameter
