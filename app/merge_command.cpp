#include <fmt/format.h>

#include <optional>

#include "app/planned_sweep.h"
#include "present/partial_sweep.h"
#include "present/run_output.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "results/number_text.h"
#include "store/merge_shards.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* partial_file = "sweep.partial.csv";

// "shard 3, 8 cells: from shadow.resolution 256, shadow.filter box to …", by the order of evaluation.
std::vector<std::string> missing_cells(const ShardPlan& plan, const SweepPlan& cut,
                                       const std::vector<std::size_t>& missing) {
  const auto text_of = [&](const std::vector<Value>& values) {
    std::string text;
    for (std::size_t a = 0; a < values.size(); ++a) {
      text += (text.empty() ? "" : ", ") + cut.axes[a].key + " " + short_text(values[a]);
    }
    return text;
  };
  std::vector<std::string> lines;
  for (const std::size_t shard : missing) {
    const PlannedShard& part = plan.shards[shard];
    std::size_t cells = 0;
    for_each_joined_group(cut, part.first_group, part.groups, [&](const CellGroup& group) { cells += group.size(); });
    const CellGroup first = group_at(cut, part.first_group);
    const CellGroup last = group_at(cut, part.first_group + part.groups - 1);
    lines.push_back(fmt::format("shard {}, {} cell{}: from {} to {}", shard, grouped(cells), cells == 1 ? "" : "s",
                                text_of(first.values), text_of(values_at(last, last.size() - 1))));
  }
  return lines;
}

// The rows with those that are missing, in a store that the page reads and that is removed after it.
struct StoreOfPage {
  StoreOfPage(const fs::path& in, const ScratchRows& rows, const StoreDescription& description)
      : folder(in / ".umbrameter-partial") {
    fs::create_directories(folder);
    store = ResultsStore::write(folder, description, {description.maker},
                                [&](const CellSink& sink) { rows.read(sink, true); });
  }
  ~StoreOfPage() {
    store.reset();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  StoreOfPage(const StoreOfPage&) = delete;
  StoreOfPage& operator=(const StoreOfPage&) = delete;

  fs::path folder;
  std::optional<ResultsStore> store{};
};

// With the experiment, the folder is an unfinished run, which the whole merge may repeat.
void write_partial(const PlannedFolder& planned, SweepRun& sweep, const SweepPlan& cut, const ScratchRows& rows,
                   const std::vector<std::size_t>& missing, RunFolder& folder, const Console& console) {
  const StoreDescription description = load_planned(planned, sweep, console);
  std::vector<Column> columns;
  for (const StoredColumn& stored : description.columns) columns.push_back(stored.column);
  folder.announce({partial_file});
  folder.begin();
  write_text(folder.path() / "experiment.toml", description.experiment);
  write_csv(folder.path() / partial_file, columns, [&](const StoredRowSink& sink) {
    rows.read([&](std::size_t, std::span<const Value> values) { sink(values); });
  });
  const StoreOfPage whole(folder.path(), rows, description);
  const SweepResults results{sweep.parameters, sweep.plan, *whole.store, sweep.statistics, "", sweep.metrics};
  const RunResults run{"sweep", sweep.given, sweep.stages->facts(), ""};
  write_partial_page(folder, console,
                     {results, run, rows.count(), missing_cells(planned.plan, cut, missing),
                      command_of(planned.folder, shards_text(missing))},
                     {make_figure_style(sweep.line.figures), !planned.line.no_figures});
  folder.finish(false);
  print_line(console, fmt::format("partial: {} of {} cells in {}; report: {}", rows.count(), description.cells,
                                  (folder.path() / partial_file).string(), (folder.path() / "index.html").string()));
}

}  // namespace

// What is missing shows before a scene is loaded or a device opened.
ExitCode run_merge(const CommandLine& line, const Console& console) {
  const PlannedFolder planned = open_plan(line);
  if (planned.plan.tuning) return merge_tune(planned, line, console);
  SweepRun sweep(planned.line, planned.given);
  SweepPlan cut = sweep.plan;
  cut_groups(cut, planned.plan.parts);
  RunFolder folder(line.output, {"sweep", experiment_text(sweep.given), run_files(true)}, line.force);
  CollectedShards collected;
  std::optional<ResultsStore> store;
  {
    ScratchRows rows(folder.path(), cut, planned.plan.kinds);
    {
      ProgressBar bar(console, "shards");
      collected = collect_shards(planned.folder, planned.plan, rows, bar.callback());
    }
    if (!collected.missing.empty()) {
      show_shards(console, planned, collected.missing, collected.problems);
      if (line.plan.partial) write_partial(planned, sweep, cut, rows, collected.missing, folder, console);
      throw missing_shards(planned, collected, line.plan.partial ? "run them and merge" : "run them, or add --partial");
    }
    for (const std::string& problem : collected.problems) note(console, problem);
    const StoreDescription description = load_planned(planned, sweep, console);
    folder.announce(ResultsStore::file_names());
    store = ResultsStore::write(folder.path(), description, collected.makers,
                                [&](const CellSink& sink) { rows.read(sink); });
  }
  sweep.stages->add_notes(collected.notes);
  return write_sweep(sweep, *store, folder, console);
}

}  // namespace umbrameter
