// A sweep or a tuning cut into shards: the folder that `umbrameter plan` writes, `run` reads and `merge` reads back. It
// holds plan.json, experiment.toml, scene/ with copies of the scenes' files, and shards/ with the results. It names no
// absolute path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
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

/// A point of a tuning that is to be measured.
struct PlannedPoint {
  std::string kind{};           ///< "before", "point" or "scan": TuneQuery::Kind
  std::vector<Value> values{};  ///< of each axis
};

/// Points of a tuning that can be measured at the same time. Their cells are the parts of the points, part by part.
struct PlannedRound {
  std::string id{};  ///< hash of all that is planned up to here; write_plan() sets it
  std::vector<PlannedPoint> points{};
  std::size_t first_shard = 0;
};

/// What the plan of a tuning has besides that of a sweep. A group is one cell.
struct PlannedTuning {
  /// What measuring one part of a point takes.
  struct Cost {
    double reference = 0.0;   ///< of its cases, seconds
    double evaluation = 0.0;  ///< seconds
  };
  std::vector<std::pair<std::string, std::string>> options{};  ///< of `tune`, by name
  std::size_t cases = 0;
  bool is_exact = false;         ///< one pass measures every constant bias
  std::size_t shards = 1;        ///< of a round, at most
  std::size_t points = 1;        ///< of a round, unless more are needed in any case
  double start_seconds = 0.0;    ///< of a process
  std::vector<Cost> costs{};     ///< of each part of a point
  std::vector<double> before{};  ///< costs of the default in each case, for a relative cost; empty until measured
  std::vector<PlannedRound> rounds{};
};

struct ShardPlan {
  std::string id{};       ///< hash of all other members; read_plan() and write_plan() set it
  std::string program{};  ///< version that planned
  /// Paths of scenes relative to the plan's folder, as the experiment and the options name them. A scene that is not
  /// listed is a built-in one.
  std::vector<std::string> scene_files{};
  std::vector<std::string> presets{};
  std::string experiment{};  ///< hash of experiment.toml
  /// Name and value of all that the rows depend on, the path of the scene left out.
  std::vector<std::pair<std::string, std::string>> identity{};
  std::size_t cells = 0;
  std::size_t parts = 1;           ///< of each group: cut_groups() of the sweep's plan gives the groups of the shards
  std::vector<ValueKind> kinds{};  ///< of the measured columns
  std::vector<PlannedShard> shards{};
  std::optional<PlannedTuning> tuning{};  ///< nothing: a sweep
};

/// The program's own version.
std::string program_version();

/// Writes experiment.toml and, last, plan.json.
void write_plan(const std::filesystem::path& folder, ShardPlan& plan, const std::string& experiment);

/// Throws Error: unreadable_input if the folder holds no plan or a damaged one, usage if another version wrote it.
ShardPlan read_plan(const std::filesystem::path& folder);

/// What the result of a shard must name: the plan, or in a tuning the shard's round.
const std::string& id_of(const ShardPlan& plan, std::size_t shard);

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
