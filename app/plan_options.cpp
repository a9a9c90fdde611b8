#include "app/plan_options.h"

#include "app/command_descriptions.h"
#include "app/command_options.h"

namespace umbrameter {
namespace {

CLI::App& add_command_of_plan(CLI::App& app, CommandLine& line, const CommandDescription& description) {
  CLI::App& command = add_command(app, description);
  command.add_option("PLAN", line.plan.folder, "folder that 'umbrameter plan' wrote")->required();
  return command;
}

// Of what measures.
void add_measuring_options(CLI::App& command, CommandLine& line) {
  add_gl_device(command, line);
  add_no_cache(command, line);
  add_threads(command, line);
  add_memory(command, line);
  add_output_flags(command, line);
}

}  // namespace

void add_planned_command(CLI::App& command, PlanOptions& plan) {
  command.add_option("COMMAND", plan.planned, "command to divide: sweep or tune")
      ->required()
      ->check(CLI::IsMember({"sweep", "tune"}));
}

void add_plan_options(CLI::App& command, PlanOptions& plan) {
  CLI::Option* shards = add_value(command, "--shards", plan.shards, "N", "number of shards; of a tuning, of each round")
                            ->check(number_between(1, 1000000));
  CLI::Option* cells =
      add_value(command, "--cells-per-shard", plan.cells_per_shard, "N", "mean number of cells of a shard")
          ->check(number_between(1, 1000000000))
          ->excludes(shards);
  add_value(command, "--minutes-per-shard", plan.minutes_per_shard, "X", "estimated time of a shard on this machine")
      ->check(number_between(0.01, 1e5))
      ->excludes(shards)
      ->excludes(cells);
  add_value(command, "--points-per-round", plan.points_per_round, "N",
            "max points of a round that are only probable (shards / cases)")
      ->check(number_between(1, 100000))
      ->group(tuning_group);
  command.add_flag("--by-reference", plan.by_reference,
                   "leave the scene where it is, at its path relative to the plan");
  command.add_flag("--commands", plan.commands, "print the command of each shard, one a line, and nothing else");
}

void add_shard_commands(CLI::App& app, CommandLine& line) {
  CLI::App& run = add_command_of_plan(app, line, run_command);
  add_value(run, "--shard", line.plan.shard, "LIST",
            "shards to measure, counted from 0: 7 or 3,7-9; env for this task's")
      ->required();
  run.add_flag("--force", line.force, "measure again what is done");
  add_measuring_options(run, line);

  CLI::App& merge = add_command_of_plan(app, line, merge_command);
  add_value(merge, "-o,--output", line.output, "DIR", "folder for the results, created if missing")->required();
  merge.add_flag("--partial", line.plan.partial, "write the rows that are there to sweep.partial.csv");
  merge.add_flag("--force", line.force, "replace an earlier run's results in the folder");
  add_page_cells(merge, line);
  add_figure_options(merge, line.figures);
  add_page_options(merge, line);
  add_measuring_options(merge, line);

  CLI::App& status = add_command_of_plan(app, line, status_command);
  add_value(status, "-o,--output", line.output, "PAGE.html", "also write a page that shows the progress");
  status.add_flag("--commands", line.plan.commands, "print the commands of the shards that are not done, one a line");
  add_output_flags(status, line);
}

}  // namespace umbrameter
