#include "experiments/settings/shard_cuts.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace umbrameter {
namespace {

constexpr std::size_t most_blocks = std::size_t{1} << 23;
constexpr std::size_t pieces_per_shard = 16;
constexpr double worth_cutting = 0.95;  // of the longest shard

ShardCuts cuts_with(const SweepCosts& costs, SweepPlan plan, std::size_t parts, std::size_t shards) {
  cut_groups(plan, parts);
  const GroupCosts groups(costs, plan);
  ShardCuts cuts{parts, groups.cut(shards), {}, groups.seconds(0, groups.groups())};
  for (std::size_t i = 0; i < cuts.first.size(); ++i) {
    const std::size_t end = i + 1 < cuts.first.size() ? cuts.first[i + 1] : groups.groups();
    cuts.seconds.push_back(groups.seconds(cuts.first[i], end));
  }
  return cuts;
}

}  // namespace

GroupCosts::GroupCosts(SweepCosts costs, const SweepPlan& plan)
    : costs_(std::move(costs)), groups_(count_groups(plan)), parts_(parts_of_group(plan)) {
  steps_.resize(plan.outer.size());
  std::size_t step = parts_;
  for (std::size_t a = plan.outer.size(); a-- > 0;) {
    steps_[a] = step;
    step *= plan.axes[plan.outer[a]].values.size();
  }
  for (const SweepCosts::Part& part : costs_.parts) {
    std::size_t innermost = part.is_within ? 1 : 0;
    for (std::size_t a = 0; a < part.factors.size() && !part.is_within; ++a) {
      if (!part.factors[a].empty()) innermost = steps_[a];
    }
    innermost_.push_back(innermost);
  }
  if (parts_ > 1) {
    // A line through the whole group and the piece that was measured.
    const double share = 1.0 / static_cast<double>(parts_);
    const double slope = costs_.piece < 1.0 ? (1.0 - costs_.share_of_piece) / (1.0 - costs_.piece) : 0.0;
    of_first_piece_ = std::clamp(1.0 - slope * (1.0 - share), share, 1.0);
    of_next_piece_ = (1.0 - of_first_piece_) / static_cast<double>(parts_ - 1);
  }
  block_ = groups_ / most_blocks + 1;
  double sum = 0.0;
  for (std::size_t group = 0; group < groups_; ++group) {
    if (group % block_ == 0) until_.push_back(sum);
    sum += seconds_of(group, group == 0);
  }
}

// The first group of a process runs all stages, each later one those whose parameters change.
double GroupCosts::seconds_of(std::size_t group, bool is_first) const {
  double seconds = is_first ? costs_.start_seconds : 0.0;
  for (std::size_t p = 0; p < costs_.parts.size(); ++p) {
    const SweepCosts::Part& part = costs_.parts[p];
    if (!is_first && (innermost_[p] == 0 || group % innermost_[p] != 0)) continue;
    double of_part = part.seconds;
    for (std::size_t a = 0; a < part.factors.size(); ++a) {
      if (!part.factors[a].empty()) of_part *= part.factors[a][group / steps_[a] % part.factors[a].size()];
    }
    if (part.is_within) of_part *= is_first || group % parts_ == 0 ? of_first_piece_ : of_next_piece_;
    seconds += of_part;
  }
  return seconds;
}

double GroupCosts::seconds_before(std::size_t group) const {
  std::size_t from = group / block_;
  if (from == until_.size()) --from;
  double seconds = until_[from];
  for (std::size_t g = from * block_; g < group; ++g) seconds += seconds_of(g, g == 0);
  return seconds;
}

double GroupCosts::seconds(std::size_t begin, std::size_t end) const {
  return seconds_of(begin, true) + seconds_before(end) - seconds_before(begin + 1);
}

// The end of the longest run from `begin` within this time; at least one group.
std::size_t GroupCosts::farthest(std::size_t begin, double seconds) const {
  const double limit = seconds - seconds_of(begin, true) + seconds_before(begin + 1);
  std::size_t low = begin + 1;
  std::size_t high = groups_;
  while (low < high) {
    const std::size_t middle = low + (high - low + 1) / 2;
    if (seconds_before(middle) <= limit) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

std::vector<std::size_t> GroupCosts::pack(double seconds) const {
  std::vector<std::size_t> first;
  for (std::size_t begin = 0; begin < groups_; begin = farthest(begin, seconds)) first.push_back(begin);
  return first;
}

std::vector<std::size_t> GroupCosts::cut(std::size_t shards) const {
  shards = std::min(shards, groups_);
  double low = 0.0;
  double high = 1.001 * seconds(0, groups_);  // rounded sums of all groups are not above it
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (count_within(middle) <= shards ? high : low) = middle;
  }
  std::vector<std::size_t> first = pack(high);
  // Fewer fit where single groups are long: the longest runs that can be halved are.
  std::multimap<double, std::pair<std::size_t, std::size_t>, std::greater<>> runs;
  const auto add = [&](std::size_t begin, std::size_t end) {
    runs.emplace(end - begin > 1 ? seconds(begin, end) : -1.0, std::pair(begin, end));
  };
  for (std::size_t i = 0; i < first.size(); ++i) add(first[i], i + 1 < first.size() ? first[i + 1] : groups_);
  while (runs.size() < shards) {
    const auto [begin, end] = runs.begin()->second;
    runs.erase(runs.begin());
    const std::size_t middle = begin + (end - begin) / 2;
    add(begin, middle);
    add(middle, end);
  }
  first.clear();
  for (const auto& [time, run] : runs) first.push_back(run.first);
  std::ranges::sort(first);
  return first;
}

ShardCuts cut_into_shards(const SweepCosts& costs, const SweepPlan& plan, std::size_t shards) {
  const std::size_t groups = count_groups(plan);
  ShardCuts best =
      cuts_with(costs, plan, parts_of_group(plan) * divide_up(std::min(shards, plan.cells), groups), shards);
  const std::size_t fine = parts_of_group(plan) * divide_up(pieces_per_shard * shards, groups);
  if (fine > best.parts) {
    ShardCuts finer = cuts_with(costs, plan, fine, shards);
    if (std::ranges::max(finer.seconds) < worth_cutting * std::ranges::max(best.seconds)) best = std::move(finer);
  }
  return best;
}

std::size_t count_shards_within(const SweepCosts& costs, const SweepPlan& plan, double seconds) {
  const std::size_t groups = count_groups(plan);
  const GroupCosts whole(costs, plan);
  const double all = whole.seconds(0, groups);
  const auto wanted = static_cast<std::size_t>(std::min(static_cast<double>(plan.cells), 1.0 + all / seconds));
  SweepPlan cut = plan;
  cut_groups(cut, parts_of_group(plan) * divide_up(pieces_per_shard * wanted, groups));
  const GroupCosts pieces(costs, cut);
  // More parts do not help where each takes as long as the whole.
  return pieces.seconds(0, 1) <= seconds ? pieces.count_within(seconds) : whole.count_within(seconds);
}

}  // namespace umbrameter
