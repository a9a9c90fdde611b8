// Finished runs side by side: what each measured, and how it differs from the first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "core/table.h"
#include "experiments/stored_run.h"

namespace umbrameter {

enum class Verdict : int { base, equal, significant, not_significant, no_interval };

/// What one run measured of a statistic.
struct ComparedValue {
  std::size_t run = 0;  ///< index
  MeasuredStatistic measured;
  Estimate difference{};   ///< to the first run, with its 95 % interval where there is one
  std::size_t blocks = 0;  ///< of pixels over which the difference is paired; 0: its interval is that of both values
  Verdict verdict = Verdict::base;
};

/// A statistic that the first run and others report.
struct ComparedStatistic {
  std::string kind;   ///< "shadow", "ao" or "image"
  std::string light;  ///< empty unless of a shadow
  std::string name;
  std::string unit;
  bool is_error = false;  ///< an error or an image metric, no description of the scene
  std::vector<ComparedValue> values;
};

/// Differences are paired over blocks of pixels where both runs store the images and see the same surfels: each block
/// is left out in turn (jackknife), so that what both runs have in common cancels. Otherwise the intervals of both
/// values are combined as if they were independent, which can only hide a difference that the runs share their noise
/// of.
std::vector<ComparedStatistic> compare_runs(const std::vector<StoredRun>& runs);

/// What is not comparable, one line each. Throws Error (usage) if the runs show different scenes.
std::vector<std::string> limits_of_comparison(const std::vector<StoredRun>& runs);

/// The parameters whose values differ, and these only: name, then a column for each run.
Table differing_parameters(const std::vector<StoredRun>& runs);

/// b − a of a statistic that is a mean over pixels; nothing if the images do not give both values.
struct PairedDifference {
  Estimate difference;
  std::size_t blocks = 0;
};
std::optional<PairedDifference> paired_difference(const StoredRun& a, const MeasuredStatistic& of_a, const StoredRun& b,
                                                  const MeasuredStatistic& of_b);

}  // namespace umbrameter
