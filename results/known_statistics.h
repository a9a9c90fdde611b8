// Every statistic that a run can report, by name: for conditions, budgets and costs that users write.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/swept.h"

namespace umbrameter {

struct KnownStatistic {
  std::string kind;  ///< "shadow", "ao" or "image"
  std::string name;  ///< "acne"; of an image metric "psnr"
  std::string unit;
  std::string meaning;
  bool is_error = false;          ///< has a curve or is an image metric: smaller is better unless is_higher_better
  bool is_higher_better = false;  ///< an image metric such as PSNR
  bool is_share = false;          ///< Statistic::is_share
  std::string metric{};           ///< the image metric, measured only if run.metrics names it; empty if described
  std::string title{};            ///< in words: "Mean absolute error of visibility", "share lit in the reference"
};

/// "shadow" for visibility, "ao", "image".
std::string_view kind_of(SweptQuantity quantity);

/// All described statistics, then the image metrics. A name occurs once for each kind that has it.
const std::vector<KnownStatistic>& known_statistics();

/// The one of this kind and name; null if there is none.
const KnownStatistic* find_known(std::string_view kind, std::string_view name);

/// Whether it is a score such as PSNR.
bool is_higher_better(std::string_view statistic);

/// Whether values below 0 are possible: means of signed errors, what replacing an input changes, scores such as PSNR.
/// Absolute errors, RMS errors and shares are never below 0, so neither are their intervals.
bool can_be_negative(std::string_view statistic);

/// Whether 0 is the best value and others lie on both sides of it.
bool is_signed_error(std::string_view statistic);

/// "ao.mae" is the statistic mae of kind ao; "mae" is of any kind.
struct StatisticName {
  std::string kind;  ///< empty: any
  std::string name;
};
StatisticName parse_statistic_name(std::string_view text);

/// The known statistics of that name and kind. Throws Error (usage) that names `option` and the nearest names if there
/// is none. `more` are names that are also allowed and are suggested, such as parameters.
std::vector<KnownStatistic> require_statistic(const StatisticName& name, const std::string& option,
                                              const std::vector<std::string>& more = {});

/// The image metric that run.metrics must name for this statistic; empty for a described one and an unknown name.
std::string metric_to_measure(std::string_view statistic);

}  // namespace umbrameter
