// Finished runs side by side: what each measured, and how it differs from the first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/jackknife.h"
#include "core/statistics.h"
#include "core/table.h"
#include "store/stored_run.h"

namespace umbrameter {

/// rays_only: the intervals cover the noise of the references' rays alone, so that other pixels could give another
/// order. no_base: the first run has no such statistic.
enum class Verdict : int { base, equal, significant, not_significant, rays_only, no_interval, no_base };

/// What a 95 % interval covers. pixels: the choice of pixels and the noise of the reference's rays, which differ from
/// pixel to pixel; rays: that noise alone, for these pixels.
enum class IntervalOf : int { nothing, rays, pixels };

/// What one run measured of a statistic.
struct ComparedValue {
  std::size_t run = 0;  ///< index
  MeasuredStatistic measured;
  double half_width = 0.0;  ///< of the value's 95 % interval; 0 if there is none
  double noise = 0.0;  ///< the most that the reference's noise may have added to it; the interval begins so much lower
  IntervalOf interval = IntervalOf::nothing;  ///< what that interval covers
  Estimate difference{};  ///< to the first run, with its 95 % interval where there is one, which allows for both noises
  std::size_t blocks =
      0;  ///< of pixels over which the difference is paired; 0: its interval is from those of both values
  std::size_t counted_blocks = 0;  ///< that hold counted pixels, where they are fewer than fewest_blocks; else 0
  Verdict verdict = Verdict::base;
};

/// The value with its 95 % interval, which ends at 0 where the statistic cannot be negative, and at 1 where it is a
/// mean or an error of visibility or accessibility.
Estimate estimate_of(const ComparedValue& value);

/// A statistic of at least one of the runs.
struct ComparedStatistic {
  std::string kind;   ///< "shadow", "ao" or "image"
  std::string light;  ///< empty unless of a shadow
  std::string name;
  std::string unit;
  bool is_error = false;  ///< an error or an image metric, no description of the scene
  std::vector<ComparedValue> values;
};

/// The interval of a value is over blocks of pixels where the run stores the images that give it: each block is left
/// out in turn (jackknife). That covers the choice of pixels and the noise of the reference. Otherwise it is that of
/// the reference's rays alone, with which no difference is significant. Noise can only raise an absolute error:
/// intervals of these also hold what they would be without (compare/sampled_error.h).
///
/// Differences are paired over blocks where both runs see the same surfels, so that what both have in common cancels.
/// Otherwise the intervals of both values are combined as if they were independent, which can only hide a difference
/// that the runs share their noise of. No interval treats neighbouring pixels as independent.
std::vector<ComparedStatistic> compare_runs(const std::vector<StoredRun>& runs);

/// What is not comparable, one line each. Throws Error (usage) if the runs show different scenes.
std::vector<std::string> limits_of_comparison(const std::vector<StoredRun>& runs);

/// The parameters whose values differ, and these only: name, then a column for each run.
Table differing_parameters(const std::vector<StoredRun>& runs);

/// A statistic, or the difference of two runs, with its 95 % interval over the choice of pixels and the noise of the
/// reference's rays: up to 8 × 8 blocks are left out in turn (jackknife_variance()).
struct BlockEstimate {
  double value = 0.0;
  double half_width = 0.0;
  /// The most that noise of the references may have added to the value, and taken from it; not in half_width.
  double added = 0.0;
  double taken = 0.0;
  std::size_t blocks = 0;

  Estimate interval() const { return {value, value - half_width - added, value + half_width + taken}; }
};
/// Nothing if the statistic is no ratio of sums over pixels, or the run's images do not give its value.
std::optional<BlockEstimate> estimate_over_blocks(const StoredRun& run, const MeasuredStatistic& statistic);
/// Blocks that hold counted pixels; 0 for a statistic that is no ratio of sums over pixels.
std::size_t count_counted_blocks(const StoredRun& run, const MeasuredStatistic& statistic);
/// b − a, paired: both lose the same block. Nothing also if the runs do not see the same surfels.
std::optional<BlockEstimate> paired_difference(const StoredRun& a, const MeasuredStatistic& of_a, const StoredRun& b,
                                               const MeasuredStatistic& of_b);

}  // namespace umbrameter
