#include "compare/error_shape.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

#include "compare/soft_visibility.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

using Weights = std::array<float, cause_count>;  // of the parts; those that are not there are 0

struct WrongPixel {
  std::array<float, 3> distance{};  // px, texels, metres
  Weights weights{};
};
constexpr std::size_t unit_count = 3;

bool is_at_edge(const WrongPixel& pixel) {
  return pixel.distance[1] <= edge_band_texels || pixel.distance[0] <= edge_band_px;
}

std::array<float, unit_count> distances_at(const ShapeInput& input, const NearestEdges& nearest, std::size_t pixel) {
  const dvec3 edge = position_of(nearest.edge[pixel], input.gbuffer);
  const dvec3 way = dvec3(input.gbuffer.position[pixel]) - edge;
  const dvec3 light = to_light(input.light, edge);
  const dvec3 across = way - glm::dot(way, light) * light;
  const double texel = texel_at(input.layout, edge);
  const double texels = texel > 0.0 ? glm::length(across) / texel : 0.0;
  return {nearest.distance[pixel], static_cast<float>(texels), static_cast<float>(glm::length(way))};
}

struct Placed {
  float distance = 0.0f;  // in one of the units
  Weights weights{};
};

// The pixels by rising distance, equal ones as they were. A float that is not negative rises with its bits: sorted by
// their eleven lowest, the next, and the rest (Knuth, The Art of Computer Programming 3, 5.2.5, algorithm R).
std::vector<Placed> by_distance(const std::vector<WrongPixel>& wrong, std::size_t unit) {
  constexpr std::uint32_t digit_bits = 11;
  struct Keyed {
    std::uint32_t key = 0;
    std::uint32_t pixel = 0;
  };
  std::vector<Keyed> from(wrong.size());
  for (std::uint32_t i = 0; i < from.size(); ++i) from[i] = {std::bit_cast<std::uint32_t>(wrong[i].distance[unit]), i};
  std::vector<Keyed> to(from.size());
  for (std::uint32_t shift = 0; shift < 32; shift += digit_bits) {
    const auto digit = [shift](const Keyed& keyed) { return keyed.key >> shift & ((1u << digit_bits) - 1u); };
    std::array<std::size_t, std::size_t{1} << digit_bits> place{};
    for (const Keyed& keyed : from) ++place[digit(keyed)];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), std::size_t{0});
    for (const Keyed& keyed : from) to[place[digit(keyed)]++] = keyed;
    from.swap(to);
  }
  std::vector<Placed> placed;
  placed.reserve(from.size());
  for (const Keyed& keyed : from) placed.push_back({wrong[keyed.pixel].distance[unit], wrong[keyed.pixel].weights});
  return placed;
}

// What one unit's spread of a part is made of.
struct Tally {
  double total = 0.0;
  double sum = 0.0;  // of the weights so far
  Spread spread;

  void add(double distance, double weight) {
    if (weight == 0.0) return;
    if (sum < 0.5 * total) spread.median = distance;
    if (sum < 0.95 * total) spread.upper = distance;
    spread.largest = distance;
    sum += weight;
  }
  double share() const { return total > 0.0 ? sum / total : 0.0; }
};

// Fills one unit's spreads of all parts and of their sum, the last.
void spread_over(const std::vector<WrongPixel>& wrong, std::size_t unit, std::vector<EdgeDistances>& parts) {
  const std::vector<Placed> placed = by_distance(wrong, unit);
  const std::size_t all = parts.size() - 1;
  std::vector<Tally> tallies(parts.size());
  for (const Placed& pixel : placed) {
    for (std::size_t p = 0; p < all; ++p) {
      tallies[p].total += pixel.weights[p];
      tallies[all].total += pixel.weights[p];
    }
  }
  std::size_t reach = 0;
  const auto end_reach = [&] {
    for (std::size_t p = 0; unit == 1 && p < parts.size(); ++p) parts[p].within[reach] = tallies[p].share();
    ++reach;
  };
  for (const Placed& pixel : placed) {
    while (reach < edge_reaches.size() && edge_reaches[reach] < pixel.distance) end_reach();
    double sum = 0.0;
    for (std::size_t p = 0; p < all; ++p) {
      tallies[p].add(pixel.distance, pixel.weights[p]);
      sum += pixel.weights[p];
    }
    tallies[all].add(pixel.distance, sum);
  }
  while (reach < edge_reaches.size()) end_reach();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (tallies[p].total == 0.0) continue;
    std::optional<Spread>& spread = unit == 0 ? parts[p].pixels : unit == 1 ? parts[p].texels : parts[p].metres;
    spread = tallies[p].spread;
  }
}

