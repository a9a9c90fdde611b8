// Turns measurements into sections of the page, figures and lines for the console.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/figures/figures.h"
#include "reports/page/page.h"
#include "results/layer_description.h"
#include "results/measurement.h"
#include "results/number_text.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// Statistics for people, in `first_column` and those after it: names in words, shares (unit 1) in per cent, and the
/// interval of a statistic in its own cell. `kind` as for statistic_words().
Table in_percent(const Table& table, std::size_t first_column = 0, std::string_view kind = {});

/// "mean absolute error", "light leak": a statistic's name in words, without what it is an error of.
std::string statistic_words(std::string_view name, std::string_view kind = {});

/// The same for the head of a column; the name where the words are long.
std::string head_words(std::string_view name, std::string_view kind = {});

/// Name and colour of each PixelClass, in its order; the same in all figures.
const std::vector<CategoryColor>& class_colors();

/// Name and colour of each cause of the error of the image, and of pixels without one.
std::vector<CategoryColor> image_cause_colors();

/// Those of a layer of categories.
std::vector<CategoryColor> categories_of(Layer layer);

/// Section, figures and text lines of one part of a run.
struct Presentation {
  ReportSection section;
  std::vector<Figure> figures{};
  std::vector<std::string> answers{};  ///< for the console, printed first: the main results
  std::vector<std::string> lines{};    ///< for the console: further results
  std::vector<std::string> details{};  ///< diagnostics: for the page's last section and --verbose
};

/// The parts of a measurement, with pictures of those of its layers that are theirs.
Presentation present_picture(const LayeredImage& layers);
Presentation present_shadow(const SceneFacts& scene, const LayeredImage& layers, const ShadowMeasurement& shadow);
Presentation present_ao(const LayeredImage& layers, const AoMeasurement& ao);
Presentation present_image(const SceneFacts& scene, const LayeredImage& layers, const ImageMeasurement& image);

/// How far the reference of ambient occlusion looks: "up to 58.6 cm" or "without distance limit".
std::string ao_limit_text(const TruthParams& params);
/// "58.6 cm", or "58.6 cm, reach 85.4 cm" where the technique looks farther than its radius.
std::string ao_radius_text(const AoParams& params);

/// Why an absolute error against a sampled reference may have a range.
inline constexpr const char* noise_note =
    " Noise in the reference can only raise a mean absolute error. Where it may have, the error is given as a range, "
    "whose lower end allows for the most that noise may have added.";

/// The limit of the mean absolute error against a hard shadow, for pages that compare filters.
inline constexpr const char* filter_caution =
    "The reference of a light without extent is a hard shadow. Against it every blurred pixel is wrong: with a bias "
    "that removes acne, the mean absolute error is usually least without a filter; with a smaller bias it may be less "
    "with a filter, which blurs the acne. Use it to choose a bias or a resolution, not a filter.";

/// The same, for the answers of a sweep or tuning over filters. `where` is put after "a hard shadow": ", here of
/// corner,".
std::string filter_warning(const std::string& remedy, const std::string& where = "");
/// `flag` measures the edges instead: "--run.metrics".
std::string filter_remedy(const std::string& flag);

/// "no AO at all would be closer to the reference: its error is 1.18 %"; empty where AO is better than none. Where the
/// intervals of both errors do not decide, "may be". `mean_raster` is the mean accessibility of the technique.
std::string no_ao_text(const Estimate& error, const Estimate& mean_truth, double mean_raster);

/// Whether these names of metrics or statistics have the one that shows which filter is best against a hard shadow.
bool measures_edges(const std::string& names);

/// Of a sweep or tuning over the reach of the filter, with one bias.
inline constexpr const char* one_bias_warning =
    "each filter needs its own bias, but all have the same constant bias: vary shadow.constant-bias, too";

/// Of a sweep that varies_reference().
inline constexpr const char* references_warning =
    "errors of different lights, cameras, scenes or references do not show which of them is better: compare cells "
    "with the same light, camera, scene and reference";

/// Why statistics count no pixel: "nothing to measure: all 230400 pixels are background". Empty if they count some.
std::string nothing_counted_text(const CountedPixels& counted);

/// Adds a figure to the presentation and to its section.
void add_figure(Presentation& presentation, Figure figure);

}  // namespace umbrameter
