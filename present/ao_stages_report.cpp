#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "present/presentation_parts.h"

namespace umbrameter {
namespace {

constexpr std::array<const char*, ao_stage_count> meanings = {
    "The method's own radius, falloff and weight on the full geometry, instead of the requested reference.",
    "Occluders outside the view vanish.",
    "Occluders inside the view that no pixel sees vanish.",
    "Everything behind the visible surface counts as solid, as thick as the method assumes.",
    "The method with so many samples that no noise is left, instead of the exact integral over the same depth buffer.",
    "The method's own number of samples, without blur.",
    "The method's blur.",
};

// "the method's blur".
std::string within_a_sentence(std::string meaning) {
  meaning.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(meaning.front())));
  meaning.pop_back();
  return meaning;
}

std::string signed_text(double share) { return with_sign(share_text(share)); }
std::string signed_text(const Estimate& share) { return with_sign(share_text(share)); }

ReportTable stages_table(const AoStageStatistics& statistics) {
  Table table{{{"stage", "", ""},
               {"mean", "%", "with its 95 % interval"},
               {"RMS", "%", ""},
               {"mean, sRGB", "%", "of encoded accessibility"},
               {"meaning", "", ""}},
              {}};
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const AoStageError& stage = statistics.stages[k];
    table.rows.push_back({std::string(ao_stage_titles[k]), signed_text(stage.mean), share_text(stage.rms.value),
                          signed_text(stage.srgb_mean), std::string(meanings[k])});
  }
  const SampledError& total = statistics.total;
  table.rows.push_back({std::string("total"), signed_text(total.mean_error), share_text(total.rmse.value),
                        signed_text(statistics.srgb_mean_error), std::string("Technique − reference.")});
  return {"Error by stage", std::move(table)};
}

struct SplitTitle {
  std::string_view name;
  const char* title;
};
constexpr SplitTitle split_titles[] = {
    {"depth", "depth"},
    {"cosine_to_viewer", "N·V"},
    {"depth_edge_distance", "distance to a depth edge"},
    {"image_edge_distance", "distance to the image's edge"},
    {"error", "error"},
};

std::string range_text(const AoStageBin& bin) {
  const bool is_share = bin.split == "error";  // in per cent, as the columns beside it
  const std::string unit = is_share ? " %" : bin.unit == "1" ? "" : " " + bin.unit;
  const auto number = [&](double end) { return with_minus(fmt::format("{:.4g}", is_share ? 100.0 * end : end)); };
  const bool is_open_above = std::isinf(bin.last) || (bin.split == "cosine_to_viewer" && bin.last > 1.0);
  if (std::isinf(bin.first)) return fmt::format("below {}{}", number(bin.last), unit);
  if (is_open_above) return fmt::format("{}{} and more", number(bin.first), unit);
  return fmt::format("{} to {}{}", number(bin.first), number(bin.last), unit);
}

ReportTable splits_table(const std::vector<AoStageBin>& bins) {
  Table table{{{"pixels by", "", ""}, {"range", "", ""}, {"pixels", "px", ""}, {"total", "%", ""}}, {}};
  for (const std::string_view title : ao_stage_titles) table.columns.push_back({std::string(title), "%", ""});
  for (const AoStageBin& bin : bins) {
    if (bin.statistics.total.pixels == 0) continue;
    std::string title = bin.split;
    for (const SplitTitle& split : split_titles) {
      if (split.name == bin.split) title = split.title;
    }
    std::vector<Value> row = {title, range_text(bin), static_cast<std::int64_t>(bin.statistics.total.pixels),
                              signed_text(bin.statistics.total.mean_error.value)};
    for (const AoStageError& stage : bin.statistics.stages) row.emplace_back(signed_text(stage.mean.value));
    table.rows.push_back(std::move(row));
  }
  return {"Signed means of the stages in parts of the image", std::move(table)};
}

}  // namespace

WaterfallFigure ao_stages_waterfall(const AoStageStatistics& statistics) {
  WaterfallFigure figure;
  figure.stem = "ao_stages";
  figure.title = "Ambient occlusion: error by stage";
  figure.caption =
      "Signed means over all surface pixels; black lines are 95 % intervals. Opposite signs cancel in a mean: compare "
      "with the RMS below each stage.";
  figure.label = "technique − reference, accessibility [%]";
  figure.below = "darkens";
  figure.above = "brightens";
  const auto step = [](std::string name, const Estimate& mean, const Estimate& rms) {
    return WaterfallStep{std::move(name), "RMS " + share_text(rms.value), 100.0 * mean.value, 100.0 * mean.lower,
                         100.0 * mean.upper};
  };
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const AoStageError& stage = statistics.stages[k];
    figure.steps.push_back(step(std::string(ao_stage_titles[k]), stage.mean, stage.rms));
  }
  figure.total = step("total", statistics.total.mean_error, statistics.total.rmse);
  return figure;
}

void add_ao_stage_figures(Presentation& presentation, const LayeredImage& layers) {
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    add_layer_figure(presentation, layers, layer_of(static_cast<AoStage>(k)), {},
                     "AO stage: " + std::string(ao_stage_titles[k]),
                     std::string(meanings[k]) + " Blue darkens, red brightens.");
  }
}

Presentation present_ao_stages(const LayeredImage& layers, const AoMeasurement& ao) {
  const AoStages& stages = *ao.stages;
  const AoStageStatistics& statistics = stages.statistics;
  Presentation presentation;
  ReportSection& section = presentation.section;
  section.title = "Ambient occlusion: why it is wrong";
  if (statistics.total.pixels == 0) {
    section.text = "Nothing to measure: all pixels are background.";
    return presentation;
  }
  section.text = fmt::format(
      "Each stage changes one thing on the way from the reference to the technique's result. The signed means of the "
      "stages add up to the total.\n\nThe method's integral: {}.\n\nThe stages from 'model' to 'thin' use the same "
      "rays, {} per pixel. Means are of accessibility, in per cent; images show it from 0 to 1. The stage "
      "'approximation' shows the mean of {} draws with at least 1024 samples each.",
      stages.integral, ao.experiment.truth.spp, stages.many_draws);
  WaterfallFigure waterfall = ao_stages_waterfall(statistics);
  waterfall.conditions = fmt::format("{}, radius {}, reference rays {}", title_of(make_technique(ao.experiment.ao)),
                                     ao_radius_text(ao.experiment.ao), ao_limit_text(ao.experiment.truth));
  add_figure(presentation, std::move(waterfall));
  add_ao_stage_figures(presentation, layers);
  section.headlines = {
      {"mean signed error", with_sign(percent(statistics.total.mean_error.value)), "sum of the stages"},
      {"sRGB PSNR", fmt::format("{:.2f} dB", statistics.srgb_psnr), "of encoded accessibility, peak 1"},
  };
  section.tables = {stages_table(statistics), splits_table(stages.bins)};
  std::size_t largest = 0;
  for (std::size_t k = 1; k < ao_stage_count; ++k) {
    if (statistics.stages[k].rms.value > statistics.stages[largest].rms.value) largest = k;
  }
  const AoStageError& most = statistics.stages[largest];
  const double total = statistics.total.rmse.value;
  presentation.lines.push_back(fmt::format(
      "AO by stage: '{}' ({}) has the largest RMS, {} (mean {}){}; all stages together: RMS {}",
      ao_stage_titles[largest], within_a_sentence(meanings[largest]), percent(most.rms.value),
      with_sign(percent(most.mean.value)),
      most.rms.value > std::max(total, statistics.total.rmse.upper) ? ", partly undone by other stages" : "",
      percent(total)));
  return presentation;
}

}  // namespace umbrameter