// weights_at(pixel) yields the parts' weights; they count `unit_weight` to the pixel.
template <class WeightsAt>
ErrorShape measure_distances(const ShapeInput& input, std::size_t part_count, double unit_weight,
                             const WeightsAt& weights_at) {
  const Image<float>& hard = input.hard_truth != nullptr ? *input.hard_truth : input.truth;
  const ShadowEdges edges = find_shadow_edges(hard, input.gbuffer, input.counted);
  const NearestEdges nearest = nearest_edges(edges);
  std::vector<EdgeDistances> parts(part_count + 1);
  std::vector<double> at_edge(parts.size());  // weight of each part
  std::vector<WrongPixel> wrong;
  for (std::size_t i = 0; i < input.truth.size(); ++i) {
    if (input.counted.exclusion[i] != PixelExclusion::none) continue;
    const Weights weights = weights_at(i);
    double sum = 0.0;
    for (std::size_t p = 0; p < part_count; ++p) {
      parts[p].weight += weights[p];
      sum += weights[p];
    }
    if (sum == 0.0) continue;
    parts[part_count].weight += sum;
    if (edges.count == 0) continue;
    wrong.push_back({distances_at(input, nearest, i), weights});
    if (!is_at_edge(wrong.back())) continue;
    for (std::size_t p = 0; p < part_count; ++p) at_edge[p] += weights[p];
    at_edge[part_count] += sum;
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].weight > 0.0) parts[p].at_edge = at_edge[p] / parts[p].weight;
    parts[p].weight /= unit_weight;
  }
  if (!wrong.empty()) parallel_for(unit_count, [&](std::size_t unit) { spread_over(wrong, unit, parts); });
  ErrorShape shape;
  shape.edges = edges.count;
  shape.all = parts.back();
  parts.pop_back();
  shape.parts = std::move(parts);
  return shape;
}

void add_components(ErrorShape& shape, const WrongTaps& wrong, const CountedPixels& counted) {
  const Image<PixelClass> classes = classify(wrong, counted);
  Image<std::uint8_t> by_class(classes.width, classes.height, 0);
  Image<std::uint8_t> any(classes.width, classes.height, 0);
  Image<std::uint32_t> weights(classes.width, classes.height, 0);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i] < PixelClass::acne || classes[i] > PixelClass::light_leak) continue;
    by_class[i] = static_cast<std::uint8_t>(classes[i]);
    any[i] = 1;
    weights[i] = wrong_weight(wrong.weights[i]);
  }
  shape.components = summarize(find_components(any, weights), 1);
  const std::vector<Component> components = find_components(by_class, weights);
  for (std::size_t c = 0; c < cause_count; ++c) {
    shape.class_components[c] =
        summarize(components, static_cast<std::uint8_t>(static_cast<std::size_t>(PixelClass::acne) + c));
  }
}

}  // namespace

ErrorShape analyze_error_shape(const ShapeInput& input, const WrongTaps& wrong) {
  assert(wrong.weights.size() == input.truth.size());
  ErrorShape shape = measure_distances(input, cause_count, wrong.weight_sum, [&](std::size_t i) {
    const uvec4& w = wrong.weights[i];
    return Weights{static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z), static_cast<float>(w.w)};
  });
  add_components(shape, wrong, input.counted);
  return shape;
}

ErrorShape analyze_error_shape(const ShapeInput& input, const Image<float>& raster) {
  assert(raster.size() == input.truth.size());
  const bool is_exact = input.truth_variance == nullptr || input.truth_variance->empty();
  double outside = 0.0;
  ErrorShape shape = measure_distances(input, soft_part_names.size(), 1.0, [&](std::size_t i) {
    const float error = raster[i] - input.truth[i];
    const double variance = is_exact ? 0.0 : static_cast<double>((*input.truth_variance)[i]);
    outside += static_cast<double>(std::abs(error)) - penumbra_error(raster[i], input.truth[i], variance);
    return Weights{std::max(-error, 0.0f), std::max(error, 0.0f)};
  });
  // Chance may take it a little beyond.
  shape.outside_penumbra = shape.all.weight > 0.0 ? std::clamp(outside / shape.all.weight, 0.0, 1.0) : 0.0;
  return shape;
}

}  // namespace umbrameter
