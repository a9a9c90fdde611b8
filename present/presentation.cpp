#include "present/presentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "compare/metrics/metric.h"
#include "core/lists.h"
#include "present/presentation_parts.h"
#include "reports/files/text_layout.h"
#include "results/known_statistics.h"
#include "results/layers.h"
#include "techniques/shadow/read_parameters.h"

namespace umbrameter {
namespace {

std::string shown_unit(const Column& column) { return column.unit == "1" ? "%" : column.unit; }

// How many columns the statistic has that begins there: three if it has an interval.
std::size_t width_of(const std::vector<Column>& columns, std::size_t c) {
  return c + 1 < columns.size() && columns[c + 1].name == lower_name(columns[c].name) ? 3 : 1;
}

// Decimals of the technique's mean in per cent, which is exact: those of its difference to the reference's mean.
// Nothing for other columns and where that difference has no interval.
std::optional<int> decimals_of_mean(const std::vector<Column>& columns, const std::vector<Value>& row, std::size_t c) {
  if (columns[c].name != "mean_raster") return std::nullopt;
  const auto difference = std::ranges::find(columns, "mean_error", &Column::name);
  const auto at = static_cast<std::size_t>(difference - columns.begin());
  if (difference == columns.end() || width_of(columns, at) == 1) return std::nullopt;
  const double half_width = 50.0 * (to_number(row[at + 2]) - to_number(row[at + 1]));
  return half_width > 0.0 ? std::optional(decimals_of(half_width, 2)) : std::nullopt;
}

// A count, or a text with as many digits as mean something; with its interval if the statistic has one.
Value measured_value(const std::vector<Column>& columns, const std::vector<Value>& row, std::size_t c) {
  if (!std::holds_alternative<double>(row[c])) return row[c];
  const double factor = columns[c].unit == "1" ? 100.0 : 1.0;
  if (const std::optional<int> decimals = decimals_of_mean(columns, row, c)) {
    return fmt::format("{:.{}f}", factor * to_number(row[c]), *decimals);
  }
  if (width_of(columns, c) == 1) return digits_text(factor * to_number(row[c]));
  return estimate_text({factor * to_number(row[c]), factor * to_number(row[c + 1]), factor * to_number(row[c + 2])},
                       "");
}

constexpr const char* picture_stem = "picture";

}  // namespace

std::string technique_name(const Experiment& experiment) {
  const bool is_combined = std::holds_alternative<ContactShadows>(make_technique(experiment.shadow));
  return value_text(experiment, "shadow.technique") + (is_combined ? " with contact shadows" : "");
}

bool reads_map(Experiment experiment) { return find(read_parameters(experiment.shadow), constant_bias_key) != nullptr; }

bool reads_one_texel(const Experiment& experiment) {
  return experiment.shadow.technique == ShadowTechniques::choice<Pcf> &&
         experiment.shadow.pcf.filter == ShadowFilter::nearest;
}

EdgeReasons edge_reasons(const Experiment& experiment) {
  if (!reads_map(experiment)) {
    return {"surfaces that block themselves", "surfaces thinner than assumed",
            "surfaces thicker than assumed, or between two steps", "casters farther than the ray is long, or unseen"};
  }
  // With contact shadows, whose error has no causes.
  if (reads_one_texel(experiment)) {
    return {"like acne", "coarse texels, acne, and surfaces thinner than assumed", "coarse texels and lost contact",
            "a large bias"};
  }
  return {"like acne", "blur and occluders in the kernel", "blur and lost contact",
          "light bleeding, a large bias, or a wide blur"};
}

std::string edge_band_text(const Experiment& experiment) {
  std::string text = fmt::format("at most {:g} texels", edge_band_texels);
  if (!reads_map(experiment)) {
    text += fmt::format(" of a {}² map", experiment.shadow.map.resolution);
  }
  return text;
}

std::string value_text(Experiment experiment, std::string_view key) {
  return to_string(require(describe(experiment), key).value());
}

void add_layer_figure(Presentation& presentation, const LayeredImage& layers, Layer layer, std::string_view light,
                      std::string title, std::string caption, double exposure) {
  ImageFigure figure;
  figure.stem = layer == Layer::picture ? picture_stem : layer_name(layer, light);
  figure.title = std::move(title);
  figure.caption = std::move(caption);
  const ViewerKind kind = describe(layer).kind;
  if (kind == ViewerKind::color) {
    figure.color = tone_map(colors_of(layers, layer), static_cast<float>(exposure));
    if (figure.color.empty()) return;
  } else if (const Image<float>* values = find_values(layers, layer, light); values == nullptr) {
    return;
  } else if (kind == ViewerKind::category) {
    figure.category = Image<std::uint8_t>(values->width, values->height);
    for (std::size_t i = 0; i < values->size(); ++i) {
      figure.category[i] = static_cast<std::uint8_t>(std::clamp((*values)[i], 0.0f, 255.0f));
    }
    figure.categories = categories_of(layer);
  } else {
    figure.values = *values;
    hide_uncounted(figure.values, figure.stem, layers);
    figure.scale = color_scale(layer);
  }
  add_figure(presentation, std::move(figure));
}

std::vector<CategoryColor> categories_of(Layer layer) {
  if (layer == Layer::classes) return class_colors();
  return layer == Layer::cause_image ? image_cause_colors() : std::vector<CategoryColor>{};
}

std::vector<Column> plain_columns(std::initializer_list<const char*> names) {
  return mapped(names, [](const char* name) { return Column{name, "", ""}; });
}

ReportTable statistics_table(std::string title, const Statistics& statistics) {
  const std::vector<Column> columns = columns_of(statistics);
  const std::vector<Value> row = row_of(statistics);
  Table table{plain_columns({"quantity", "value", "unit", "meaning"}), {}};
  for (std::size_t i = 0; i < columns.size(); i += width_of(columns, i)) {
    table.rows.push_back(
        {columns[i].name, measured_value(columns, row, i), shown_unit(columns[i]), columns[i].meaning});
  }
  return {std::move(title), std::move(table)};
}

void add_metrics_table(ReportSection& section, const std::vector<MetricScore>& scores) {
  if (scores.empty()) return;
  Table table{plain_columns({"metric", "value", "unit", "range", "formula"}), {}};
  for (const auto& [column, score] : scores) {
    table.rows.push_back({std::string(column.metric->title), digits_text(score, 4), column.unit,
                          std::string(column.metric->range), std::string(column.metric->formula)});
  }
  section.tables.push_back({"Image metrics", std::move(table)});
}

std::string offset_text(const TraceStatistics& statistics) {
  return fmt::format("rays start at an offset of at most {} from the surfaces.",
                     metres_text(statistics.largest_offset));
}

std::string precision_text(const SamplingPrecision& precision, const TruthParams& truth, bool is_over_pixel) {
  if (precision.pixels == 0) return {};
  const char* rays = is_over_pixel ? "points" : "rays";
  std::string text = fmt::format(
      "The 95 % confidence intervals account for the sampling noise of the reference. With {:.0f} {} per pixel on "
      "average, the interval of a single pixel, estimated from the scatter of groups of its {}, is ± {} % on "
      "average and ± {} % at most{}.",
      precision.mean_samples, rays, rays, digits_text(100.0 * precision.mean_half_width, 2),
      digits_text(100.0 * precision.worst_half_width, 2),
      is_over_pixel ? "; it is large where few of the points lie on the surface that the pixel's centre shows" : "");
  if (truth.tolerance > 0.0) {
    text += fmt::format(
        " {} of {} pixels stopped at truth.max-spp ({} rays) before they reached the tolerance of ± {:g} %.",
        precision.pixels_at_limit, precision.pixels, truth.max_spp, 100.0 * truth.tolerance);
  }
  return text;
}

std::string precision_line(const SamplingPrecision& precision, bool is_over_pixel) {
  std::string line = fmt::format("{:.0f} {} per pixel; 95 % interval of a pixel: ± {} % on average, ± {} % at most",
                                 precision.mean_samples, is_over_pixel ? "points" : "rays",
                                 digits_text(100.0 * precision.mean_half_width, 2),
                                 digits_text(100.0 * precision.worst_half_width, 2));
  if (precision.pixels_at_limit > 0) {
    line += fmt::format("; {} of {} pixels stopped at truth.max-spp", precision.pixels_at_limit, precision.pixels);
  }
  return line;
}

Table in_percent(const Table& table, std::size_t first_column, std::string_view kind) {
  Table shown;
  shown.rows.resize(table.rows.size());
  for (std::size_t c = 0; c < table.columns.size(); c += width_of(table.columns, c)) {
    const bool is_measured = c >= first_column;
    const Column& column = table.columns[c];
    shown.columns.push_back(is_measured ? Column{head_words(column.name, kind), shown_unit(column), column.meaning}
                                        : column);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const std::vector<Value>& row = table.rows[r];
      shown.rows[r].push_back(is_measured ? measured_value(table.columns, row, c) : row[c]);
    }
  }
  return shown;
}

