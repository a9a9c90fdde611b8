// A sweep cut into shards: the folder that `umbrameter plan` writes, `run` reads and `merge` reads back. It holds
// plan.json, experiment.toml, scene/ with a copy of the scene's files, and shards/ with the results. It names no
// absolute path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "store/results_store.h"

namespace umbrameter {

struct PlannedShard {
  std::size_t first_group = 0;
  std::size_t groups = 0;
  double seconds = 0.0;  ///< estimated
};

struct ShardPlan {
  std::string id{};       ///< hash of all other members; read_plan() and write_plan() set it
  std::string program{};  ///< version that planned
  /// Of a file: its path relative to the plan's folder. Empty for a built-in scene.
  std::string scene_file{};
  std::vector<std::string> presets{};
  std::string experiment{};  ///< hash of experiment.toml
  /// Name and value of all that the rows depend on, the path of the scene left out.
  std::vector<std::pair<std::string, std::string>> identity{};
  std::size_t cells = 0;
  std::size_t parts = 1;           ///< of each group: cut_groups() of the sweep's plan gives the groups of the shards
  std::vector<ValueKind> kinds{};  ///< of the measured columns
  std::vector<PlannedShard> shards{};
};

/// The program's own version.
std::string program_version();

/// Writes experiment.toml and, last, plan.json.
void write_plan(const std::filesystem::path& folder, ShardPlan& plan, const std::string& experiment);

/// Throws Error: unreadable_input if the folder holds no plan or a damaged one, usage if another version wrote it.
ShardPlan read_plan(const std::filesystem::path& folder);

/// Throws Error (usage) with the first difference unless this identity is the plan's: another scene, device or build.
void require_planned(const std::filesystem::path& folder, const ShardPlan& plan,
                     const std::vector<std::pair<std::string, std::string>>& identity);

/// PLAN/shards/7.shard; other extensions are for the state of a shard.
std::filesystem::path shard_file(const std::filesystem::path& folder, std::size_t shard,
                                 const char* extension = "shard");

/// "3,7-9" as numbers, ascending, each once. Throws Error (usage) for anything else and for numbers from `count` on.
std::vector<std::size_t> parse_shards(const std::string& text, std::size_t count);

/// Ascending numbers as "3,7-9".
std::string shards_text(const std::vector<std::size_t>& shards);

/// The shard of this task of an array: the first variable that is set of SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX and
/// AWS_BATCH_JOB_ARRAY_INDEX; with UMBRAMETER_SHARDS="3,7-9" the shard at that place of the list. Throws Error (usage).
std::string shard_of_environment();

}  // namespace umbrameter
