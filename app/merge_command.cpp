#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/planned_sweep.h"
#include "core/standard_streams.h"
#include "present/run_output.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "store/merge_shards.h"

namespace umbrameter {
namespace {

constexpr const char* partial_file = "sweep.partial.csv";

// What to run again, in the forms that engines take.
void show_missing(const Console& console, const PlannedSweepFolder& planned, const CollectedShards& collected) {
  for (const std::string& problem : collected.problems) write_to(stderr, "umbrameter: " + problem + "\n");
  if (console.json) {
    const nlohmann::ordered_json json = {{"missing", collected.missing}, {"problems", collected.problems}};
    write_to(stdout, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return;
  }
  const std::string list = shards_text(collected.missing);
  std::string numbers;
  for (const std::size_t shard : collected.missing) numbers += " " + std::to_string(shard);
  print_line(console, "Slurm:    --array=" + list);
  print_line(console, "numbers: " + numbers);
  print_line(console, "command:  " + command_of(planned.folder, list));
  print_line(console, "commands: umbrameter status " + shell_word(planned.folder) + " --commands");
}

// With the experiment, the folder is an unfinished run, which the whole merge may repeat.
void write_partial(const ScratchRows& rows, const StoreDescription& description, RunFolder& folder,
                   const Console& console) {
  std::vector<Column> columns;
  for (const StoredColumn& stored : description.columns) columns.push_back(stored.column);
  folder.announce({partial_file});
  folder.begin();
  write_text(folder.path() / "experiment.toml", description.experiment);
  write_csv(folder.path() / partial_file, columns, [&](const StoredRowSink& sink) {
    rows.read([&](std::size_t, std::span<const Value> values) { sink(values); });
  });
  folder.finish(false);
  print_line(console, fmt::format("partial: {} of {} cells in {}", rows.count(), description.cells,
                                  (folder.path() / partial_file).string()));
}

}  // namespace

ExitCode run_merge(const CommandLine& line, const Console& console) {
  const PlannedSweepFolder planned = open_plan(line);
  SweepRun sweep(planned.line, planned.given);
  RunFolder folder(line.output, {"sweep", experiment_text(sweep.given), run_files(true)}, line.force);
  const StoreDescription description = load_planned(planned, sweep, console);
  CollectedShards collected;
  std::optional<ResultsStore> store;
  {
    ScratchRows rows(folder.path(), sweep.plan, description.columns);
    ProgressBar bar(console, "shards");
    collected = collect_shards(planned.folder, planned.plan, rows, bar.callback());
    if (!collected.missing.empty()) {
      show_missing(console, planned, collected);
      if (line.plan.partial) write_partial(rows, description, folder, console);
      throw Error(
          ExitCode::partial, planned.folder.string(),
          fmt::format("{} of {} shards are missing or broken", collected.missing.size(), planned.plan.shards.size()),
          line.plan.partial ? "run them again and merge" : "run them again, or add --partial");
    }
    for (const std::string& problem : collected.problems) note(console, problem);
    folder.announce(ResultsStore::file_names());
    store = ResultsStore::write(folder.path(), description, collected.makers,
                                [&](const CellSink& sink) { rows.read(sink); });
  }
  sweep.stages->add_notes(collected.notes);
  return write_sweep(sweep, *store, folder, console);
}

}  // namespace umbrameter
