#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/metrics/edge_points.h"

namespace umbrameter {
namespace {

// A map of a value of the found points, and the details that all metrics of edges report.
MetricResult measure_points(const MetricInput& input, const std::vector<EdgePoint>& points,
                            const std::vector<double>& values) {
  Image<float> map(input.reference.width, input.reference.height, std::numeric_limits<float>::quiet_NaN());
  double found = 0.0;
  double width = 0.0;
  double reference_width = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_found) continue;
    ++found;
    width += points[i].width;
    reference_width += points[i].reference_width;
    map[points[i].pixel] = static_cast<float>(values[i]);
  }
  MetricResult result = mean_of_map(std::move(map), [](std::size_t) { return true; });
  result.details = {{edges_of_reference, static_cast<double>(points.size())},
                    {edges_used, found / static_cast<double>(points.size())},
                    {"mean width of the edge there, in TEST [px]", width / found},
                    {"mean width of the edge there, in REFERENCE [px]", reference_width / found}};
  return result;
}

// The lengths of the points in px, or in another unit by a factor for each.
using Values = std::vector<double> (*)(const std::vector<EdgePoint>& points, const std::vector<double>& factors);

MetricResult measure_lengths(const MetricInput& input, const std::vector<EdgePoint>& points, Values values_of) {
  MetricResult result = measure_points(input, points, values_of(points, std::vector<double>(points.size(), 1.0)));
  if (!input.edge_scale) return result;
  std::vector<double> texels(points.size(), 0.0);
  std::vector<double> metres(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_found) continue;
    const LengthFactors factors = input.edge_scale(points[i].pixel, points[i].tangent);
    texels[i] = factors.texels;
    metres[i] = factors.metres;
  }
  for (const std::vector<double>& factors : {texels, metres}) {
    result.in_other_units.push_back(measure_points(input, points, values_of(points, factors)).score);
  }
  return result;
}

MetricResult measure_displacement(const MetricInput& input) {
  return measure_lengths(input, find_edge_points(input), [](const auto& points, const auto& factors) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) values.push_back(factors[i] * points[i].displacement);
    return values;
  });
}

// The squares of the distances from the mean of each edge.
std::vector<double> squares_about_mean(const std::vector<EdgePoint>& points, const std::vector<double>& factors) {
  struct Sum {
    double displacement = 0.0;
    double count = 0.0;
  };
  std::vector<Sum> sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sums.size() <= points[i].edge) sums.resize(points[i].edge + 1);
    if (!points[i].is_found) continue;
    sums[points[i].edge].displacement += factors[i] * points[i].displacement;
    ++sums[points[i].edge].count;
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Sum& sum = sums[points[i].edge];
    const double about = factors[i] * points[i].displacement - sum.displacement / std::max(sum.count, 1.0);
    values.push_back(about * about);
  }
  return values;
}

MetricResult measure_roughness(const MetricInput& input) {
  std::vector<EdgePoint> points = find_edge_points(input);
  std::vector<std::size_t> counts;
  for (const EdgePoint& point : points) {
    if (counts.size() <= point.edge) counts.resize(point.edge + 1);
    if (point.is_found) ++counts[point.edge];
  }
  for (EdgePoint& point : points) point.is_found = point.is_found && counts[point.edge] >= fewest_edge_points;
  MetricResult result = measure_lengths(input, points, squares_about_mean);
  result.score = std::sqrt(result.score);
  for (double& score : result.in_other_units) score = std::sqrt(score);
  return result;
}

MetricResult measure_width(const MetricInput& input) {
  return measure_lengths(input, find_edge_points(input), [](const auto& points, const auto& factors) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      values.push_back(factors[i] * (points[i].width - points[i].reference_width));
    }
    return values;
  });
}

// Of the points that the reference shows so clearly that they would be found in itself.
MetricResult measure_found(const MetricInput& input) {
  Image<float> map(input.reference.width, input.reference.height, std::numeric_limits<float>::quiet_NaN());
  const MetricInput itself{input.reference, input.reference, input.is_counted};
  const std::vector<EdgePoint> all = find_edge_points(itself);
  for (const EdgePoint& point : all) {
    if (point.is_found) map[point.pixel] = 0.0f;
  }
  for (const EdgePoint& point : find_edge_points(input)) {
    if (point.is_found && !std::isnan(map[point.pixel])) map[point.pixel] = 1.0f;
  }
  MetricResult result = mean_of_map(std::move(map), [](std::size_t) { return true; });
  const auto clear = std::ranges::count_if(all, &EdgePoint::is_found);
  result.details = {
      {edges_of_reference, static_cast<double>(all.size())},
      {"share of these that counts in REFERENCE", static_cast<double>(clear) / static_cast<double>(all.size())}};
  return result;
}

// In the order of LengthFactors.
constexpr std::array<std::string_view, 2> edge_units = {"texels", "m"};

}  // namespace

const Metric edge_displacement_metric = {"edge-displacement",
                                         "mean displacement of edges",
                                         "px",
                                         "of either sign; 0 is in place, above 0 shadows are larger",
                                         "mean over the reference's edges of how far they moved into the light",
                                         "slanted-edge analysis as in ISO 12233, here by the light under each row",
                                         false,
                                         measure_displacement,
                                         ColorRule::display_luma,
                                         nullptr,
                                         edge_units};

const Metric edge_roughness_metric = {"edge-roughness",
                                      "roughness of edges",
                                      "px",
                                      "0 and up, 0 is as straight as the reference",
                                      "RMS of the displacement about the mean of each connected edge",
                                      "line edge roughness as in SEMI P47, about the reference's edge",
                                      false,
                                      measure_roughness,
                                      ColorRule::display_luma,
                                      nullptr,
                                      edge_units};

const Metric edge_width_metric = {"edge-width",
                                  "change of the width of penumbrae",
                                  "px",
                                  "of either sign; 0 is as wide as the reference, above 0 is softer",
                                  "mean over the reference's edges of the width of a linear ramp with the slope of the "
                                  "middle of the penumbra, less the "
                                  "reference's",
                                  "edge width as in ISO 12233's edge spread",
                                  false,
                                  measure_width,
                                  ColorRule::display_luma,
                                  nullptr,
                                  edge_units};

const Metric edges_found_metric = {.name = "edges-found",
                                   .title = "share of the reference's edge points that were found",
                                   .unit = "1",
                                   .range = "0 to 1, 1 is all of them",
                                   .formula =
                                       "edge points at which both images have an edge, of those that the "
                                       "reference shows clearly enough to be found in itself",
                                   .source = "what the other metrics of edges are means over",
                                   .is_higher_better = true,
                                   .measure = measure_found,
                                   .color_rule = ColorRule::display_luma};

}  // namespace umbrameter
