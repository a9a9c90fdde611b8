#include "present/stored_sweep_figures.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "experiments/settings/stage_inputs.h"
#include "present/sweep_report.h"
#include "store/experiment_file.h"
#include "store/read_bias_curves.h"

namespace umbrameter {
namespace {

bool has_column(const StoreDescription& description, const std::string& name) {
  return std::any_of(description.columns.begin(), description.columns.end(),
                     [&](const StoredColumn& stored) { return stored.column.name == name; });
}

// The kind of statistics of this quantity whose columns the store has; nothing if it has those of none.
std::optional<CellStatistics> statistics_in(const StoreDescription& description, SweptQuantity quantity) {
  const CellStatistics kinds[] = {VisibilityStatistics{}, EdgeStatistics{}, SoftVisibilityStatistics{}, AoStatistics{},
                                  ImageStatistics{}};
  for (const CellStatistics& kind : kinds) {
    if (quantity_of(kind) != quantity) continue;
    const std::vector<Column> columns = columns_of(kind);
    if (std::all_of(columns.begin(), columns.end(),
                    [&](const Column& column) { return has_column(description, column.name); })) {
      return kind;
    }
  }
  return {};
}

}  // namespace

Figures stored_sweep_figures(const std::filesystem::path& folder) {
  const ResultsStore store = ResultsStore::load(folder);
  const StoreDescription& description = store.description();
  Experiment experiment = load_experiment(folder / "experiment.toml");
  const Parameters parameters = describe(experiment);
  const std::vector<SweepAxis> axes = parse_axes(parameters, description.axes);
  const SweptQuantity quantity = choose_quantity(experiment.run.measure, axes);
  const SweepPlan plan = plan_sweep(parameters, axes, cost_of_change, inner_keys(experiment, axes, quantity));
  const std::optional<CellStatistics> statistics = statistics_in(description, quantity);
  const auto refuse = [&](const std::filesystem::path& path, const char* why) {
    throw Error(ExitCode::unreadable_input, path.string(), why, "rerun the sweep with --force");
  };
  if (plan.cells != description.cells)
    refuse(folder / "experiment.toml", "it is not the experiment of the stored cells");
  if (!statistics) refuse(store.path(), "another version of umbrameter with other statistics wrote it");
  std::vector<MetricColumn> metrics = swept_metrics(experiment, *statistics);
  std::erase_if(metrics, [&](const MetricColumn& metric) { return !has_column(description, metric.name); });
  const SweepResults results{parameters, plan, store, *statistics, {}, metrics};
  Presentation presentation = present_sweep(results, best_rows(results), read_bias_curves(results), {});
  return {{}, std::move(presentation.plots), std::move(presentation.heat_maps), {}};
}

}  // namespace umbrameter