std::string statistic_words(std::string_view name, std::string_view kind) {
  std::string words(name);
  const auto known = std::ranges::find_if(known_statistics(), [&](const KnownStatistic& each) {
    return each.name == name && !each.title.empty() && (kind.empty() || each.kind == kind);
  });
  if (known != known_statistics().end()) words = known->title;
  for (const std::string_view subject : {" of visibility", " of accessibility", " of the image"}) {
    if (words.ends_with(subject)) words.resize(words.size() - subject.size());
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  const auto is_upper = [&](std::size_t i) { return std::isupper(static_cast<unsigned char>(words[i])) != 0; };
  if (words.size() > 1 && is_upper(0) && !is_upper(1)) {
    words.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(words.front())));
  }
  return words;
}

std::string head_words(std::string_view name, std::string_view kind) {
  constexpr std::size_t longest = 36;
  std::string words = statistic_words(name, kind);
  if (words.size() <= longest) return words;
  words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

const std::vector<CategoryColor>& class_colors() {
  // The palette of Okabe and Ito without its yellow, which is hard to see on white. Printed in grey, the causes have a
  // CIE L* of 53, 61, 46 and 70; the other classes are lighter. Figures for print are hatched, too.
  static const std::vector<CategoryColor> colors = [] {
    constexpr std::array<glm::u8vec3, 7> inks = {{{240, 240, 240},
                                                  {213, 94, 0},
                                                  {204, 121, 167},
                                                  {0, 114, 178},
                                                  {86, 180, 233},
                                                  {200, 200, 200},
                                                  {255, 255, 255}}};
    constexpr std::array<Hatch, 7> hatches = {Hatch::none, Hatch::none, Hatch::rising, Hatch::horizontal,
                                              Hatch::dots, Hatch::none, Hatch::none};
    std::vector<CategoryColor> named;
    for (std::size_t i = 0; i < inks.size(); ++i) {
      named.push_back({std::string(pixel_class_names[i]), inks[i], hatches[i]});
    }
    return named;
  }();
  return colors;
}

void add_figure(Presentation& presentation, Figure figure) {
  FigureHead head = head_of(figure);
  if (!head.conditions.empty()) head.caption += (head.caption.empty() ? "" : " ") + head.conditions + ".";
  presentation.section.figures.push_back(std::move(head));
  presentation.figures.push_back(std::move(figure));
}

Presentation present_picture(const LayeredImage& layers) {
  Presentation presentation;
  presentation.section.title = "The view";
  const std::vector<NamedLayer> measured = named_layers(layers);
  const auto has = [&](Layer layer) {
    return std::ranges::any_of(measured, [&](const NamedLayer& each) { return each.description->layer == layer; });
  };
  const auto of = [&](Layer raster, Layer truth) {
    return has(raster) ? "the technique's" : has(truth) ? "the reference's" : "none";
  };
  std::string text = "The shaded image, for orientation only.";
  if (!has(Layer::truth_image) && !has(Layer::raster_image)) {
    text = fmt::format("Diffuse shading, for orientation only. Shadows: {}. Ambient occlusion: {}.",
                       of(Layer::raster_visibility, Layer::truth_visibility), of(Layer::raster_ao, Layer::truth_ao));
  }
  add_layer_figure(presentation, layers, Layer::picture, {}, "The view, shaded", text);
  return presentation;
}

std::string filter_warning(const std::string& remedy, const std::string& where) {
  return fmt::format(
      "against a hard shadow{} every blurred pixel is wrong, so the least error does not show which filter is best; {}",
      where, remedy);
}

std::string filter_remedy(const std::string& flag) {
  return fmt::format(
      "give the light a size (--light.angle for a directional one, --light.radius for others), or use {} {}", flag,
      edge_roughness_metric.name);
}

bool measures_edges(const std::string& names) { return names.find(edge_roughness_metric.name) != std::string::npos; }

std::string nothing_counted_text(const CountedPixels& counted) {
  constexpr std::array<std::string_view, 6> reasons = {"",
                                                       "are background",
                                                       "face away from the light",
                                                       "lie outside its shadow map",
                                                       "lie outside its cone",
                                                       "lie beyond its range"};
  if (counted.totals[static_cast<std::size_t>(PixelExclusion::none)] > 0) return {};
  std::uint64_t all = 0;
  for (const std::uint64_t total : counted.totals) all += total;
  std::string text;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    const std::uint64_t total = counted.totals[i];
    if (total == all) return fmt::format("nothing to measure: all {} pixels {}", all, reasons[i]);
    if (total > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", total, reasons[i]);
  }
  return fmt::format("nothing to measure: of {} pixels, {}", all, text);
}

}  // namespace umbrameter
