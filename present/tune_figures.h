// The figures of a tuning.
#pragma once

#include <vector>

#include "present/tune_report.h"

namespace umbrameter {

/// The cost along an axis of numbers, the other parameters at their best values.
PlotFigure scan_figure(const TuneSummary& summary, const AxisScan& scan);

/// The least cost so far after each evaluation; with an axis of words, one line for each value of the first.
PlotFigure search_figure(const TuneSummary& summary);

/// The second objective of the points of a Pareto front against the first.
PlotFigure front_figure(const TuneSummary& summary, const std::vector<TunePoint>& front);

}  // namespace umbrameter
