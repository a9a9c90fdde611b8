#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "compare/bias_units.h"
#include "present/bias_advice_report.h"
#include "present/plateau_text.h"
#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "present/scene_report.h"
#include "reports/files/text_layout.h"
#include "techniques/shadow/map_fit.h"
#include "techniques/shadow/pcf.h"

namespace umbrameter {
namespace {

std::string counted_text(const CountedPixels& counted, bool is_soft, bool is_traced) {
  const auto total = [&](PixelExclusion c) { return counted.totals[static_cast<std::size_t>(c)]; };
  std::string text = fmt::format("{} counted pixels face {}the light and lie inside its map, cone and range.",
                                 grouped(total(PixelExclusion::none)), is_soft ? "at least a part of " : "");
  const char* separator = " Not counted: ";
  for (const auto& [exclusion, name] : {std::pair{PixelExclusion::back_facing, "back-facing"},
                                        {PixelExclusion::outside_map, "outside the map"},
                                        {PixelExclusion::outside_cone, "outside the cone"},
                                        {PixelExclusion::outside_range, "out of range"},
                                        {PixelExclusion::background, "background"}}) {
    if (total(exclusion) == 0) continue;
    text += fmt::format("{}{} {}", separator, grouped(total(exclusion)), name);
    separator = ", ";
  }
  if (separator[0] == ',') text += ".";
  if (is_traced) {
    text +=
        " The map is that of compare. Here rays find the surface of each pixel, there a rasteriser: a few pixels at "
        "outlines differ.";
  }
  return text;
}

std::string truth_caption(const ShadowMeasurement& shadow) {
  const std::string text =
      "Shadow rays against the exact geometry. Back-facing pixels are 0. Pixels outside the light's map, cone or range "
      "are not counted; technique and reference may differ there.";
  if (!shadow.is_sampled) return text;
  const double samples = shadow.truth->precision.mean_samples;
  const std::string extent = extent_text(shadow.emitter);
  const std::string light = (std::holds_alternative<DistantEmitter>(shadow.emitter) ? "" : "a ") + extent;
  if (shadow.experiment.truth.shadow == ShadowReference::pixel)
    return fmt::format(
        "{} Mean over the part of each pixel that shows the surface of its centre, from {:.0f} points of the pixel{}.",
        text, samples, extent.empty() ? "" : ", each with a ray to a point of the light, " + light);
  return fmt::format("{} The light is {}; {:.0f} rays per pixel measure the visible share of its {}.", text, light,
                     samples, shadow.experiment.truth.light_sampling == LightSampling::area ? "area" : "solid angle");
}

void add_error_figure(Presentation& presentation, const SceneFacts& scene, const LayeredImage& layers,
                      const ShadowMeasurement& shadow) {
  add_layer_figure(presentation, layers, Layer::error_visibility, scene.layer(shadow.light),
                   "Error: " + scene.title(shadow.light), error_caption);
}

// Not of another renderer.
bool is_our_map(const Experiment& experiment) { return renderer_title(experiment).empty() && reads_map(experiment); }

void add_bias_table(ReportSection& section, const ShadowMeasurement& shadow) {
  if (!is_our_map(shadow.experiment)) return;
  Table table{plain_columns({"constant bias", "value", "unit"}), {}};
  const double texel = shadow.counted.mean_texel;
  const BiasInUnits bias = in_units(shadow.experiment.shadow.bias.constant, texel, shadow.depth_unit);
  const auto known = [](double number) { return digits_text(number); };
  const bool is_linear = shadow.depth_unit == shadow.layout.far_depth;
  // Where texels differ in size, a number of them is several lengths; a share of a depth that is not linear, too.
  const LengthUnit given = shadow.experiment.shadow.bias.constant.unit;
  const bool is_mean = texels_differ(shadow.layout) && (given == LengthUnit::texels || !is_linear);
  const auto converted = [&](LengthUnit own) { return std::string(is_mean && given != own ? ", on average" : ""); };
  table.rows.push_back({"along the light" + converted(LengthUnit::metres), known(bias.metres), std::string("m")});
  table.rows.push_back({"in texels (mean size " + metres_text(texel) + ")", known(bias.texels), std::string("texels")});
  const bool is_of_cascades =
      shadow.layout.kind == MapKind::orthographic && shadow.experiment.shadow.fit.cascade_bias == own_range;
  const std::string unit = metres_text(shadow.depth_unit);
  const std::string depth = is_of_cascades ? "as a share of each cascade's own depth range (mean " + unit + ")"
                            : is_linear    ? "as a share of the map's depth range (" + unit + ")"
                                           : "in units of the map's depth (at the receivers " + unit + " on average)";
  table.rows.push_back({depth + converted(LengthUnit::map_depth), known(bias.depth), std::string("normalised depth")});
  section.tables.push_back({"Constant bias of these images", std::move(table)});
}

TechniqueCapabilities capabilities_of(const ShadowMeasurement& shadow) {
  return umbrameter::capabilities_of(make_technique(shadow.experiment.shadow));
}

// "; no bias recommended: ...", and what finds one; nothing for another renderer, whose bias is not known.
std::string no_advice_text(const ShadowMeasurement& shadow) {
  if (!renderer_title(shadow.experiment).empty()) return {};
  const TechniqueCapabilities technique = capabilities_of(shadow);
  const std::string name = technique_name(shadow.experiment);
  if (!reads_map(shadow.experiment)) return fmt::format("; no bias recommended: {} reads no shadow map", name);
  const std::string reason =
      !technique.sums_comparisons && !technique.reads_light_extent
          ? "acne cannot be counted for " + name + ", as its result is no sum of depth comparisons"
      : !technique.taps_independent_of_bias
          ? "the kernel of " + name + " depends on the bias"
          : "acne can be counted only in a hard shadow (--truth.shadow point: one ray to the light's centre)";
  return "; no bias recommended: " + reason + "; umbrameter tune finds the bias of least error";
}

void present_edge_error(Presentation& presentation, const SceneFacts& scene, const LayeredImage& layers,
                        const ShadowMeasurement& shadow, const EdgeStatistics& s) {
  const std::string title = scene.title(shadow.light);
  ReportSection& section = presentation.section;
  add_error_figure(presentation, scene, layers, shadow);
  section.text += fmt::format(
      "\n\nThe result of {} is no sum of depth comparisons, so no single tap is right or wrong and the error has no "
      "causes. It is split by sign and by distance to the reference's shadow edges instead; at an edge means {} "
      "from it, or in a pixel beside it.",
      technique_name(shadow.experiment), edge_band_text(shadow.experiment));
  if (s.max_x >= 0) {
    section.text +=
        fmt::format(" The largest error is {}, for example at pixel ({}, {}).", percent(s.max_error), s.max_x, s.max_y);
  }
  const EdgeReasons reasons = edge_reasons(shadow.experiment);
  section.headlines = {
      {"mean absolute error", percent(s.mae), fmt::format("of {} counted pixels", grouped(s.pixels))},
      {"too dark away from edges", percent(s.too_dark_away), reasons.too_dark_away},
      {"too dark at edges", percent(s.too_dark_at_edge), reasons.too_dark_at_edge},
      {"too bright at edges", percent(s.too_bright_at_edge), reasons.too_bright_at_edge},
      {"too bright away from edges", percent(s.too_bright_away), reasons.too_bright_away},
  };
  section.tables = {statistics_table("Visibility error: " + title, s)};
  add_bias_table(section, shadow);
  if (reads_map(shadow.experiment) && !reads_one_texel(shadow.experiment))
    section.text += "\n\n" + std::string(filter_caution);
  presentation.answers.push_back(fmt::format(
      "{}: error {}{}; at shadow edges ({} away or in a pixel beside one) too dark {} and too bright {}, elsewhere too "
      "dark {} and too bright {}{}",
      title, percent(s.mae), few_pixels_text(s.pixels), edge_band_text(shadow.experiment), percent(s.too_dark_at_edge),
      percent(s.too_bright_at_edge), percent(s.too_dark_away), percent(s.too_bright_away), no_advice_text(shadow)));
}

void present_soft_error(Presentation& presentation, const SceneFacts& scene, const LayeredImage& layers,
                        const ShadowMeasurement& shadow, const SoftVisibilityStatistics& s) {
  const std::string title = scene.title(shadow.light);
  ReportSection& section = presentation.section;
  add_error_figure(presentation, scene, layers, shadow);
  const bool is_over_pixel = shadow.experiment.truth.shadow == ShadowReference::pixel;
  const std::string extent = extent_text(shadow.emitter);
  const char* const penumbra_name = extent.empty() ? "partly lit" : "penumbra";
  section.text += is_over_pixel ? fmt::format("\n\nThe reference is the mean over each pixel{} (truth.shadow pixel)",
                                              extent.empty() ? "" : " and over the light")
                                : "\n\nThis is an area light. Its reference is the visible share of the light";
  section.text +=
      ", so a single tap is neither right nor wrong and has no cause of error. The error is split into too dark and "
      "too bright instead. ";
  section.text +=
      capabilities_of(shadow).sums_comparisons
          ? "Causes need a binary reference: --truth.shadow point traces one ray, from the pixel's centre to the "
            "light's."
          : fmt::format(
                "The result of {} has no causes against any reference, because it is no sum of depth comparisons.",
                technique_name(shadow.experiment));
  section.text += noise_note;
  if (s.error.max_x >= 0) {
    section.text += fmt::format(" The largest error is {}, for example at pixel ({}, {}).", percent(s.error.max_error),
                                s.error.max_x, s.error.max_y);
  }
  section.headlines = {
      {"mean absolute error", percent(s.error.mae), fmt::format("of {} counted pixels", grouped(s.error.pixels))},
      {"too dark", percent(s.error.too_dark), "part where the technique is darker than the reference"},
      {"too bright", percent(s.error.too_bright), "part where the technique is brighter than the reference"},
      {"RMS error", percent(s.error.rmse), "corrected for the reference's variance"},
      {penumbra_name, percent(s.penumbra), "of the counted pixels, each weighted by 4V(1 − V), V the reference"},
  };
  section.tables = {statistics_table("Visibility error: " + title, s)};
  add_bias_table(section, shadow);
  const std::string soft = fmt::format("the soft shadow of this light ({})", extent);
  const std::string of_pixel = "the mean over each pixel" + (extent.empty() ? "" : " of " + soft);
  presentation.answers.push_back(fmt::format(
      "{}: error {}{} against {}; too dark {}, too bright {}; {} {} of the counted pixels "
      "(each weighted by 4V(1 − V), V the visibility of the reference){}",
      title, percent(s.error.mae), few_pixels_text(s.error.pixels), is_over_pixel ? of_pixel : soft,
      percent(s.error.too_dark), percent(s.error.too_bright), extent.empty() ? "partly lit are" : "the penumbra covers",
      percent(s.penumbra), no_advice_text(shadow)));
}

std::string agreement_text(const ClassAgreement& agreement) {
  // Taps of a filter have weights, so that only shares can be named beside their number.
  std::string text =
      agreement.reclassified == 0
          ? fmt::format("ray tests confirmed the cause of all {} taps of false occlusion.", grouped(agreement.taps))
          : fmt::format("ray tests moved {} of the {} taps first classed as false occlusion to acne.",
                        percent(share_of_unresolved(agreement)), grouped(agreement.taps));
  if (agreement.on_own_layer > 0) {
    text += fmt::format(
        " By ray tests {} of the peter-panning is light leak: where these taps read the map, it holds the receiver's "
        "own surface and no occluder. The tables still count them as peter-panning, so that a single run and a sweep "
        "have the same numbers: in a sweep this test would take too many rays.",
        percent(share_on_own_layer(agreement)));
  }
  return text;
}

ReportTable worst_parts(const char* what, PartKind kind, const std::vector<PartError>& parts,
                        std::uint32_t weight_sum) {
  constexpr std::size_t most = 10;
  const bool are_more = parts.size() > most;
  Table table = part_table(kind, parts, weight_sum, most);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].unit != "1") continue;
    table.columns[c].name = statistic_words(table.columns[c].name);
    table.columns[c].unit = "%";
    for (std::vector<Value>& row : table.rows) row[c] = share_text(to_number(row[c]));
  }
  return {fmt::format("Error by {}{}", what, are_more ? fmt::format(": the {} largest shares", most) : ""),
          std::move(table)};
}

