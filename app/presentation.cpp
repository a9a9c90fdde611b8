#include "app/presentation.h"

#include <fmt/format.h>

#include <cmath>

#include "app/layers.h"
#include "app/scene_report.h"
#include "compare/bias_units.h"
#include "compare/sweep.h"

namespace umbrameter {
namespace {

// One range for every picture of a kind, so that two runs can be compared.
const ColorScale visibility_scale{ColorMap::visibility, 0.0, 1.0, "visibility [1]: 0 blocked, 1 lit"};
const ColorScale visibility_error_scale{ColorMap::error, -1.0, 1.0, "raster − truth [1]: below 0 too dark"};
const ColorScale ao_scale{ColorMap::visibility, 0.0, 1.0, "accessibility [1]: 1 open"};
const ColorScale ao_error_scale{ColorMap::error, -0.5, 0.5, "raster − truth [1]: below 0 too dark"};

std::string value_text(Experiment experiment, std::string_view key) {
  return to_string(require(describe(experiment), key).value());
}

ImageFigure scalar_figure(std::string stem, std::string title, std::string caption, const Image<float>& values,
                          const ColorScale& scale) {
  ImageFigure figure;
  figure.stem = std::move(stem);
  figure.title = std::move(title);
  figure.caption = std::move(caption);
  figure.values = values;
  figure.scale = scale;
  return figure;
}

ImageFigure class_figure(const std::string& layer, const std::string& title, const ShadowMeasurement& shadow) {
  ImageFigure figure;
  figure.stem = "class_" + layer;
  figure.title = "Causes: " + title;
  figure.caption = "The cause that most of each pixel's wrong taps share.";
  const Image<PixelClass> classes = classify(shadow.raster->wrong, shadow.counted);
  figure.category = Image<std::uint8_t>(classes.width, classes.height);
  for (std::size_t i = 0; i < classes.size(); ++i) figure.category[i] = static_cast<std::uint8_t>(classes[i]);
  figure.categories = class_colors();
  return figure;
}

ReportTable statistics_table(std::string title, const std::vector<Column>& columns, const std::vector<Value>& row) {
  Table table{{{"quantity", "", ""}, {"value", "", ""}, {"unit", "", ""}, {"meaning", "", ""}}, {}};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool is_share = columns[i].unit == "1";
    const std::string value = is_share                 ? share_text(to_number(row[i]))
                              : columns[i].unit == "m" ? fmt::format("{:.5g}", to_number(row[i]))
                                                       : to_string(row[i]);
    table.rows.push_back({columns[i].name, value, std::string(is_share ? "%" : columns[i].unit), columns[i].meaning});
  }
  return {std::move(title), std::move(table)};
}

std::string counted_text(const CountedPixels& counted, bool is_soft) {
  const auto total = [&](Counting c) { return counted.totals[static_cast<std::size_t>(c)]; };
  return fmt::format(
      "Counted are {} pixels that face {}the light, inside its map, cone and range. Not counted: {} turned away, {} "
      "outside the map, {} outside the cone, {} out of range, {} background.",
      total(Counting::counted), is_soft ? "part of " : "", total(Counting::turned_away), total(Counting::outside_map),
      total(Counting::outside_cone), total(Counting::outside_range), total(Counting::background));
}

std::string offset_text(const TraceStatistics& statistics) {
  return fmt::format(" Rays left the surfaces with an offset of at most {}.", length(statistics.largest_offset));
}

// Of a reference that was sampled.
std::string precision_text(const SamplingPrecision& precision, const TruthParams& truth) {
  if (precision.pixels == 0) return {};
  std::string text = fmt::format(
      "Intervals are 95 % and come from the reference's sampling. Half widths of its pixels' own intervals: mean "
      "{:.5f}, worst {:.5f}, from {:.0f} samples a pixel on average.",
      precision.mean_half_width, precision.worst_half_width, precision.mean_samples);
  if (truth.tolerance > 0.0) {
    text += fmt::format(" {} of {} pixels reached the limit of {} rays before the tolerance of {:g}.",
                        precision.pixels_at_limit, precision.pixels, truth.max_spp, truth.tolerance);
  }
  return text;
}

std::string precision_line(const SamplingPrecision& precision) {
  std::string line = fmt::format("{:.0f} samples a pixel, half width of its 95 % interval {:.5f}, at worst {:.5f}",
                                 precision.mean_samples, precision.mean_half_width, precision.worst_half_width);
  if (precision.pixels_at_limit > 0) {
    line += fmt::format("; {} of {} pixels at the limit", precision.pixels_at_limit, precision.pixels);
  }
  return line;
}

// What one light's shadow rays went to.
std::string truth_caption(const ShadowMeasurement& shadow) {
  const std::string common = "Shadow rays against the exact geometry; turned-away surfels count as 0.";
  if (!is_soft(shadow)) return common;
  return fmt::format("{} The light is {}{}; {:.0f} samples a pixel; the visible share of its {}.", common,
                     std::holds_alternative<DistantEmitter>(shadow.emitter) ? "" : "a ", extent_text(shadow.emitter),
                     shadow.truth->precision.mean_samples,
                     shadow.experiment.truth.light_sampling == LightSampling::area ? "area" : "solid angle");
}

void present_soft_error(Presentation& presentation, const Workbench& workbench, const ShadowMeasurement& shadow) {
  const std::string title = workbench.title(shadow.light);
  const SoftVisibilityStatistics& s = *shadow.soft_statistics;
  ReportSection& section = presentation.section;
  add_figure(presentation,
             scalar_figure("error_visibility_" + workbench.layer(shadow.light), "Error: " + title,
                           "Blue is too dark, red is too bright.",
                           signed_error(shadow.raster->visibility, shadow.truth->visibility), visibility_error_scale));
  section.text +=
      "\n\nThe light has extent, so that its truth is a share and no single tap is right or wrong: the causes of a "
      "hard "
      "shadow's error do not apply, and the error is split by sign.";
  if (s.error.max_x >= 0) {
    section.text += fmt::format(" The largest error is {:.3g}, first at pixel ({}, {}).", s.error.max_error,
                                s.error.max_x, s.error.max_y);
  }
  section.headlines = {
      {"mean absolute error", percent(s.error.mae), fmt::format("of {} counted pixels", s.error.pixels)},
      {"too dark", percent(s.error.too_dark), "the part of it where raster is below truth"},
      {"too bright", percent(s.error.too_bright), "the part of it where raster is above truth"},
      {"RMS error", percent(s.error.rmse), "corrected for the reference's variance"},
      {"penumbra", percent(s.penumbra), "of the counted pixels"},
  };
  section.tables = {statistics_table("Error of the visibility of " + title, soft_visibility_columns(), to_row(s)),
                    bias_table(shadow)};
  presentation.lines.push_back(fmt::format("{:<10} error {}: too dark {}, too bright {}  (penumbra {}, {})", title,
                                           percent(s.error.mae), percent(s.error.too_dark), percent(s.error.too_bright),
                                           percent(s.penumbra), extent_text(shadow.emitter)));
}

}  // namespace

