// What the sections of shadows, ambient occlusion and the shaded image share. Internal to presentation/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/figures/figures.h"
#include "reports/page/page.h"
#include "results/measurement.h"

namespace umbrameter {

/// The value of the parameter with this full name.
std::string value_text(Experiment experiment, std::string_view key);

ImageFigure scalar_figure(std::string stem, std::string title, std::string caption, const Image<float>& values,
                          const ColorScale& scale);

/// One row per statistic: name, value, unit, meaning.
ReportTable statistics_table(std::string title, const Statistics& statistics);
template <class Struct>
ReportTable statistics_table(std::string title, Struct statistics) {
  return statistics_table(std::move(title), describe(statistics));
}

void add_metrics_table(ReportSection& section, const std::vector<MetricScore>& scores);

std::string offset_text(const TraceStatistics& statistics);

/// The precision of a sampled reference; precision_text() is empty if nothing was sampled.
std::string precision_text(const SamplingPrecision& precision, const TruthParams& truth);
std::string precision_line(const SamplingPrecision& precision);

}  // namespace umbrameter
