// Puts the results of shards together. Memory is bounded by the largest shard: the rows wait in a scratch file, in the
// order of cells.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "experiments/settings/sweep_plan.h"
#include "store/results_store.h"
#include "store/shard_file.h"
#include "store/shard_plan.h"

namespace umbrameter {

/// The measured columns of a sweep's cells, in a file without a name: it is gone when the process ends.
class ScratchRows {
 public:
  /// Creates the file in this folder. `kinds` are those of the measured columns. Throws Error (partial).
  ScratchRows(const std::filesystem::path& folder, const SweepPlan& plan, std::vector<ValueKind> kinds);
  ~ScratchRows();
  ScratchRows(const ScratchRows&) = delete;
  ScratchRows& operator=(const ScratchRows&) = delete;

  /// Adds the rows of a shard. False if their number is not that of its cells; nothing is added then.
  bool add(const PlannedShard& shard, std::string_view rows);
  /// Number of cells that were added.
  std::size_t count() const { return count_; }
  /// Passes the values of all columns of the cells that were added, in the order of cells. With `missing` also those of
  /// the other cells, whose measured values are NaN and 0.
  void read(const CellSink& sink, bool missing = false) const;

 private:
  const SweepPlan* plan_;
  std::filesystem::path path_;
  std::vector<ValueKind> kinds_;  // of the measured columns
  std::vector<bool> is_there_;
  std::size_t count_ = 0;
  int file_ = -1;
};

struct CollectedShards {
  std::vector<std::size_t> missing{};   ///< without a valid result, ascending
  std::vector<std::string> problems{};  ///< one line for each file that is not a valid result
  std::vector<std::string> makers{};    ///< everyone who measured, each once
  std::vector<std::string> notes{};     ///< of measuring, each once
  double seconds = 0.0;                 ///< of measuring, all shards together
};

/// Checks all results in the plan's folder and adds the valid ones to `rows`. Never throws for a result that is not
/// valid.
CollectedShards collect_shards(const std::filesystem::path& folder, const ShardPlan& plan, ScratchRows& rows,
                               const Progress& progress = {});

/// Why the manifest is not that of a result of this shard of the plan; empty if it is.
std::string objection_to(const ShardManifest& manifest, const ShardPlan& plan, std::size_t shard);

}  // namespace umbrameter
