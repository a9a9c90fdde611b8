// Why the best point of a tuning has the words that it has: the best point with each other word, side by side.
#pragma once

#include <string>
#include <vector>

#include "present/tune_report.h"

namespace umbrameter {

/// The name of a compared point: "default", "best", "filter gaussian".
std::string title_of(const TuneSummary& summary, const ComparedPoint& compared);

/// Each statistic of a compared point over the cases; of one whose magnitude is bounded or minimised, the magnitude.
std::vector<double> shown_values(const TuneSummary& summary, const ComparedPoint& compared);

/// A row for the default and for the best point with each word: cost, difference from the best point, constraints,
/// other parameters, statistics. No rows where there is no axis of words and nothing more to show.
Table comparison_table(const TuneSummary& summary);

/// For each axis of words its values from the best to the worst: "filter: gaussian 0.24 px, box 0.31 px, nearest 0.86
/// px (breaks the constraint)".
std::vector<std::string> ranking_lines(const TuneSummary& summary);

}  // namespace umbrameter