constexpr std::string_view causes_by_rays_text =
    "Too dark is acne where what the light sees around the pixel is the pixel's own surface, else false occlusion; too "
    "bright is light leak where the light passes beside the blocker, else peter-panning. Near shadow edges acne and "
    "false occlusion can be exchanged, and so can light leak and peter-panning.";

constexpr std::string_view causes_by_flips_text =
    "Too dark is acne where what the light sees around the pixel is the pixel's own surface, else false occlusion, by "
    "rays; near shadow edges both can be exchanged. Too bright is light leak where the pixel is lit already at the "
    "bias "
    "that lights two thirds of the acne, else peter-panning: a larger bias lit it.";

// ", normal-offset 1 texel, polygon-offset-factor 2": what else was set to move the comparison or the map.
std::string other_bias_text(const Experiment& experiment) {
  Experiment given = experiment;
  Experiment usual;
  std::string text;
  const auto add = [&](const Parameters& parameters, const Parameters& defaults) {
    for (const Parameter& parameter : parameters) {
      const bool is_named = parameter.key == constant_bias_key || parameter.key == slope_bias_key;
      const std::string value = to_string(parameter.value());
      if (is_named || value == to_string(require(defaults, parameter.key).value())) continue;
      text += fmt::format(", {} {}", parameter.key.substr(parameter.key.find('.') + 1),
                          with_unit(value, parameter.is_number() ? parameter.description.unit : ""));
    }
  };
  add(describe(given.shadow.bias), describe(usual.shadow.bias));
  add(describe(given.shadow.map_depth), describe(usual.shadow.map_depth));
  return text;
}

