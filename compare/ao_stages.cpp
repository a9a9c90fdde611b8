#include "compare/ao_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_space.h"
#include "compare/shadow_edges.h"

namespace umbrameter {
namespace {

double encoded(float accessibility) {
  return srgb_from_linear(std::clamp(static_cast<double>(accessibility), 0.0, 1.0));
}

// Of the sRGB transfer function; where it is cut, 0.
double encoded_slope(float accessibility) {
  constexpr double h = 1e-4;
  const auto value = static_cast<double>(accessibility);
  const auto at = [](double x) { return srgb_from_linear(std::clamp(x, 0.0, 1.0)); };
  return (at(value + h) - at(value - h)) / (2.0 * h);
}

// Means over the counted pixels, of each image sRGB-encoded, and the squared error of the last.
void add_srgb(AoStageStatistics& statistics, const AoStageImages& images, const IsCounted& is_counted) {
  std::array<double, ao_stage_count + 1> sums{};
  double squares = 0.0;
  double variance = 0.0;
  const Image<float>& reference = images.accessibility.front();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (!is_counted(i)) continue;
    for (std::size_t k = 0; k <= ao_stage_count; ++k) sums[k] += encoded(images.accessibility[k][i]);
    const double error = encoded(images.accessibility.back()[i]) - encoded(reference[i]);
    squares += error * error;
    if (images.reference_variance.empty()) continue;
    const double slope = encoded_slope(reference[i]);
    variance += slope * slope * static_cast<double>(images.reference_variance[i]);
  }
  const auto pixels = static_cast<double>(statistics.total.pixels);
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    statistics.stages[k].srgb_mean = (sums[k + 1] - sums[k]) / pixels;
  }
  statistics.srgb_mean_error = (sums.back() - sums.front()) / pixels;
  statistics.srgb_mse = std::max(squares - variance, 0.0) / pixels;
  statistics.srgb_psnr = -10.0 * std::log10(statistics.srgb_mse);
}

double cosine_to_viewer(const GBuffer& gbuffer, const View& view, std::size_t i) {
  return glm::dot(dvec3(gbuffer.geometric_normal[i]), to_viewer(view, dvec3(gbuffer.position[i])));
}

Image<float> distance_to_depth_edge(const GBuffer& gbuffer,
                                    const std::function<bool(std::size_t, std::size_t)>& is_joined) {
  ShadowEdges edges{Image<std::uint8_t>(gbuffer.width, gbuffer.height, 0), 0};
  const auto width = static_cast<std::size_t>(gbuffer.width);
  for (int y = 0; y < gbuffer.height; ++y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const std::size_t i = edges.bits.index(x, y);
      if (x + 1 < gbuffer.width && !is_joined(i, i + 1)) edges.bits[i] |= 1u, ++edges.count;
      if (y + 1 < gbuffer.height && !is_joined(i, i + width)) edges.bits[i] |= 2u, ++edges.count;
    }
  }
  return nearest_edges(edges).distance;
}

Image<float> distance_to_image_edge(const GBuffer& gbuffer) {
  Image<float> distance(gbuffer.width, gbuffer.height);
  for (int y = 0; y < gbuffer.height; ++y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const int pixels = std::min({x, y, gbuffer.width - 1 - x, gbuffer.height - 1 - y});
      distance.at(x, y) = static_cast<float>(pixels) + 0.5f;
    }
  }
  return distance;
}

struct Split {
  const char* name;
  const char* unit;
  std::vector<double> borders;
  Image<float> values;
  bool is_by_result = false;  // `values` are measured with the noise of the reference
};

// Noise that selects pixels has no mean of 0 in them, so that intervals of its variance do not hold the truth.
void forget_intervals(AoStageStatistics& statistics) {
  for (const Statistic& each : describe(statistics)) {
    if (!each.has_interval()) continue;
    Estimate& estimate = *std::get<Estimate*>(each.field);
    estimate.lower = estimate.upper = std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<double> quarters(const GBuffer& gbuffer) {
  std::vector<float> depths;
  for (std::size_t i = 0; i < gbuffer.depth.size(); ++i) {
    if (gbuffer.is_surface(i)) depths.push_back(gbuffer.depth[i]);
  }
  if (depths.empty()) return {};
  std::ranges::sort(depths);
  const auto at = [&](std::size_t quarter) {
    return static_cast<double>(depths[std::min(quarter * depths.size() / 4, depths.size() - 1)]);
  };
  return {at(0), at(1), at(2), at(3), std::nextafter(at(4), std::numeric_limits<double>::infinity())};
}

}  // namespace

Image<float> stage_difference(const AoStageImages& images, AoStage stage) {
  const auto k = static_cast<std::size_t>(stage);
  Image<float> difference = images.accessibility[k + 1];
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= images.accessibility[k][i];
  return difference;
}

Statistics describe(AoStageStatistics& statistics) {
  SampledError& total = statistics.total;
  StatisticsDescription description;
  description.field("pixels", total.pixels, "px", "pixels that see a surface")
      .field("mae", total.mae, "1", with_bounds("mean absolute error of accessibility"))
      .field("rmse", total.rmse, "1", "RMS error, corrected for the variance of the reference")
      .field("mean_error", total.mean_error, "1",
             "mean signed error, technique − reference; the sum of the stages' means")
      .field("too_dark", total.too_dark, "1",
             with_bounds("part of the mean absolute error in pixels that are too dark"))
      .field("too_bright", total.too_bright, "1",
             with_bounds("part of the mean absolute error in pixels that are too bright"))
      .field("srgb_mean_error", statistics.srgb_mean_error, "1", "mean signed error of sRGB-encoded accessibility")
      .field("srgb_mse", statistics.srgb_mse, "1",
             "mean square error of sRGB-encoded accessibility, corrected for the variance of the reference")
      .field("srgb_psnr", statistics.srgb_psnr, "dB",
             "peak signal-to-noise ratio of sRGB-encoded accessibility, for a peak of 1");
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const std::string name(ao_stage_names[k]);
    const std::string title(ao_stage_titles[k]);
    AoStageError& stage = statistics.stages[k];
    description.field((name + "_mean").c_str(), stage.mean, "1", "mean change of accessibility by the stage " + title)
        .field((name + "_rms").c_str(), stage.rms, "1",
               "root mean square change of accessibility by the stage " + title +
                   ", corrected for the variance of the references")
        .field((name + "_srgb_mean").c_str(), stage.srgb_mean, "1",
               "mean change of sRGB-encoded accessibility by the stage " + title);
  }
  return description.take();
}

