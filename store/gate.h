// A gate for continuous integration: holds the statistics of finished runs against budgets and conditions. It reads
// summary.json, so that it needs neither OpenGL nor Embree.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/condition.h"
#include "reports/files/budget_file.h"

namespace umbrameter {

/// A statistic that a run reports.
struct MeasuredStatistic {
  std::string run;  ///< name of its folder; empty if it is not from one
  std::string scene;
  std::string kind;   ///< "shadow", "ao" or "image"
  std::string light;  ///< name; empty unless of a shadow
  int light_index = -1;
  std::string view;  ///< of a sweep over views the one of least error, the only one in its summary; else empty
  std::string name;
  std::string unit;            ///< empty if it is not a known statistic
  double value = 0.0;          ///< NaN if nothing was measured
  double lower = 0.0;          ///< end of its interval over rays, which holds the value without noise; else the value
  double half_width = 0.0;     ///< how far other rays may move the value up, 95 % of them; 0 where nothing was sampled
  int degrees_of_freedom = 0;  ///< of the reference's variance of each pixel; 0 if not known
  double pixel_share = 0.0;    ///< what a whole pixel adds to a share whose reference is exact; else 0
  bool is_sampled() const { return half_width > 0.0 || lower < value; }
  /// What a bound allows beyond a value: the noise of other rays, else 1 % and at least a pixel. Without rays a value
  /// repeats to the bit, so that head room is a choice and no interval.
  double head_room() const { return half_width > 0.0 ? half_width : std::max(0.01 * std::abs(value), pixel_share); }
};

/// The statistics in a summary. `file` is for messages. Throws Error (unreadable_input) if it is no summary of a run.
std::vector<MeasuredStatistic> read_statistics(const std::string& summary, const std::string& file);
/// The name of a run's folder.
std::string run_name(const std::filesystem::path& folder);
/// Reads DIR/summary.json.
std::vector<MeasuredStatistic> read_run(const std::filesystem::path& folder);

/// One statistic held against one bound.
struct GateCheck {
  BudgetEntry budget;
  std::optional<MeasuredStatistic> measured;  ///< nothing: no run measured it
  double bound = 0.0;                         ///< in the statistic's unit
  bool is_kept = false;
  double excess = 0.0;     ///< how far the value is beyond the bound, in its unit; negative if it keeps the bound
  double intervals = 0.0;  ///< the excess over the interval's half towards the bound; NaN without an interval
};

/// Holds each budget against every statistic that it names; a budget that names none fails. Throws Error (usage) for an
/// unknown statistic or a unit that does not fit.
std::vector<GateCheck> check_budget(const std::vector<BudgetEntry>& budget,
                                    const std::vector<MeasuredStatistic>& measured);

/// The conditions under which a run fails, as budgets: acne>0.1% becomes acne <= 0.1%.
std::vector<BudgetEntry> budgets_of(const std::vector<std::string>& fail_if);

/// The statistics of runs of which the budget bounds none.
std::vector<MeasuredStatistic> unbounded(const std::vector<BudgetEntry>& budget,
                                         const std::vector<MeasuredStatistic>& measured);

/// Bounds that name a part of a run, such as a light, which does not have their statistic, while another run has it:
/// they are checked in the other run alone.
struct UncheckedBounds {
  std::string run;
  std::string where;  ///< "courtyard, sun"
  std::vector<std::string> statistics{};
};
std::vector<UncheckedBounds> unchecked_bounds(const std::vector<BudgetEntry>& budget,
                                              const std::vector<MeasuredStatistic>& measured);

/// Sets the bounds to the measured values with their head room, rounded away from it. A budget over several statistics
/// takes the worst. A run of which it bounds nothing gets a bound for each of its errors.
std::vector<BudgetEntry> update_budget(std::vector<BudgetEntry> budget, const std::vector<MeasuredStatistic>& measured);

}  // namespace umbrameter