std::string share_text(double share) { return fmt::format("{:.4f}", 100.0 * share); }

Table in_percent(Table table, std::size_t first_column) {
  for (std::size_t c = first_column; c < table.columns.size(); ++c) {
    if (table.columns[c].unit != "1") continue;
    table.columns[c].unit = "%";
    for (std::vector<Value>& row : table.rows) row[c] = share_text(to_number(row[c]));
  }
  return table;
}

const std::vector<CategoryColor>& class_colors() {
  // Okabe and Ito's palette without its yellow, which is lost on white. On paper printed grey CIE L* is 53, 61, 46 and
  // 70 for the causes; what is no error is lighter.
  static const std::vector<CategoryColor> colors = [] {
    constexpr std::array<glm::u8vec3, 7> inks = {{{240, 240, 240},
                                                  {213, 94, 0},
                                                  {204, 121, 167},
                                                  {0, 114, 178},
                                                  {86, 180, 233},
                                                  {200, 200, 200},
                                                  {255, 255, 255}}};
    std::vector<CategoryColor> named;
    for (std::size_t i = 0; i < inks.size(); ++i) named.push_back({std::string(pixel_class_names[i]), inks[i]});
    return named;
  }();
  return colors;
}

std::string percent(double share) {
  const double value = 100.0 * share;
  if (value != 0.0 && std::abs(value) < 0.001) return fmt::format("{:.1e} %", value);
  return fmt::format("{:.3f} %", value);
}

std::string percent(const Estimate& share) {
  return fmt::format("{:.3f} % [{:.3f}, {:.3f}]", 100.0 * share.value, 100.0 * share.lower, 100.0 * share.upper);
}

std::string length_text(const Length& any) {
  return any.unit == LengthUnit::metres ? length(any.number)
                                        : fmt::format("{:.4g} {}", any.number, unit_name(any.unit));
}

std::string length(double metres) {
  const double size = std::abs(metres);
  if (size >= 1.0 || size == 0.0) return fmt::format("{:.3g} m", metres);
  if (size >= 0.01) return fmt::format("{:.3g} cm", metres * 100.0);
  return fmt::format("{:.3g} mm", metres * 1000.0);
}

