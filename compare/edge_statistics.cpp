#include "compare/edge_statistics.h"

#include <cmath>

namespace umbrameter {
EdgeStatistics analyze_edges(const ShapeInput& input, const Image<float>& technique, const ErrorShape& shape) {
  const TruthCounts counts = count_truth(input.truth, input.counted);
  EdgeStatistics statistics;
  statistics.pixels = counts.pixels;
  statistics.mean_texel = counts.mean_texel;
  if (counts.pixels == 0) return statistics;
  const auto pixels = static_cast<double>(counts.pixels);
  statistics.lit = static_cast<double>(counts.lit) / pixels;
  statistics.blocked = static_cast<double>(counts.pixels - counts.lit) / pixels;
  double absolute = 0.0;
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < technique.size(); ++i) {
    if (input.counted.exclusion[i] != PixelExclusion::none) continue;
    const double error = static_cast<double>(technique[i]) - static_cast<double>(input.truth[i]);
    absolute += std::abs(error);
    squares += error * error;
    sum += error;
    if (!(std::abs(error) > statistics.max_error)) continue;
    statistics.max_error = std::abs(error);
    statistics.max_x = static_cast<int>(i % static_cast<std::size_t>(technique.width));
    statistics.max_y = static_cast<int>(i / static_cast<std::size_t>(technique.width));
  }
  statistics.mae = absolute / pixels;
  statistics.rmse = std::sqrt(squares / pixels);
  statistics.mean_error = sum / pixels;
  const EdgeDistances& dark = shape.parts[0];
  const EdgeDistances& bright = shape.parts[1];
  const double too_dark = 0.5 * (statistics.mae - statistics.mean_error);
  const double too_bright = 0.5 * (statistics.mae + statistics.mean_error);
  statistics.too_dark_at_edge = too_dark * dark.at_edge;
  statistics.too_dark_away = too_dark - statistics.too_dark_at_edge;
  statistics.too_bright_at_edge = too_bright * bright.at_edge;
  statistics.too_bright_away = too_bright - statistics.too_bright_at_edge;
  return statistics;
}

Statistics describe(EdgeStatistics& s) {
  const char* label = "% of counted pixels";
  const auto curve = [&](const char* title) {
    return CurveDescription{title, std::string(title) + " [" + label + "]"};
  };
  return StatisticsDescription()
      .field("pixels", s.pixels, "px", "counted pixels: they face the light and lie inside its map, cone and range")
      .share("lit", s.lit, "share lit in the reference")
      .share("blocked", s.blocked, "share blocked in the reference")
      .share("mae", s.mae, "mean absolute error of visibility",
             {"Mean absolute error of visibility", "mean absolute error [% of counted pixels]", true})
      .field("rmse", s.rmse, "1", "RMS error of visibility")
      .share("too_dark_away", s.too_dark_away,
             "too dark, more than 2 texels from a shadow edge and not beside it: like acne",
             curve("Too dark away from edges"))
      .share("too_dark_at_edge", s.too_dark_at_edge,
             "too dark, at most 2 texels from a shadow edge or in a pixel beside it", curve("Too dark at edges"))
      .share("too_bright_at_edge", s.too_bright_at_edge,
             "too bright, at most 2 texels from a shadow edge or in a pixel beside it", curve("Too bright at edges"))
      .share("too_bright_away", s.too_bright_away,
             "too bright, more than 2 texels from a shadow edge and not beside it: light bleeding, shadow lost to the "
             "bias, a wide blur, or casters out of reach of screen-space shadows",
             curve("Too bright away from edges"))
      .field("mean_error", s.mean_error, "1", "mean signed error, technique − reference")
      .field("max_error", s.max_error, "1", "largest absolute error")
      .field("mean_texel", s.mean_texel, "m", mean_texel_meaning)
      .take();
}

}  // namespace umbrameter
