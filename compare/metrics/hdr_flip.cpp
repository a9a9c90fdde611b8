#include "compare/metrics/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/metrics/color_space.h"
#include "compare/metrics/flip.h"
#include "core/error.h"
#include "core/lists.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

// (a x² + b x) / (c x² + d x + e): Narkowicz, ACES Filmic Tone Mapping Curve, 2015, with x scaled by 0.6.
constexpr double curve_a = 0.36 * 2.51;
constexpr double curve_b = 0.6 * 0.03;
constexpr double curve_c = 0.36 * 2.43;
constexpr double curve_d = 0.6 * 0.59;
constexpr double curve_e = 0.14;
constexpr double almost_white = 0.85;  // t of the paper, section 3

// The value that the curve maps to almost_white: the larger root of its quadratic equation.
double value_of_almost_white() {
  const double a = curve_a - almost_white * curve_c;
  const double half_b = 0.5 * (curve_b - almost_white * curve_d);
  const double c = -almost_white * curve_e;
  return (-half_b + std::sqrt(half_b * half_b - a * c)) / a;
}

double upper_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Image<vec3> tone_mapped(const Image<vec3>& image, double exposure) {
  Image<vec3> result(image.width, image.height);
  const double scale = std::exp2(exposure);
  const auto width = static_cast<std::size_t>(image.width);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const dvec3 color = scale * dvec3(image[i]);
      result[i] = glm::clamp(dvec3(aces(color.x), aces(color.y), aces(color.z)), 0.0, 1.0);
    }
  });
  return result;
}

}  // namespace

double aces(double value) {
  return (curve_a * value + curve_b) * value / ((curve_c * value + curve_d) * value + curve_e);
}

ExposureRange exposure_range(const Image<vec3>& reference, const ColorMetricParams& params) {
  ExposureRange range;
  if (!params.start_exposure || !params.stop_exposure) {
    std::vector<double> luminances = mapped(reference.pixels, [](const vec3& color) { return luminance(color); });
    const double brightest = luminances.empty() ? 0.0 : *std::ranges::max_element(luminances);
    if (brightest > 0.0) {
      double median = upper_median(luminances);
      if (median <= 0.0) {
        std::erase_if(luminances, [](double value) { return value <= 0.0; });
        median = upper_median(luminances);
      }
      range.start = std::log2(value_of_almost_white() / brightest);
      range.stop = std::log2(value_of_almost_white() / median);
    }
  }
  range.start = params.start_exposure.value_or(range.start);
  range.stop = params.stop_exposure.value_or(range.stop);
  if (range.start > range.stop) {
    throw Error(ExitCode::usage, "exposures " + std::to_string(range.start) + " to " + std::to_string(range.stop),
                "the start is after the stop", "set both");
  }
  range.count =
      params.exposures > 0 ? params.exposures : std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
  return range;
}

const Metric hdr_flip_metric = {
    .name = "hdr-flip",
    .title = "HDR-FLIP",
    .unit = "1",
    .range = "0 to 1, 0 is equal",
    .formula = "mean of the largest LDR-FLIP error of each pixel over the exposures, tone-mapped with the ACES curve",
    .source = "Andersson et al., Visualizing Errors in Rendered High Dynamic Range Images, 2021",
    .measure_color = [](const ColorInput& input) {
      const ExposureRange range = exposure_range(input.reference, input.params);
      Image<float> worst(input.test.width, input.test.height);
      for (int i = 0; i < range.count; ++i) {
        const double share = range.count > 1 ? static_cast<double>(i) / (range.count - 1) : 0.0;
        const double exposure = range.start + share * (range.stop - range.start);
        const Image<float> map = flip_map(tone_mapped(input.test, exposure), tone_mapped(input.reference, exposure),
                                          input.params.pixels_per_degree);
        for (std::size_t p = 0; p < map.size(); ++p) worst[p] = std::max(worst[p], map[p]);
      }
      MetricResult result = mean_of_map(std::move(worst), input.is_counted);
      result.details = {{"start_exposure", range.start}, {"stop_exposure", range.stop}, {"exposures", range.count}};
      return result;
    }};

}  // namespace umbrameter