void add_figure(Presentation& presentation, ImageFigure figure) {
  presentation.section.figures.push_back(figure.stem);
  presentation.section.figure_titles.push_back(figure.title);
  presentation.section.captions.push_back(figure.caption);
  presentation.images.push_back(std::move(figure));
}

void add_figure(Presentation& presentation, PlotFigure figure) {
  presentation.section.figures.push_back(figure.stem);
  presentation.section.figure_titles.push_back(figure.title);
  presentation.section.captions.push_back(figure.caption);
  presentation.plots.push_back(std::move(figure));
}

void add_figure(Presentation& presentation, HeatMapFigure figure) {
  presentation.section.figures.push_back(figure.stem);
  presentation.section.figure_titles.push_back(figure.title);
  presentation.section.captions.push_back(figure.caption);
  presentation.heat_maps.push_back(std::move(figure));
}

Presentation present_picture(const Workbench& workbench, const Measurement& measurement) {
  Presentation presentation;
  presentation.section.title = "The view";
  ImageFigure figure;
  figure.stem = "picture";
  figure.title = "The view, shaded";
  figure.caption = "Diffuse shading with the measured visibility and ambient occlusion; for orientation only.";
  figure.color = tone_map(picture_of(workbench, measurement), 1.0f);
  add_figure(presentation, std::move(figure));
  return presentation;
}

ReportTable bias_table(const ShadowMeasurement& shadow) {
  Table table{{{"constant bias", "", ""}, {"value", "", ""}, {"unit", "", ""}}, {}};
  const double texel = shadow.counted.mean_texel;
  const BiasInUnits bias = in_units(shadow.experiment.shadow.constant_bias, texel, shadow.frame.far_depth);
  const auto known = [](double number) { return std::isfinite(number) ? fmt::format("{:.4g}", number) : "—"; };
  table.rows.push_back({std::string("along the light"), known(bias.metres), std::string("m")});
  table.rows.push_back(
      {std::string("at the mean texel of ") + length(texel), known(bias.texels), std::string("texels")});
  table.rows.push_back({std::string("of the map's depth range of ") + length(shadow.frame.far_depth), known(bias.depth),
                        std::string("normalised depth")});
  return {"The constant bias", std::move(table)};
}

std::string agreement_text(const ClassAgreement& agreement) {
  return fmt::format(
      "\n\nThe two-plane rule took {:.3f} % of the wrong taps for another surface's in front of a lit point; rays "
      "found "
      "{:.3f} % of those, {:.4f} % of all wrong taps, on the receiver's own surface, and they count as acne.",
      agreement.wrong > 0 ? 100.0 * static_cast<double>(agreement.foreign) / static_cast<double>(agreement.wrong) : 0.0,
      100.0 * share_of_foreign(agreement), 100.0 * share_of_wrong(agreement));
}

ReportTable worst_parts(const char* what, PartKind kind, const std::vector<PartError>& parts,
                        std::uint32_t weight_sum) {
  constexpr std::size_t most = 10;
  const bool are_more = parts.size() > most;
  return {fmt::format("Error by {}{}", what, are_more ? fmt::format(", the {} with most of it", most) : ""),
          in_percent(part_table(kind, parts, weight_sum, most))};
}

