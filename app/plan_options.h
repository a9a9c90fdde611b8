// Options of the commands that divide a sweep: plan, run, merge and status.
#pragma once

#include "app/command_line.h"

namespace CLI {
class App;
}

namespace umbrameter {

/// The command that `plan` cuts, its first word.
void add_planned_command(CLI::App& command, PlanOptions& plan);
/// What `plan` has besides the options of that command.
void add_plan_options(CLI::App& command, PlanOptions& plan);
/// run, merge and status.
void add_shard_commands(CLI::App& app, CommandLine& line);

}  // namespace umbrameter
