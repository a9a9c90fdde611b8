// What the sections of shadows, ambient occlusion and the shaded image share. Internal to presentation/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "present/presentation.h"
#include "results/layer_description.h"

namespace umbrameter {

/// The value of the parameter with this full name.
std::string value_text(Experiment experiment, std::string_view key);

/// Adds a layer's picture, drawn as its description says: numbers, categories, or colours times `exposure`. Nothing if
/// there is no such layer.
void add_layer_figure(Presentation& presentation, const LayeredImage& layers, Layer layer, std::string_view light,
                      std::string title, std::string caption, double exposure = 1.0);

inline constexpr const char* error_caption = "Technique − reference: blue is too dark, red is too bright.";
inline constexpr const char* classes_caption = "Main cause of the wrong taps of each pixel.";
inline constexpr const char* image_error_caption = "Luminance, technique − reference.";
inline constexpr const char* image_cause_caption =
    "The input that matters most: replacing it by the reference's changes the pixel most. Only where the error is "
    "visible.";

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
