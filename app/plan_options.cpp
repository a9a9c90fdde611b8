#include "app/plan_options.h"

#include <CLI/CLI.hpp>

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
  command.add_option("--gl-device", line.gl_device, "OpenGL device: index, part of its name, or 'software'")
      ->type_name("NAME");
  command.add_flag("--no-cache", line.no_cache, "trace the reference again and do not cache it");
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
  CLI::Option* shards = command.add_option("--shards", plan.shards, "number of shards; of a tuning, of each round")
                            ->check(number_between(1, 1000000))
                            ->type_name("N");
  CLI::Option* cells = command.add_option("--cells-per-shard", plan.cells_per_shard, "mean number of cells of a shard")
                           ->check(number_between(1, 1000000000))
                           ->type_name("N")
                           ->excludes(shards);
  command.add_option("--minutes-per-shard", plan.minutes_per_shard, "estimated time of a shard on this machine")
      ->check(number_between(0.01, 1e5))
      ->type_name("X")
      ->excludes(shards)
      ->excludes(cells);
  command
      .add_option("--points-per-round", plan.points_per_round,
                  "max points of a round that are only probable (shards / cases)")
      ->check(number_between(1, 100000))
      ->type_name("N")
      ->group(tuning_group);
  command.add_flag("--by-reference", plan.by_reference,
                   "leave the scene where it is, at its path relative to the plan");
  command.add_flag("--commands", plan.commands, "print the command of each shard, one a line, and nothing else");
}

void add_shard_commands(CLI::App& app, CommandLine& line) {
  CLI::App& run = add_command_of_plan(app, line, run_command);
  run.add_option("--shard", line.plan.shard, "shards to measure, counted from 0: 7 or 3,7-9; env for this task's")
      ->required()
      ->type_name("LIST");
  run.add_flag("--force", line.force, "measure again what is done");
  add_measuring_options(run, line);

  CLI::App& merge = add_command_of_plan(app, line, merge_command);
  merge.add_option("-o,--output", line.output, "folder for the results, created if missing")
      ->type_name("DIR")
      ->required();
  merge.add_flag("--partial", line.plan.partial, "write the rows that are there to sweep.partial.csv");
  merge.add_flag("--force", line.force, "replace an earlier run's results in the folder");
  merge.add_option("--page-cells", line.page_cells, "max number of cells whose images the page has (6)")
      ->type_name("N");
  add_figure_options(merge, line.figures);
  add_page_options(merge, line);
  add_measuring_options(merge, line);

  CLI::App& status = add_command_of_plan(app, line, status_command);
  status.add_option("-o,--output", line.output, "also write a page that shows the progress")->type_name("PAGE.html");
  status.add_flag("--commands", line.plan.commands, "print the commands of the shards that are not done, one a line");
  add_output_flags(status, line);
}

}  // namespace umbrameter