AoStageStatistics analyze_ao_stages(const AoStageImages& images, const IsCounted& is_counted) {
  AoStageStatistics statistics;
  const auto& after = images.accessibility;
  statistics.total = analyze_sampled(
      after.back(), {after.front(), images.reference_variance, images.reference_samples, images.degrees_of_freedom},
      is_counted);
  if (statistics.total.pixels == 0) return statistics;
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    const SampledError error = analyze_sampled(
        after[k + 1], {after[k], images.variance[k], images.samples[k], images.degrees_of_freedom}, is_counted);
    statistics.stages[k].mean = error.mean_error;
    statistics.stages[k].rms = error.rmse;
  }
  add_srgb(statistics, images, is_counted);
  return statistics;
}

std::vector<AoStageBin> split_ao_stages(const AoStageImages& images, const GBuffer& gbuffer, const View& view,
                                        const std::function<bool(std::size_t, std::size_t)>& is_joined) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Image<float> cosine(gbuffer.width, gbuffer.height, 0.0f);
  Image<float> error(gbuffer.width, gbuffer.height, 0.0f);
  for (std::size_t i = 0; i < cosine.size(); ++i) {
    if (gbuffer.is_surface(i)) cosine[i] = static_cast<float>(cosine_to_viewer(gbuffer, view, i));
    error[i] = images.accessibility.back()[i] - images.accessibility.front()[i];
  }
  const Split splits[] = {
      {"depth", "m", quarters(gbuffer), gbuffer.depth},
      {"cosine_to_viewer", "1", {0.0, 0.25, 0.5, 0.75, infinity}, std::move(cosine)},
      {"depth_edge_distance", "px", {0.0, 2.0, 4.0, 8.0, 16.0, infinity}, distance_to_depth_edge(gbuffer, is_joined)},
      {"image_edge_distance", "px", {0.0, 8.0, 16.0, 32.0, 64.0, infinity}, distance_to_image_edge(gbuffer)},
      {"error", "1", {-infinity, -0.01, 0.01, infinity}, std::move(error), true},
  };
  std::vector<AoStageBin> bins;
  for (const Split& split : splits) {
    for (std::size_t b = 0; b + 1 < split.borders.size(); ++b) {
      const double first = split.borders[b];
      const double last = split.borders[b + 1];
      AoStageStatistics statistics = analyze_ao_stages(images, [&](std::size_t i) {
        const auto value = static_cast<double>(split.values[i]);
        // No edge at all is an infinite distance.
        return gbuffer.is_surface(i) && value >= first && (value < last || (last == infinity && value == infinity));
      });
      if (split.is_by_result) forget_intervals(statistics);
      bins.push_back({split.name, split.unit, first, last, statistics});
    }
  }
  return bins;
}

Table ao_stage_table(const AoStageStatistics& all, const std::vector<AoStageBin>& bins) {
  Table table{{{"split", "", "property that the pixels share; all: every surface pixel"},
               {"unit", "", "of first and last"},
               {"first", "unit", "pixels have at least this value"},
               {"last", "unit", "pixels have less than this value"}},
              {}};
  const std::vector<Column> columns = columns_of(all);
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  const auto add = [&](const AoStageBin& bin) {
    std::vector<Value> row = {bin.split, bin.unit, bin.first, bin.last};
    const std::vector<Value> values = row_of(bin.statistics);
    row.insert(row.end(), values.begin(), values.end());
    table.rows.push_back(std::move(row));
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  add({"all", "1", -infinity, infinity, all});
  for (const AoStageBin& bin : bins) add(bin);
  return table;
}

}  // namespace umbrameter
