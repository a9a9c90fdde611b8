#include "compare/alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "compare/metrics/color_space.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

constexpr int tile_side = 8;
constexpr int margin = max_alignment_shift;
constexpr int min_side = 48;
constexpr std::size_t max_tiles = 1024;
constexpr double min_counted = 1024.0;  // pixels
constexpr double max_left_of_variance = 0.5;
constexpr double min_better_to_worse = 10.0;
constexpr double min_improved_tiles = 4.0;  // (Σ gain)² / Σ gain²
constexpr double min_difference = 1e-6;     // variance; below it the images are equal but for rounding

// A shift or a flip, as the place of the test image that belongs to a pixel of the reference.
struct Candidate {
  ivec2 shift{0};
  bool flips_x = false;
  bool flips_y = false;
};

std::vector<Candidate> all_candidates() {
  std::vector<Candidate> all = {{}, {{}, true, false}, {{}, false, true}, {{}, true, true}};
  for (int y = -max_alignment_shift; y <= max_alignment_shift; ++y) {
    for (int x = -max_alignment_shift; x <= max_alignment_shift; ++x) {
      if (x != 0 || y != 0) all.push_back({{x, y}});
    }
  }
  return all;
}

// Luminance, compressed so that no value outweighs all others: √(L / (1 + L)), odd in L.
Image<float> compressed_luminance(const Image<vec3>& image) {
  Image<float> result(image.width, image.height);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t row) {
    const std::size_t first = row * static_cast<std::size_t>(image.width);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(image.width); ++i) {
      const auto linear = static_cast<float>(luminance(image[i]));
      const float size = std::abs(linear);
      result[i] = std::copysign(std::sqrt(size / (1.0f + size)), linear);
    }
  });
  return result;
}

Image<float> mirrored(const Image<float>& image) {
  Image<float> result(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) result.at(x, y) = image.at(image.width - 1 - x, y);
  }
  return result;
}

using TileRow = std::array<float, tile_side>;

// A tile of the reference: its values, and a weight of 1 where they count.
struct ReferenceTile {
  ivec2 corner{0};
  std::array<TileRow, tile_side> values{};
  std::array<TileRow, tile_side> weights{};
  float count = 0.0f;
};

// Sum of the squares of (test − reference) less its mean. `first` and `stride` are those of the test's rows. Columns
// are summed last, so that the inner loops vectorise.
float scatter(const ReferenceTile& tile, const float* first, std::ptrdiff_t stride) {
  TileRow sums{};
  TileRow squares{};
  for (std::size_t y = 0; y < tile_side; ++y) {
    const TileRow& values = tile.values[y];
    const TileRow& weights = tile.weights[y];
    const float* row = first + static_cast<std::ptrdiff_t>(y) * stride;
    for (std::size_t x = 0; x < tile_side; ++x) {
      const float difference = weights[x] * (row[x] - values[x]);
      sums[x] += difference;
      squares[x] += difference * difference;
    }
  }
  const float sum = std::accumulate(sums.begin(), sums.end(), 0.0f);
  const float square = std::accumulate(squares.begin(), squares.end(), 0.0f);
  return std::max(square - sum * sum / tile.count, 0.0f);
}

// Tiles inside the margin, evenly spaced where there are more than max_tiles, with at least one pixel that counts.
std::vector<ReferenceTile> make_tiles(const Image<float>& reference,
                                      const std::function<bool(std::size_t)>& is_counted) {
  const int columns = (reference.width - 2 * margin) / tile_side;
  const int rows = (reference.height - 2 * margin) / tile_side;
  const std::size_t all = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::size_t taken = std::min(all, max_tiles);
  std::vector<ReferenceTile> tiles;
  for (std::size_t t = 0; t < taken; ++t) {
    const int place = static_cast<int>(t * all / taken);
    ReferenceTile tile;
    tile.corner = ivec2(margin) + tile_side * ivec2(place % columns, place / columns);
    for (int y = 0; y < tile_side; ++y) {
      for (int x = 0; x < tile_side; ++x) {
        const std::size_t pixel = reference.index(tile.corner.x + x, tile.corner.y + y);
        if (!is_counted(pixel)) continue;
        tile.values[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = reference[pixel];
        tile.weights[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = 1.0f;
        tile.count += 1.0f;
      }
    }
    if (tile.count > 0.0f) tiles.push_back(tile);
  }
  return tiles;
}

// The squared differences of each tile for each candidate.
std::vector<std::vector<float>> measure(const std::vector<ReferenceTile>& tiles, const Image<float>& test,
                                        const std::vector<Candidate>& candidates) {
  const Image<float> other = mirrored(test);
  std::vector<std::vector<float>> scatters(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t t) {
    const ReferenceTile& tile = tiles[t];
    for (const Candidate& candidate : candidates) {
      const Image<float>& image = candidate.flips_x ? other : test;
      const ivec2 at = tile.corner + candidate.shift;
      const int row = candidate.flips_y ? test.height - 1 - at.y : at.y;
      const std::ptrdiff_t stride = candidate.flips_y ? -test.width : test.width;
      scatters[t].push_back(scatter(tile, &image[image.index(at.x, row)], stride));
    }
  });
  return scatters;
}

struct Totals {
  double difference = 0.0;
  double gain = 0.0;          ///< of the tiles that get better
  double loss = 0.0;          ///< of the others
  double gain_squares = 0.0;  ///< sum of the squares of the gains
};

Totals totals_of(const std::vector<std::vector<float>>& scatters, std::size_t candidate) {
  Totals totals;
  for (const std::vector<float>& of_tile : scatters) {
    const double gain = static_cast<double>(of_tile[0]) - static_cast<double>(of_tile[candidate]);
    totals.difference += static_cast<double>(of_tile[candidate]);
    (gain > 0.0 ? totals.gain : totals.loss) += std::abs(gain);
    if (gain > 0.0) totals.gain_squares += gain * gain;
  }
  return totals;
}

}  // namespace

std::optional<Misalignment> find_misalignment(const Image<vec3>& test, const Image<vec3>& reference,
                                              const std::function<bool(std::size_t)>& is_counted) {
  if (std::min(reference.width, reference.height) < min_side) return std::nullopt;
  const Image<float> reference_values = compressed_luminance(reference);
  const std::vector<ReferenceTile> tiles = make_tiles(reference_values, is_counted);
  double counted = 0.0;
  double variance = 0.0;
  const TileRow zeros{};
  for (const ReferenceTile& tile : tiles) {
    counted += static_cast<double>(tile.count);
    variance += static_cast<double>(scatter(tile, zeros.data(), 0));
  }
  if (counted < min_counted) return std::nullopt;
  const std::vector<Candidate> candidates = all_candidates();
  const std::vector<std::vector<float>> scatters = measure(tiles, compressed_luminance(test), candidates);
  const double as_it_is = totals_of(scatters, 0).difference;
  if (as_it_is < min_difference * counted) return std::nullopt;

  std::optional<Misalignment> best;
  double least = max_remaining_difference * as_it_is;
  for (std::size_t c = 1; c < candidates.size(); ++c) {
    const Totals totals = totals_of(scatters, c);
    const bool fits = totals.difference < max_left_of_variance * variance;
    const bool is_everywhere = totals.gain >= min_better_to_worse * totals.loss &&
                               totals.gain * totals.gain >= min_improved_tiles * totals.gain_squares;
    if (!(totals.difference < least) || !fits || !is_everywhere) continue;
    least = totals.difference;
    best =
        Misalignment{candidates[c].shift, candidates[c].flips_x, candidates[c].flips_y, totals.difference / as_it_is};
  }
  return best;
}

}  // namespace umbrameter
