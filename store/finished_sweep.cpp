#include "store/finished_sweep.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "experiments/settings/stage_inputs.h"
#include "store/experiment_file.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

bool has_column(const StoreDescription& description, const std::string& name) {
  return std::ranges::any_of(description.columns,
                             [&](const StoredColumn& stored) { return stored.column.name == name; });
}

// The kind of statistics of this quantity whose columns the store has; nothing if it has those of none.
std::optional<CellStatistics> statistics_in(const StoreDescription& description, SweptQuantity quantity) {
  const CellStatistics kinds[] = {VisibilityStatistics{}, EdgeStatistics{}, SoftVisibilityStatistics{}, AoStatistics{},
                                  ImageStatistics{}};
  for (const CellStatistics& kind : kinds) {
    if (quantity_of(kind) != quantity) continue;
    const std::vector<Column> columns = columns_of(kind);
    if (std::ranges::all_of(columns, [&](const Column& column) { return has_column(description, column.name); })) {
      return kind;
    }
  }
  return {};
}

// The parameters of an engine are those that the run itself stored.
Experiment load_stored_experiment(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "experiment.toml";
  if (!engine_in(path).empty()) {
    if (const std::optional<RunResults> run = read_run_value(folder, false)) use_engine(run->experiment.engine);
  }
  return load_experiment(path);
}

}  // namespace

FinishedSweep::FinishedSweep(const std::filesystem::path& folder)
    : store_(ResultsStore::load(folder)),
      experiment_(load_stored_experiment(folder)),
      parameters_(describe(experiment_)) {
  const StoreDescription& description = store_.description();
  const std::vector<SweepAxis> axes = parse_axes(parameters_, description.axes);
  const SweptQuantity quantity = choose_quantity(experiment_.run.measure, axes);
  plan_ = plan_sweep(parameters_, axes, cost_of_change, inner_keys(experiment_, axes, quantity));
  const std::optional<CellStatistics> statistics = statistics_in(description, quantity);
  const auto refuse = [&](const std::filesystem::path& path, const char* why) {
    throw Error(ExitCode::unreadable_input, path.string(), why, "rerun the sweep with --force");
  };
  if (plan_.cells != description.cells) {
    refuse(folder / "experiment.toml", "it is not the experiment of the stored cells");
  }
  if (!statistics) refuse(store_.path(), "another version of umbrameter with other statistics wrote it");
  statistics_ = *statistics;
  metrics_ = swept_metrics(experiment_, statistics_);
  std::erase_if(metrics_, [&](const MetricColumn& metric) { return !has_column(description, metric.name); });
}

}  // namespace umbrameter
