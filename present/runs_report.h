// A comparison of finished runs as tables for the page, for LaTeX and for programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/page/page.h"
#include "store/run_comparison.h"

namespace umbrameter {

/// The errors of one light, of ambient occlusion or of the image: one row for each run.
struct PartTables {
  std::string stem;   ///< file name of its LaTeX tables: "shadow_sun", the light as in the names of figures
  std::string title;  ///< "Shadow of sun"
  // The page's tables name statistics in words.
  Table values;  ///< value ± half width of its 95 % interval, over pixels and, if sampled, rays; with a * over rays
  Table differences;  ///< to the first run; in parentheses where not shown to be significant; no rows for a single run
  Table all;          ///< every statistic of every run, errors or not, with the kind of the test
  /// For print, which has columns: one row for each error, named in words, one column for each run. Errors that no run
  /// has a value of are left out.
  Table printed_values;
  Table printed_differences;   ///< to the first run, those with an interval; an asterisk where significant
  bool is_sampled = false;     ///< the reference of a run
  bool has_noise = false;      ///< of the reference, which may have raised a value
  std::size_t few_blocks = 0;  ///< that hold counted pixels, where they are too few for an interval; else 0
};
std::vector<PartTables> part_tables(const std::vector<StoredRun>& runs, const std::vector<ComparedStatistic>& compared);

/// What the asterisk in a printed difference means.
inline constexpr const char* interval_note = "± 95 % interval";
inline constexpr const char* range_note = "± or a range: 95 % interval";
inline constexpr const char* rays_only_note = "* the interval covers the noise of the reference only";
inline constexpr const char* significance_note = "* significant: its 95 % interval excludes 0";

/// One row for each statistic and run, in SI units and shares.
Table comparison_rows(const std::vector<StoredRun>& runs, const std::vector<ComparedStatistic>& compared);

/// The answer: for each light, AO and image how the mean absolute error of each run differs from the first's.
std::vector<std::string> comparison_answers(const std::vector<StoredRun>& runs,
                                            const std::vector<ComparedStatistic>& compared);

/// "2.180 ± 0.037": two significant digits of the half width; four of the value if it has none.
std::string with_half_width(double value, double half_width);

}  // namespace umbrameter