Presentation present_shadow(const Workbench& workbench, const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const std::string& layer = workbench.layer(shadow.light);
  const std::string title = workbench.title(shadow.light);
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "Shadow of " + title;
  section.text = counted_text(shadow.counted, is_soft(shadow));
  if (shadow.truth) {
    add_figure(presentation, scalar_figure("truth_visibility_" + layer, "Truth: " + title, truth_caption(shadow),
                                           shadow.truth->visibility, visibility_scale));
    section.text += offset_text(shadow.truth->statistics);
    if (is_soft(shadow)) section.text += "\n\n" + precision_text(shadow.truth->precision, experiment.truth);
  }
  if (shadow.raster) {
    add_figure(presentation,
               scalar_figure("raster_visibility_" + layer, "Shadow map: " + title,
                             fmt::format("{}² texels, {} filter, constant bias {}, slope bias {:g} texels.",
                                         shadow.frame.resolution, value_text(experiment, "shadow.filter"),
                                         length_text(experiment.shadow.constant_bias), experiment.shadow.slope_bias),
                             shadow.raster->visibility, visibility_scale));
  }
  if (shadow.soft_statistics) {
    present_soft_error(presentation, workbench, shadow);
    return presentation;
  }
  if (!shadow.statistics) {
    const double pixels = static_cast<double>(shadow.counted.totals[0]);
    std::string line =
        fmt::format("{:<10} {:.0f} pixels counted, texel {}", title, pixels, length(shadow.counted.mean_texel));
    if (shadow.truth && is_soft(shadow)) line += "; " + precision_line(shadow.truth->precision);
    presentation.lines.push_back(std::move(line));
    return presentation;
  }
  const VisibilityStatistics& s = *shadow.statistics;
  add_figure(presentation,
             scalar_figure("error_visibility_" + layer, "Error: " + title, "Blue is too dark, red is too bright.",
                           signed_error(shadow.raster->visibility, shadow.truth->visibility), visibility_error_scale));
  add_figure(presentation, class_figure(layer, title, shadow));
  section.headlines = {{"mean absolute error", percent(s.mae), fmt::format("of {} counted pixels", s.pixels)}};
  const std::array<double, cause_count> shares = {s.acne, s.false_occlusion, s.peter_panning, s.leak};
  for (std::size_t c = 0; c < cause_count; ++c) {
    const auto cause = static_cast<Cause>(c);
    section.headlines.push_back(
        {std::string(cause_title(cause)), percent(shares[c]), std::string(cause_meaning(cause))});
  }
  const std::uint32_t weight_sum = shadow.raster->wrong.weight_sum;
  section.tables = {statistics_table("Error of the visibility of " + title, visibility_columns(), to_row(s)),
                    bias_table(shadow), worst_parts("objects", PartKind::object, shadow.objects, weight_sum),
                    worst_parts("materials", PartKind::material, shadow.materials, weight_sum)};
  if (shadow.agreement) section.text += agreement_text(*shadow.agreement);
  if (s.max_x >= 0) {
    section.text +=
        fmt::format("\n\nThe largest error is {:.3g}, first at pixel ({}, {}).", s.max_error, s.max_x, s.max_y);
  }
  presentation.lines.push_back(
      fmt::format("{:<10} error {}: acne {}, false occlusion {}, peter-panning {}, leak {}  (texel {}, bias {})", title,
                  percent(s.mae), percent(s.acne), percent(s.false_occlusion), percent(s.peter_panning),
                  percent(s.leak), length(s.mean_texel), length_text(experiment.shadow.constant_bias)));
  if (shadow.agreement && shadow.agreement->taps > 0) {
    presentation.lines.push_back(
        fmt::format("{:<10} of {} taps that planes called foreign, rays called {:.3f} % own, by weight", "",
                    shadow.agreement->taps, 100.0 * share_of_foreign(*shadow.agreement)));
  }
  return presentation;
}

Presentation present_ao(const AoMeasurement& ao) {
  const Experiment& experiment = ao.experiment;
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "Ambient occlusion";
  const std::string limit = has_distance_limit(experiment.truth)
                                ? "up to " + length(experiment.truth.ao_distance.number)
                                : "without a distance limit";
  if (ao.truth) {
    add_figure(presentation,
               scalar_figure("truth_ao", "Truth: ambient occlusion",
                             fmt::format("Hemisphere rays {}, {:.0f} a pixel, {} weight.", limit,
                                         ao.truth->precision.mean_samples, value_text(experiment, "truth.ao-weight")),
                             ao.truth->ao, ao_scale));
  }
  if (ao.raster) {
    add_figure(presentation,
               scalar_figure("raster_ao", "SSAO",
                             fmt::format("{} samples, radius {}, bias {}{}.", experiment.ao.samples,
                                         length(experiment.ao.radius.number), length(experiment.ao.bias.number),
                                         experiment.ao.blur == AoBlur::box
                                             ? fmt::format(", {0}×{0} box blur", experiment.ao.blur_size)
                                             : ""),
                             *ao.raster, ao_scale));
  }
  if (ao.truth) {
    section.text = precision_text(ao.truth->precision, experiment.truth) + offset_text(ao.truth->statistics);
  }
  if (!ao.statistics) {
    if (ao.truth) {
      presentation.lines.push_back(fmt::format("{:<10} {}", "AO", precision_line(ao.truth->precision)));
    }
    return presentation;
  }
  const AoStatistics& s = *ao.statistics;
  add_figure(presentation, scalar_figure("error_ao", "Error: ambient occlusion", "Blue is too dark, red is too bright.",
                                         signed_error(*ao.raster, ao.truth->ao), ao_error_scale));
  section.headlines = {
      {"mean absolute error", percent(s.mae), fmt::format("of {} pixels", s.pixels)},
      {"RMS error", percent(s.rmse), "corrected for the reference's variance"},
      {"mean error", percent(s.mean_error), "below 0: too dark"},
  };
  section.tables = {statistics_table("Error of the ambient occlusion", ao_columns(), to_row(s))};
  presentation.lines.push_back(fmt::format("{:<10} error {}, mean {} (SSAO radius {}, truth {})", "AO", percent(s.mae),
                                           percent(s.mean_error), length(experiment.ao.radius.number), limit));
  return presentation;
}

}  // namespace umbrameter
