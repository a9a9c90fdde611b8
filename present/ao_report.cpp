#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "reports/files/text_layout.h"
#include "results/layers.h"
#include "techniques/ao/integral.h"

namespace umbrameter {
namespace {

// How far the technique looks for occluders, metres.
double reach_of(const AoParams& params) {
  const std::optional<AoIntegral> integral = find_integral(make_technique(params));
  return integral ? integral->reach : params.sampling.radius.number;
}

// How far technique and reference look; `limit` as ao_limit_text() gives it.
std::string reaches_text(const AoParams& params, const std::string& limit) {
  const double radius = params.sampling.radius.number;
  const double reach = reach_of(params);
  const std::string reaches = metres_text(reach);
  AoTechnique technique = make_technique(params);
  const Parameters parameters = describe(technique);
  // Only techniques that test points have one; what hides a point in the image may be nearer to the camera than it.
  if (const Parameter* range_check = find(parameters, "ao.range-check")) {
    return fmt::format(
        "The reference looks for occluders {}. The technique tests points up to {} away: a surface that hides such a "
        "point from the camera darkens the pixel{}.",
        limit, reaches,
        std::get<bool>(range_check->value())
            ? fmt::format(". The range check fades out surfaces whose depth differs from the pixel's by more than {}",
                          metres_text(radius))
            : " from any distance, as ao.range-check is false");
  }
  if (limit == "up to " + reaches) return fmt::format("Technique and reference look for occluders up to {}.", reaches);
  return fmt::format("The technique looks for occluders up to {}{}, the reference {}.", reaches,
                     reach == radius ? "" : fmt::format(" ({:.4g} times ao.radius)", reach / radius), limit);
}

std::string ao_technique_text(const AoParams& params) {
  AoTechnique technique = make_technique(params);
  const bool has_bias = find(describe(technique), "ao.bias") != nullptr;
  AoBlurParams blur = blur_of(params);
  const std::string kind = to_string(require(describe(blur), "ao.blur").value());
  return fmt::format("{}, radius {}{}{}.", sampling_text(technique), ao_radius_text(params),
                     has_bias ? fmt::format(", bias {}", metres_text(params.bias.depth.number)) : "",
                     blur.kind == AoBlur::none ? "" : fmt::format(", {0}×{0} {1} blur", taps_of(blur).count, kind));
}

// "mean absolute error 10.645 to 10.752 %, mean signed error +8.974 ± 0.002 %": as many digits in both as the wider
// interval justifies. The interval of the absolute error has no middle to name: noise of the reference only raises it.
struct AoErrorText {
  std::string absolute;
  std::string with_sign;
  bool has_interval = false;
};
// Less is the rounding of equal images, and of rays that all escape.
bool is_measurable(const SampledError& error) { return !(error.mae.upper < 1e-6); }

AoErrorText error_text(const SampledError& error) {
  const Estimate& absolute = error.mae;
  const Estimate& mean = error.mean_error;
  const double width = 50.0 * std::max(absolute.upper - absolute.lower, mean.upper - mean.lower);
  if (!(width > 0.0)) return {percent(absolute.value), with_sign(percent(mean.value))};
  if (!is_measurable(error)) return {"below 0.0001 %", "0.0000 %"};
  const int decimals = decimals_of(width, 2);
  const double half_width = 50.0 * (mean.upper - mean.lower);
  // Far below that of the absolute error it is rounded up, so that it does not read as 0.
  const std::string interval =
      half_width > 0.0 ? fmt::format(" ± {:.{}f}", std::max(half_width, std::pow(10.0, -decimals)), decimals) : "";
  return {fmt::format("{:.{}f} to {:.{}f} %", 100.0 * absolute.lower, decimals, 100.0 * absolute.upper, decimals),
          with_sign(fmt::format("{:.{}f}{} %", 100.0 * mean.value, decimals, interval)), true};
}

// Nothing where the sign is within the interval.
const char* sign_words(const Estimate& error) {
  return error.lower > 0.0 ? ", too bright" : error.upper < 0.0 ? ", too dark" : "";
}

// The mean absolute error of an image of ones.
Estimate without_ao(const Estimate& mean_truth) {
  return {1.0 - mean_truth.value, 1.0 - mean_truth.upper, 1.0 - mean_truth.lower};
}

}  // namespace

std::string ao_radius_text(const AoParams& params) {
  const double radius = params.sampling.radius.number;
  const double reach = reach_of(params);
  return metres_text(radius) + (reach == radius ? "" : ", reach " + metres_text(reach));
}

std::string ao_limit_text(const TruthParams& params) {
  if (!has_distance_limit(params)) return "without distance limit";
  const bool is_endless = std::isinf(umbrameter::reach_of(params));
  return (is_endless ? "without distance limit, fading out beyond " : "up to ") +
         metres_text(params.ao_distance.number);
}

std::string no_ao_text(const Estimate& error, const Estimate& mean_truth, double mean_raster) {
  const Estimate without = without_ao(mean_truth);
  constexpr double hardly = 0.99;  // within 1 % both are about equal
  if (!(error.upper >= hardly * without.lower)) return {};
  // In no pixel do the two errors differ by more than the AO that is drawn.
  const bool draws_hardly_any = 1.0 - mean_raster <= (1.0 - hardly) * without.value;
  const bool is_as_close =
      draws_hardly_any || (error.lower >= hardly * without.upper && hardly * error.upper <= without.lower);
  const bool is_closer = !is_as_close && error.lower > without.upper;
  if (!is_closer && !is_as_close) {
    if (error.upper < without.lower) return {};
    return fmt::format(
        "no AO at all may be as close to the reference, or closer: its error is {}; more rays (--truth.spp) would tell",
        percent(without));
  }
  return fmt::format("no AO at all would be {} to the reference: its error is {}",
                     is_closer ? "closer" : "about as close", percent(without));
}

void add_without_ao(Presentation& presentation, const Estimate& error, const Estimate& mean_truth, double mean_raster,
                    const std::string& where) {
  if (const std::string warning = no_ao_text(error, mean_truth, mean_raster); !warning.empty()) {
    presentation.answers.push_back("warning: " + where + warning);
  } else {
    const std::string text =
        where + "without any AO the mean absolute error would be " + percent(without_ao(mean_truth));
    presentation.lines.push_back("  AO: " + text);
    presentation.section.text += "\n\nAmbient occlusion: " + text + ".";
  }
}

Presentation present_ao(const LayeredImage& layers, const AoMeasurement& ao) {
  const Experiment& experiment = ao.experiment;
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "Ambient occlusion";
  const std::string limit = ao_limit_text(experiment.truth);
  if (ao.truth) {
    add_layer_figure(presentation, layers, Layer::truth_ao, {}, "Reference: ambient occlusion",
                     fmt::format("Hemisphere rays {}, {:.0f} per pixel, {} weight.", limit,
                                 ao.truth->precision.mean_samples, value_text(experiment, "truth.ao-weight")));
  }
  const std::string renderer = renderer_title(experiment);
  const std::string technique = renderer.empty() ? std::string(title_of(make_technique(experiment.ao))) : renderer;
  add_layer_figure(presentation, layers, Layer::raster_ao, {}, technique,
                   renderer.empty() ? ao_technique_text(experiment.ao) : "As the engine or the file gives it.");
  if (ao.truth) {
    section.text = precision_text(ao.truth->precision, experiment.truth);
    presentation.details.push_back("AO: " + offset_text(ao.truth->statistics));
  }
  if (!ao.statistics) {
    if (ao.truth) {
      presentation.answers.push_back(fmt::format("AO: rays {}; {}", limit, precision_line(ao.truth->precision)));
    }
    return presentation;
  }
  if (ao.statistics->error.pixels == 0) {
    presentation.answers.emplace_back(
        "AO: nothing to measure: all pixels are background; choose another view with --camera");
    section.text += "\n\nNothing to measure: all pixels are background.";
    return presentation;
  }
  const SampledError& s = ao.statistics->error;
  add_layer_figure(presentation, layers, Layer::error_ao, {}, "Error: ambient occlusion", error_caption);
  const AoErrorText text = error_text(s);
  section.headlines = {
      {"mean absolute error", text.absolute, fmt::format("of {} pixels", grouped(s.pixels))},
      {"RMS error", percent(s.rmse), "corrected for the reference's variance"},
      {"mean signed error", is_measurable(s) ? with_sign(percent(s.mean_error)) : text.with_sign, "below 0: too dark"},
  };
  section.text += "\n\n";
  if (renderer.empty()) {
    section.text += reaches_text(experiment.ao, limit);
  } else {
    section.text += fmt::format("The reference looks for occluders {}{}.", limit,
                                limit == "up to " + metres_text(experiment.ao.sampling.radius.number)
                                    ? ", as our ao.radius does; set truth.ao-distance to the reach of " + renderer
                                    : "");
  }
  section.text += noise_note;
  section.tables = {statistics_table("Ambient occlusion error", *ao.statistics)};
  add_metrics_table(section, ao.metrics);
  const std::string of = renderer.empty() ? technique + " radius " + ao_radius_text(experiment.ao) : renderer;
  presentation.answers.push_back(fmt::format(
      "AO: mean absolute error {}, mean signed error {}{} ({}{}, reference rays {})", text.absolute, text.with_sign,
      sign_words(s.mean_error), text.has_interval ? "95 % intervals, for the noise of the rays; " : "", of, limit));
  add_without_ao(presentation, s.mae, s.mean_truth, s.mean_raster);
  return presentation;
}

}  // namespace umbrameter
