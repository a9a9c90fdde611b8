#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "app/planned_folder.h"
#include "app/print_json.h"
#include "core/lists.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "store/merge_shards.h"
#include "store/shard_state.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

bool is_done(const fs::path& folder, const ShardPlan& plan, std::size_t shard) {
  if (!is_there(shard_file(folder, shard))) return false;
  try {
    return objection_to(read_shard(shard_file(folder, shard)).manifest, plan, shard).empty();
  } catch (const Error&) {
    return false;
  }
}

// A sweep or a tuning that is loaded for the first shard and serves the others.
struct ShardRunner {
  const PlannedFolder& planned;
  const Console& console;
  std::optional<ShardMeasurer> measurer{};

  void measure(std::size_t shard, RunningMark& mark) {
    const auto started = std::chrono::system_clock::now();
    const auto begin = std::chrono::steady_clock::now();
    if (!measurer) {
      measurer = planned.plan.tuning ? load_tune_measurer(planned, console) : load_sweep_measurer(planned, console);
    }
    ProgressBar bar(console, fmt::format("shard {}", shard));
    double share = 0.0;
    const auto show = [&] {
      bar.show(share);
      mark.show(std::max(share, 1e-6));
    };
    measurer->report_tracing([&](double) { show(); });
    std::string rows;
    std::size_t cells = 0;
    measurer->measure(planned.plan.shards[shard], rows, [&](std::size_t cells_so_far, double share_so_far) {
      cells = cells_so_far;
      share = share_so_far;
      show();
    });
    measurer->report_tracing({});
    ShardManifest manifest{
        id_of(planned.plan, shard),
        shard,
        program_version(),
        measurer->measured_by,
        measurer->maker,
        host_name(),
        fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(started))),
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
        cells,
        measurer->notes()};
    write_shard(shard_file(planned.folder, shard), manifest, rows);
    print_line(console, fmt::format("shard {}: {} in {}", shard, count_text(cells, "cell"),
                                    time_text(std::ceil(manifest.seconds))));
  }
};

}  // namespace

ExitCode run_shards(const CommandLine& line, const Console& console) {
  const PlannedFolder planned = open_plan(line);
  const std::string text = line.plan.shard == "env" ? shard_of_environment() : line.plan.shard;
  remove_abandoned(planned.folder / "shards");
  ShardRunner runner{planned, console};
  std::vector<std::size_t> measured;
  for (const std::size_t shard : parse_shards(text, planned.plan.shards.size())) {
    if (!line.force && is_done(planned.folder, planned.plan, shard)) {
      print_line(console, fmt::format("shard {}: done already; --force measures it again", shard));
      continue;
    }
    RunningMark mark(planned.folder, shard);
    try {
      runner.measure(shard, mark);
      measured.push_back(shard);
    } catch (const Error& error) {
      if (error.code() != ExitCode::interrupted && error.code() != ExitCode::terminated) mark.fail(error.what());
      throw;
    }
  }
  print_json(console, {{"measured", measured}});
  return ExitCode::ok;
}

}  // namespace umbrameter
