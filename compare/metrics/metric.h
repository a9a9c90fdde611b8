// Image metrics. Each computes an error map and a score in one call. To add one: a new file, and its declaration and
// place in the list at the end of this header; NAME.cpp is built because NAME_metric is declared here. color_metric.h
// applies them to colour images.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// By what a length of one pixel across an edge is multiplied to get its other units.
struct LengthFactors {
  double texels = 0.0;  ///< of the light's map
  double metres = 0.0;  ///< along the surface
};

/// For an edge that passes a pixel. `tangent` is its direction in the image, unit, x to the right and y down. NaN where
/// the pixel shows no surface.
using EdgeScale = std::function<LengthFactors(std::size_t pixel, const dvec2& tangent)>;

/// Two images of the same size with values from 0 to 1, and the pixels that count. is_counted() is called from any
/// thread.
struct MetricInput {
  const Image<float>& test;
  const Image<float>& reference;
  std::function<bool(std::size_t)> is_counted;
  EdgeScale edge_scale{};  ///< where a light and its map are known
};

struct MetricResult {
  double score = 0.0;  ///< NaN if no pixel counts
  Image<float> map;    ///< the contribution of each pixel; NaN if it does not count
  /// What the metric chose by itself, name and value: the exposures of HDR-FLIP.
  std::vector<std::pair<std::string, double>> details{};
  /// The score in each of Metric::other_units; empty without MetricInput::edge_scale.
  std::vector<double> in_other_units{};
};

/// Which values of colour images a metric of scalar images compares.
enum class ColorRule {
  values,            ///< all values of the three channels, as the files store them
  display_values,    ///< all values of the three channels as sRGB code values, 0 to 1
  display_channels,  ///< each channel as an image of sRGB code values; score and map are the means of the three
  display_luma,      ///< one image: 0.299 R + 0.587 G + 0.114 B of the sRGB code values (ITU-R BT.601)
};

struct ColorInput;

struct Metric {
  std::string_view name;     ///< name in keys: "psnr"
  std::string_view title;    ///< "peak signal-to-noise ratio"
  std::string_view unit;     ///< "1", "dB"
  std::string_view range;    ///< "0 to 1, 0 is equal"
  std::string_view formula;  ///< formula of the score
  std::string_view source;   ///< publication that defines it
  bool is_higher_better = false;
  MetricResult (*measure)(const MetricInput& input) = nullptr;       ///< null where it needs colour
  ColorRule color_rule = ColorRule::values;                          ///< where measure is given
  MetricResult (*measure_color)(const ColorInput& input) = nullptr;  ///< where measure is null
  std::span<const std::string_view> other_units{};                   ///< "texels", "m"
};

/// The name of a metric's score in one of its other units: "edge-roughness-texels".
std::string name_in_unit(const Metric& metric, std::string_view unit);

/// The metrics of scalar images.
std::span<const Metric> metrics();

/// The names of metrics: "mae, rmse".
std::string metric_names(std::span<const Metric> all = metrics());

/// The metrics of a comma-separated list of names. For an unknown name, throws Error (usage) that names the option and
/// the known metrics.
std::vector<const Metric*> select_metrics(std::string_view names, std::span<const Metric> all = metrics(),
                                          const std::string& option = "run.metrics");

/// Applies a function of test and reference to every counted pixel. The score is its mean.
MetricResult mean_of_pixels(const MetricInput& input, double (*of_pixel)(double test, double reference));

/// The score is the mean of the counted pixels whose value is not NaN. Other pixels become NaN.
MetricResult mean_of_map(Image<float> map, const std::function<bool(std::size_t)>& is_counted);

extern const Metric mae_metric;
extern const Metric rmse_metric;
extern const Metric mse_metric;
extern const Metric relative_rmse_metric;
extern const Metric psnr_metric;
extern const Metric ssim_metric;
extern const Metric ssim_uniform_metric;
extern const Metric ms_ssim_metric;
extern const Metric edge_displacement_metric;
extern const Metric edge_roughness_metric;
extern const Metric edge_width_metric;
extern const Metric edges_found_metric;
/// Points of an edge that has a roughness.
inline constexpr std::size_t fewest_edge_points = 8;
/// An edge point counts in an image that passes from below 0.1 to above 0.9 there and at enough of the points of its
/// edge in the next lines on either side: from these its direction is known.
inline constexpr int edge_lines = 3;         ///< on either side
inline constexpr int fewest_edge_lines = 4;  ///< of 2 · edge_lines + 1
/// Details of the metrics of edges. Their means use the points that count in both images.
inline constexpr const char* edges_of_reference = "edge points of REFERENCE";
inline constexpr const char* edges_used = "share of these that is used";
extern const Metric ldr_flip_metric;
extern const Metric hdr_flip_metric;

/// All of them, those of scalar images first.
inline std::vector<Metric> listed_metrics() {
  return {mae_metric,        mse_metric,          rmse_metric,     relative_rmse_metric,     psnr_metric,
          ssim_metric,       ssim_uniform_metric, ms_ssim_metric,  edge_displacement_metric, edge_roughness_metric,
          edge_width_metric, edges_found_metric,  ldr_flip_metric, hdr_flip_metric};
}

}  // namespace umbrameter