// What drew the shadow.
std::string technique_caption(const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  if (const std::string renderer = renderer_title(experiment); !renderer.empty()) return renderer + ".";
  const ScreenSpaceParams& march = experiment.shadow.screen_space;
  const std::string steps = fmt::format("rays of {} in {} steps", metres_text(march.length), march.steps);
  if (!reads_map(experiment)) return "Screen-space shadows: " + steps + ".";
  const std::size_t cascades = shadow.layout.kind == MapKind::orthographic ? shadow.layout.views.size() : 1;
  const std::string views = cascades > 1 ? fmt::format("{} cascades of ", cascades) : "";
  const std::string technique = value_text(experiment, "shadow.technique");
  return fmt::format("{}{}² texels, {}, constant bias {}, slope-scaled bias {}{}{}.", views, shadow.layout.resolution,
                     technique == Pcf::name ? value_text(experiment, "shadow.filter") + " filter" : technique,
                     length_text(experiment.shadow.bias.constant),
                     with_unit(fmt::format("{:g}", experiment.shadow.bias.slope), "texels"),
                     other_bias_text(experiment), march.is_combined ? "; contact shadows: " + steps : "");
}

std::string stored_depths_text(const ShadowMeasurement& shadow) {
  const StoredDepths& depths = *shadow.stored_depths;
  const std::string first = metres_text(depths.step_at_nearest);
  const std::string last = metres_text(depths.step_at_farthest);
  return fmt::format(
      "the surfaces in the map have depths of {} to {}, stored in steps of {} ({}, {}); one unit of polygon offset is "
      "{:.3g} of the map's depth range{}.",
      metres_text(depths.range->nearest), metres_text(depths.range->farthest),
      first == last ? first : first + " to " + last, value_text(shadow.experiment, "shadow.depth-format"),
      value_text(shadow.experiment, "shadow.depth-encoding"), depths.polygon_offset_unit,
      stores_floats(shadow.experiment.shadow.map_depth.format) ? " where the stored depth is ½ or more, and less below"
                                                               : "");
}

