// How far the shards of a plan are, as a page.
#pragma once

#include <string>
#include <vector>

#include "reports/page/page.h"
#include "store/shard_state.h"

namespace umbrameter {

/// "done", "running", "waiting", "failed", "lost".
const char* name_of(ShardState::Kind kind);

/// Why a shard has to run again: the first line of its error, or that its process gave no sign; empty for the others.
std::string problem_of(const ShardState& state);

struct ShardProgress {
  std::string name;            ///< of the plan's folder
  std::string time;            ///< of looking, "2026-01-31 12:00"
  std::string end;             ///< estimated, the same; empty if nothing runs
  double seconds_left = -1.0;  ///< seconds_left()
  std::string retry;           ///< the command that runs failed and lost shards again; empty if there are none
};

Report shard_report(const ShardPlan& plan, const std::vector<ShardState>& states, const ShardProgress& progress);

}  // namespace umbrameter
