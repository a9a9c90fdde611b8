#include "compare/image_error.h"

#include <cmath>
#include <vector>

#include "compare/metrics/color_space.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

struct RowSums {
  std::uint64_t pixels = 0;
  std::uint64_t near_edges = 0;
  double error = 0.0;
  double off_edges = 0.0;
  std::array<double, image_cause_count> replaced{};
};

double absolute_error(const Image<float>& image, const Image<float>& truth, std::size_t i) {
  return std::abs(static_cast<double>(image[i]) - static_cast<double>(truth[i]));
}

RowSums sum_row(const ImageErrorInput& input, std::size_t first, std::size_t end) {
  RowSums sums;
  for (std::size_t i = first; i < end; ++i) {
    if (!input.gbuffer.is_surface(i)) continue;
    const double error = absolute_error(input.raster, input.truth.value, i);
    const bool is_near = input.edge_distance[i] <= edge_reach_px;
    ++sums.pixels;
    sums.near_edges += is_near ? 1 : 0;
    sums.error += error;
    if (!is_near) sums.off_edges += error;
    for (std::size_t c = 0; c < image_cause_count; ++c) {
      sums.replaced[c] += absolute_error(*input.replaced[c], input.truth.value, i);
    }
  }
  return sums;
}

}  // namespace

Image<float> luminance(const Image<vec3>& image, float exposure) {
  Image<float> values(image.width, image.height);
  for (std::size_t i = 0; i < image.size(); ++i) values[i] = exposure * static_cast<float>(luminance(image[i]));
  return values;
}

ImageStatistics analyze_image(const ImageErrorInput& input) {
  ImageStatistics statistics;
  statistics.error =
      analyze_sampled(input.raster, input.truth, [&](std::size_t i) { return input.gbuffer.is_surface(i); });
  const auto width = static_cast<std::size_t>(input.gbuffer.width);
  std::vector<RowSums> rows(static_cast<std::size_t>(input.gbuffer.height));
  parallel_for(rows.size(), [&](std::size_t y) { rows[y] = sum_row(input, y * width, (y + 1) * width); });
  RowSums all;
  for (const RowSums& row : rows) {
    all.pixels += row.pixels;
    all.near_edges += row.near_edges;
    all.error += row.error;
    all.off_edges += row.off_edges;
    for (std::size_t c = 0; c < image_cause_count; ++c) all.replaced[c] += row.replaced[c];
  }
  if (all.pixels == 0) return statistics;
  const auto pixels = static_cast<double>(all.pixels);
  statistics.near_edges = static_cast<double>(all.near_edges) / pixels;
  // Not a number if all pixels are near edges: nothing is known of the others.
  statistics.mae_off_edges = all.off_edges / (pixels - static_cast<double>(all.near_edges));
  for (std::size_t c = 0; c < image_cause_count; ++c) statistics.parts[c] = (all.error - all.replaced[c]) / pixels;
  return statistics;
}

Image<std::uint8_t> classify_image(const ImageErrorInput& input, float threshold) {
  Image<std::uint8_t> causes(input.gbuffer.width, input.gbuffer.height, no_image_cause);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    if (!input.gbuffer.is_surface(i)) continue;
    if (absolute_error(input.raster, input.truth.value, i) < static_cast<double>(threshold)) continue;
    double largest = -1.0;
    for (std::size_t c = 0; c < image_cause_count; ++c) {
      const double change = absolute_error(*input.replaced[c], input.raster, i);
      if (change <= largest) continue;
      largest = change;
      causes[i] = static_cast<std::uint8_t>(c);
    }
  }
  return causes;
}

Statistics describe(ImageStatistics& s) {
  const CurveDescription mae{"Mean absolute error of the image", "mean absolute error [% of white], bounds"};
  return StatisticsDescription()
      .field("pixels", s.error.pixels, "px", "pixels that see a surface")
      .field("mae", s.error.mae, "1", with_bounds("mean absolute error of linear luminance × exposure; 1 is white"),
             mae)
      .field("rmse", s.error.rmse, "1", "RMS error, corrected for the variance of the reference",
             {"RMS error of the image", "RMS error [% of white], 95 % interval"})
      .field("mean_error", s.error.mean_error, "1", "mean signed error, technique − reference")
      .field("mae_off_edges", s.mae_off_edges, "1",
             "mean absolute error of the pixels farther than 3 px from every edge of a hard shadow")
      .share("near_edges", s.near_edges, "share of the pixels within 3 px of an edge of a light's hard shadow")
      .field("shadows", s.parts[0], "1", "error removed by using the reference's visibility",
             {"Error from shadows", "mean absolute error from shadows [% of white]"})
      .field("ao", s.parts[1], "1", "error removed by using the reference's ambient occlusion",
             {"Error from ambient occlusion", "mean absolute error from AO [% of white]"})
      .field("gbuffer", s.parts[2], "1", "error removed by using the exact surfels",
             {"Error from the G-buffer", "mean absolute error from the G-buffer [% of white]"})
      .field("shading", s.parts[3], "1", "error removed by evaluating the light model on the CPU")
      .field("gbuffer_visibility", s.gbuffer_visibility, "1",
             "mean absolute change of visibility by the G-buffer, over pixels and lights")
      .field("gbuffer_ao", s.gbuffer_ao, "1", "mean absolute change of accessibility by the G-buffer")
      .field("gbuffer_image", s.gbuffer_image, "1", "mean absolute change of the image by the G-buffer")
      .field("max_error", s.error.max_error, "1", "largest absolute error, including the noise of the reference")
      .take();
}

}  // namespace umbrameter