// With all digits where fewer would be those of the recommended bias, which is another.
std::string given_bias_text(const ShadowMeasurement& shadow) {
  const Length& given = shadow.experiment.shadow.bias.constant;
  const BiasAdvice& advice = *shadow.advice;
  const Length recommended{advice.plateau.recommended.constant, advice.unit};
  const bool reads_alike = given != recommended && length_text(given) == length_text(recommended);
  return reads_alike ? with_unit(fmt::format("{:.6g}", given.number), unit_name(given.unit)) : length_text(given);
}

Presentation present_shadow_error(const SceneFacts& scene, const LayeredImage& layers,
                                  const ShadowMeasurement& shadow) {
  const Experiment& experiment = shadow.experiment;
  const std::string& layer = scene.layer(shadow.light);
  const std::string title = scene.title(shadow.light);
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "Shadow of " + title;
  section.text = counted_text(shadow.counted, !std::holds_alternative<std::monostate>(shadow.emitter), !shadow.raster);
  if (shadow.truth) {
    add_layer_figure(presentation, layers, Layer::truth_visibility, layer, "Reference: " + title,
                     truth_caption(shadow));
    presentation.details.push_back(title + ": " + offset_text(shadow.truth->statistics));
    if (shadow.is_sampled)
      section.text += "\n\n" + precision_text(shadow.truth->precision, experiment.truth,
                                              experiment.truth.shadow == ShadowReference::pixel);
  }
  if (shadow.raster) {
    add_layer_figure(presentation, layers, Layer::raster_visibility, layer,
                     (is_our_map(experiment) ? "Shadow map: " : "Shadow: ") + title, technique_caption(shadow));
  }
  if (shadow.stored_depths && shadow.stored_depths->range && reads_map(experiment)) {
    presentation.details.push_back(title + ": " + stored_depths_text(shadow));
  }
  if (const std::string reason = nothing_counted_text(shadow.counted); !reason.empty()) {
    section.text += "\n\n" + title + ": " + reason + ".";
    presentation.answers.push_back(title + ": " + reason);
    return presentation;
  }
  if (!shadow.statistics) {
    std::string line = fmt::format("{}: {} counted pixels", title, grouped(shadow.counted.totals[0]));
    if (shadow.raster) line += fmt::format(", mean texel {}", metres_text(shadow.counted.mean_texel));
    if (shadow.truth && shadow.is_sampled)
      line += "; " + precision_line(shadow.truth->precision, experiment.truth.shadow == ShadowReference::pixel);
    presentation.answers.push_back(std::move(line));
    return presentation;
  }
  if (const auto* soft = std::get_if<SoftVisibilityStatistics>(&*shadow.statistics)) {
    present_soft_error(presentation, scene, layers, shadow, *soft);
    return presentation;
  }
  if (const auto* edges = std::get_if<EdgeStatistics>(&*shadow.statistics)) {
    present_edge_error(presentation, scene, layers, shadow, *edges);
    return presentation;
  }
  const VisibilityStatistics& s = *by_cause(shadow);
  add_error_figure(presentation, scene, layers, shadow);
  add_layer_figure(presentation, layers, Layer::classes, layer, "Causes: " + title, classes_caption);
  section.headlines = {{"mean absolute error", percent(s.mae), fmt::format("of {} counted pixels", grouped(s.pixels))}};
  const std::array<double, cause_count> shares = {s.acne, s.false_occlusion, s.peter_panning, s.leak};
  for (std::size_t c = 0; c < cause_count; ++c) {
    const auto cause = static_cast<Cause>(c);
    section.headlines.push_back(
        {std::string(cause_title(cause)), percent(shares[c]), std::string(cause_meaning(cause))});
  }
  const std::uint32_t weight_sum = shadow.raster->wrong.weight_sum;
  if (shadow.advice) {
    section.tables.push_back(advice_table(*shadow.advice));
    add_engines(presentation, shadow.advice->engines, title);
  }
  section.tables.push_back(statistics_table("Visibility error: " + title, s));
  add_bias_table(section, shadow);
  section.tables.insert(section.tables.end(),
                        {worst_parts("object", PartKind::object, shadow.objects, weight_sum),
                         worst_parts("material", PartKind::material, shadow.materials, weight_sum)});
  if (shadow.agreement) presentation.details.push_back(title + ": " + agreement_text(*shadow.agreement));
  const std::string renderer = renderer_title(experiment);
  if (!renderer.empty()) {
    section.text += "\n\nOnly an image is known (" + renderer + "), not its taps. Causes: " + shadow.cause_source +
                    ". " + std::string(shadow.cause_source == "rays" ? causes_by_rays_text : causes_by_flips_text);
  } else if (!reads_one_texel(experiment)) {
    section.text += "\n\n" + std::string(filter_caution);
  }
  if (s.max_x >= 0) {
    section.text += fmt::format("\n\nThe largest error is {}, for example at pixel ({}, {}).", percent(s.max_error),
                                s.max_x, s.max_y);
  }
  const std::string parts = fmt::format("acne {}, false occlusion {}, peter-panning {}, light leak {}", percent(s.acne),
                                        percent(s.false_occlusion), percent(s.peter_panning), percent(s.leak));
  if (shadow.advice) {
    presentation.answers.push_back(title + ": " + advice_text(*shadow.advice));
    // Before the lines for engines, which are about another bias.
    presentation.lines.insert(presentation.lines.begin(),
                              fmt::format("  {} at {}: {}", title, given_bias_text(shadow), parts));
  } else {
    const std::string by = renderer.empty() ? "" : ", " + renderer;
    const std::string at = renderer.empty() ? " at a bias of " + length_text(experiment.shadow.bias.constant) : "";
    // Of a sweep's cell the sweep itself tells the bias.
    const std::string why_no_bias = capabilities_of(shadow).taps_independent_of_bias ? "" : no_advice_text(shadow);
    presentation.answers.push_back(
        fmt::format("{}{}: error {}{}{}; {}{}", title, by, percent(s.mae), few_pixels_text(s.pixels), at, parts,
                    renderer.empty() ? why_no_bias : " (causes: " + shadow.cause_source + ")"));
  }
  return presentation;
}

}  // namespace

Presentation present_shadow(const SceneFacts& scene, const LayeredImage& layers, const ShadowMeasurement& shadow) {
  Presentation presentation = present_shadow_error(scene, layers, shadow);
  add_metrics_table(presentation.section, shadow.metrics);
  return presentation;
}

}  // namespace umbrameter
