// How far the shards of a plan are, from the files in its folder: K.shard is the result; K.running is renewed while a
// process measures, and K.failed says why one gave up. Only for people: merging reads results alone.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "store/shard_plan.h"

namespace umbrameter {

/// Marks a shard as running until this object ends.
class RunningMark {
 public:
  RunningMark(const std::filesystem::path& folder, std::size_t shard);
  ~RunningMark();
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;

  /// Notes the share that is done, at most every few seconds.
  void show(double share);
  /// Leaves K.failed with this text.
  void fail(const std::string& why);

 private:
  std::filesystem::path folder_;
  std::size_t shard_;
  std::chrono::steady_clock::time_point shown_{};
};

/// A running mark that is older is of a process that was killed, or of a host that is gone.
inline constexpr std::chrono::seconds lost_after{300};

struct ShardState {
  enum class Kind { waiting, running, done, failed, lost };
  Kind kind = Kind::waiting;
  double share = 0.0;     ///< that is measured, while running
  double seconds = 0.0;   ///< that measuring took, when done
  std::string host{};     ///< running or done
  std::string problem{};  ///< failed: why
};

/// The state of each shard. Results are not verified beyond their manifest.
std::vector<ShardState> shard_states(const std::filesystem::path& folder, const ShardPlan& plan);

/// Seconds until all shards are done at the present pace: with the shards that run now, and what those that are done
/// took relative to the plan. Negative if nothing runs.
double seconds_left(const ShardPlan& plan, const std::vector<ShardState>& states);

}  // namespace umbrameter
