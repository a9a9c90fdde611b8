// The parts of which present/ composes pages, figures and summary.json. Programs use run_page.h and run_output.h.
#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "present/bias_report.h"
#include "present/presentation.h"
#include "present/tune_report.h"
#include "reports/figures/error_image.h"
#include "reports/files/exr.h"
#include "reports/page/viewer_data.h"
#include "results/engine_advice.h"
#include "results/layer_description.h"
#include "results/run_results.h"
#include "results/shadow_shape.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// The value of the parameter with this full name.
std::string value_text(Experiment experiment, std::string_view key);

/// Whether the result is that of a shadow map, and so depends on its bias; screen-space shadows alone need none.
bool reads_map(Experiment experiment);

/// Whether it is read without a filter.
bool reads_one_texel(const Experiment& experiment);

/// The usual reasons of an error that is split by sign and by distance from the edges.
struct EdgeReasons {
  const char* too_dark_away;
  const char* too_dark_at_edge;
  const char* too_bright_at_edge;
  const char* too_bright_away;
};
EdgeReasons edge_reasons(const Experiment& experiment);

/// How far the band about a shadow edge reaches: "at most 2 texels", "at most 2 texels of a 1024² map" where the
/// technique reads none.
std::string edge_band_text(const Experiment& experiment);

/// The shadow technique: "vsm", "pcf with contact shadows".
std::string technique_name(const Experiment& experiment);

/// Adds a layer's picture, drawn as its description says: numbers, categories, or colours times `exposure`. Nothing if
/// there is no such layer.
void add_layer_figure(Presentation& presentation, const LayeredImage& layers, Layer layer, std::string_view light,
                      std::string title, std::string caption, double exposure = 1.0);

inline constexpr const char* error_caption = "Technique − reference: blue is too dark, red is too bright.";
inline constexpr const char* classes_caption = "Main cause of the wrong taps of each pixel.";
inline constexpr const char* image_error_caption = "Luminance, technique − reference.";
inline constexpr const char* image_cause_caption =
    "The input that matters most: replacing it by the reference's changes the pixel most. Only where the error is "
    "at least 1/255 of white.";

/// Columns whose names say it all.
std::vector<Column> plain_columns(std::initializer_list<const char*> names);

/// One row per statistic: name, value, unit, meaning.
ReportTable statistics_table(std::string title, const Statistics& statistics);
template <class Struct>
ReportTable statistics_table(std::string title, Struct statistics) {
  return statistics_table(std::move(title), describe(statistics));
}

void add_metrics_table(ReportSection& section, const std::vector<MetricScore>& scores);

std::string offset_text(const TraceStatistics& statistics);

/// The precision of a sampled reference; precision_text() is empty if nothing was sampled. `is_over_pixel`: it is the
/// mean over the part of each pixel that shows the surface of its centre.
std::string precision_text(const SamplingPrecision& precision, const TruthParams& truth, bool is_over_pixel = false);
std::string precision_line(const SamplingPrecision& precision, bool is_over_pixel = false);

/// The measurement must have stages.
Presentation present_ao_stages(const LayeredImage& layers, const AoMeasurement& ao);

/// What each stage changes in each pixel.
void add_ao_stage_figures(Presentation& presentation, const LayeredImage& layers);

/// The stages' signed means as a sum.
WaterfallFigure ao_stages_waterfall(const AoStageStatistics& statistics);

/// The value of "shape".
nlohmann::ordered_json to_json(const SceneFacts& scene, const ShadowShape& shape);

/// Adds the tables and the figure to a light's section.
void present_shape(Presentation& presentation, const SceneFacts& scene, const ShadowMeasurement& shadow);

/// Adds lines for the console and a table, both with notes. `what` is that of which the bias is: "sun".
/// `bias` is named beside an engine that draws as the run does: for others it was searched again.
void add_engines(Presentation& presentation, const std::vector<EngineAdvice>& engines, const std::string& what,
                 const std::string& bias = {});

/// Leaves out the notes about engines that an earlier part or engine has, in the console's lines and below tables.
void say_engine_notes_once(std::vector<Presentation>& parts);

/// "engines" of summary.json.
nlohmann::ordered_json to_json(const std::vector<EngineAdvice>& engines);

/// The parts of a measurement, in the order of the page: the picture, lights, ambient occlusion, the image, debug
/// views.
std::vector<Presentation> measured_parts(const SceneFacts& scene, const Measurement& measurement);

/// The image with overlays, and a figure for each of the measurement's debug views.
Presentation present_debug_views(const Measurement& measurement);

/// Images are recognised by their stems, which are names of layers after the prefix. The backdrop is the shaded picture
/// of the layers (R, G, B and A); without them, or where the sizes differ, there is none.
ErrorImages error_images_of(const std::vector<Figure>& figures, const LayeredImage& layers,
                            const std::string& prefix = "");

/// The same for the images of a run: of its measurement, or of the points of a tuning.
ErrorImages error_images_of(const std::vector<Figure>& figures, const RunResults& results);

/// What add_tune_images() puts in front of the stems of a point's figures: "best_".
std::string stem_prefix(const TunePointImages& point);

/// Sets the values of `layer` to 0 where they enter no statistic, if it is the error of a light's shadow
/// ("error_visibility_LIGHT"): outside the map, the cone and the range of a light its shadow has no error.
void hide_uncounted(Image<float>& values, std::string_view layer, const LayeredImage& layers);

/// Every layer of the measurement but those for programs; the bias curves of its lights; the objects and materials in
/// view. `is_full`: see ViewerData::full.
ViewerData viewer_data(const SceneFacts& scene, const Measurement& measurement, bool is_full);

/// Adds a cell of a sweep to the pack. All but the first have rounded numbers and no picture.
void add_cell_images(ViewerPack& pack, const SceneFacts& scene, const Measurement& measurement, const ViewerCell& cell,
                     bool is_full);

/// Adds at most `most` figures, those of the first combinations of the axes that no figure shows.
void add_bias_figures(Presentation& presentation, const SweepResults& sweep, const BiasCurves& curves,
                      std::size_t most);

/// The cost along an axis of numbers, the other parameters at their best values.
PlotFigure scan_figure(const TuneSummary& summary, const AxisScan& scan);

/// The least cost so far after each evaluation; with an axis of words, one line for each value of the first.
PlotFigure search_figure(const TuneSummary& summary);

/// About thirty points of the front, among them the best one if it lies on it.
ReportTable front_table(const TuneSummary& summary, const std::vector<TunePoint>& front);
/// The second objective of the points of a Pareto front against the first.
PlotFigure front_figure(const TuneSummary& summary, const std::vector<TunePoint>& front);

/// Adds the figures of the points' images to `part` and returns the images for the page's viewer, those of the first
/// point first.
ViewerPack add_tune_images(Presentation& part, const SceneFacts& scene, const TuneFindings& tune);

/// The mean absolute error of an image without occlusion, from the reference's mean; a warning where it is no larger.
void add_without_ao(Presentation& presentation, const Estimate& error, const Estimate& mean_truth, double mean_raster,
                    const std::string& where = "");

}  // namespace umbrameter
