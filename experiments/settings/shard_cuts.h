// The estimated time of any run of a sweep's groups, and a cut of the sweep into runs of equal time.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/settings/sweep_costs.h"

namespace umbrameter {

/// Memory is bounded for any number of groups.
class GroupCosts {
 public:
  /// The plan may be cut further than the one that was measured.
  GroupCosts(SweepCosts costs, const SweepPlan& plan);

  std::size_t groups() const { return groups_; }
  /// Time of a process that measures the groups from `begin` up to `end`, seconds.
  double seconds(std::size_t begin, std::size_t end) const;
  /// Cuts the groups into `shards` runs whose longest takes as little as possible. Returns the first group of each;
  /// fewer if there are fewer groups.
  std::vector<std::size_t> cut(std::size_t shards) const;
  /// The least number of runs of at most this time, each of at least one group.
  std::size_t count_within(double seconds) const { return pack(seconds).size(); }

 private:
  double seconds_of(std::size_t group, bool is_first) const;
  double seconds_before(std::size_t group) const;
  std::size_t farthest(std::size_t begin, double seconds) const;
  std::vector<std::size_t> pack(double seconds) const;

  SweepCosts costs_;
  std::size_t groups_ = 0;
  std::size_t parts_ = 1;               // groups with the same outer values
  std::vector<std::size_t> steps_;      // for each outer axis: groups from one value to the next
  std::vector<std::size_t> innermost_;  // for each part: the steps of the innermost axis that it depends on; 0: none
  double of_first_piece_ = 1.0;         // share of a whole group's rest
  double of_next_piece_ = 0.0;
  std::size_t block_ = 1;      // groups between two of until_
  std::vector<double> until_;  // seconds of all groups before, each after the one before it
};

/// A sweep cut into shards.
struct ShardCuts {
  std::size_t parts = 1;             ///< of each group, for cut_groups()
  std::vector<std::size_t> first{};  ///< group of each shard
  std::vector<double> seconds{};     ///< of each shard
  double undivided = 0.0;            ///< seconds of one process that measures all
};

/// Cuts groups only where there are more shards than groups, or where this makes the longest shard shorter.
ShardCuts cut_into_shards(const SweepCosts& costs, const SweepPlan& plan, std::size_t shards);

/// The number of shards of at most this time.
std::size_t count_shards_within(const SweepCosts& costs, const SweepPlan& plan, double seconds);

}  // namespace umbrameter
