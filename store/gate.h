// A gate for continuous integration: holds the statistics of finished runs against budgets and conditions. It reads
// summary.json, so that it needs neither OpenGL nor Embree.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/condition.h"
#include "reports/files/budget_file.h"

namespace umbrameter {

/// A statistic that a run reports.
struct MeasuredStatistic {
  std::string scene;
  std::string kind;   ///< "shadow", "ao" or "image"
  std::string light;  ///< name; empty unless of a shadow
  int light_index = -1;
  std::string name;
  std::string unit;         ///< empty if it is not a known statistic
  double value = 0.0;       ///< NaN if nothing was measured
  double half_width = 0.0;  ///< of the 95 % interval of the reference's sampling; 0 where nothing was sampled
  /// Of a share without that: of the choice of N pixels as if they were independent (Wilson 1927); else 0. Neighbouring
  /// pixels are alike, so it is a scale for head room and no test.
  double choice_half_width = 0.0;
  /// The half width that a bound allows: the one of these that is known; 0 if neither is.
  double head_room() const { return half_width > 0.0 ? half_width : choice_half_width; }
};

/// The statistics in a summary. `file` is for messages. Throws Error (unreadable_input) if it is no summary of a run.
std::vector<MeasuredStatistic> read_statistics(const std::string& summary, const std::string& file);
/// Reads DIR/summary.json.
std::vector<MeasuredStatistic> read_run(const std::filesystem::path& folder);

/// One statistic held against one bound.
struct GateCheck {
  BudgetEntry budget;
  std::optional<MeasuredStatistic> measured;  ///< nothing: no run measured it
  double bound = 0.0;                         ///< in the statistic's unit
  bool is_kept = false;
  double excess = 0.0;     ///< how far the value is beyond the bound, in its unit; negative if it keeps the bound
  double intervals = 0.0;  ///< the excess in half widths; NaN without an interval
};

/// Holds each budget against every statistic that it names; a budget that names none fails. Throws Error (usage) for an
/// unknown statistic or a unit that does not fit.
std::vector<GateCheck> check_budget(const std::vector<BudgetEntry>& budget,
                                    const std::vector<MeasuredStatistic>& measured);

/// The conditions under which a run fails, as budgets: acne>0.1% becomes acne <= 0.1%.
std::vector<BudgetEntry> budgets_of(const std::vector<std::string>& fail_if);

/// Sets the bounds to the measured values with head room of one half width (1 % of the value without an interval),
/// rounded away from it. A budget over several statistics takes the worst. Without any budget, makes one for each error
/// of the runs.
std::vector<BudgetEntry> update_budget(std::vector<BudgetEntry> budget, const std::vector<MeasuredStatistic>& measured);

}  // namespace umbrameter
