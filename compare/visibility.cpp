#include "compare/visibility.h"

#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace umbrameter {
namespace {

struct RowSums {
  std::uint64_t pixels = 0;
  double lit = 0.0;
  double absolute = 0.0;
  double squared = 0.0;
  double signed_sum = 0.0;
  double false_blocked = 0.0;
  double false_lit = 0.0;
  std::array<double, 4> classes{};
  double max_error = 0.0;
  int max_x = -1;
};

RowSums sum_row(int y, const Image<float>& raster, const Image<float>& truth, const Image<vec4>& classes,
                const Image<Counting>& counting) {
  RowSums sums;
  for (int x = 0; x < raster.width; ++x) {
    const std::size_t i = raster.index(x, y);
    if (counting[i] != Counting::counted) continue;
    const double error = static_cast<double>(raster[i]) - static_cast<double>(truth[i]);
    ++sums.pixels;
    sums.lit += truth[i];
    sums.absolute += std::abs(error);
    sums.squared += error * error;
    sums.signed_sum += error;
    (error < 0.0 ? sums.false_blocked : sums.false_lit) += std::abs(error);
    for (int c = 0; c < 4; ++c) sums.classes[static_cast<std::size_t>(c)] += classes[i][c];
    if (std::abs(error) > sums.max_error) {
      sums.max_error = std::abs(error);
      sums.max_x = x;
    }
  }
  return sums;
}

}  // namespace

CountedPixels count_pixels(const GBuffer& gbuffer, const Light& light, const LightFrame& frame) {
  CountedPixels counted{Image<Counting>(gbuffer.width, gbuffer.height, Counting::background)};
  std::vector<double> texels(static_cast<std::size_t>(gbuffer.height), 0.0);
  parallel_for(static_cast<std::size_t>(gbuffer.height), [&](std::size_t y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const std::size_t i = gbuffer.instance.index(x, static_cast<int>(y));
      if (!gbuffer.is_surface(i)) continue;
      const dvec3 position(gbuffer.position[i]);
      counted.counting[i] = counting_of(light, frame, position, dvec3(gbuffer.geometric_normal[i]));
      if (counted.counting[i] == Counting::counted) texels[y] += texel_at(frame, position);
    }
  });
  for (const Counting counting : counted.counting.pixels) ++counted.totals[static_cast<std::size_t>(counting)];
  for (const double texel : texels) counted.mean_texel += texel;
  const std::uint64_t pixels = counted.totals[static_cast<std::size_t>(Counting::counted)];
  if (pixels > 0) counted.mean_texel /= static_cast<double>(pixels);
  return counted;
}

VisibilityStatistics analyze_visibility(const Image<float>& raster, const Image<float>& truth,
                                        const Image<vec4>& classes, const CountedPixels& counted) {
  assert(raster.size() == truth.size() && raster.size() == classes.size() && raster.size() == counted.counting.size());
  // One sum a row, added in order: the result does not depend on the number of threads.
  std::vector<RowSums> rows(static_cast<std::size_t>(raster.height));
  parallel_for(rows.size(), [&](std::size_t y) {
    rows[y] = sum_row(static_cast<int>(y), raster, truth, classes, counted.counting);
  });
  VisibilityStatistics statistics;
  std::array<double, 4> shares{};
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const RowSums& row = rows[y];
    statistics.pixels += row.pixels;
    statistics.lit += row.lit;
    statistics.mae += row.absolute;
    statistics.rmse += row.squared;
    statistics.mean_error += row.signed_sum;
    statistics.false_blocked += row.false_blocked;
    statistics.false_lit += row.false_lit;
    for (std::size_t c = 0; c < shares.size(); ++c) shares[c] += row.classes[c];
    if (row.max_error > statistics.max_error) {
      statistics.max_error = row.max_error;
      statistics.max_x = row.max_x;
      statistics.max_y = static_cast<int>(y);
    }
  }
  statistics.mean_texel = counted.mean_texel;
  if (statistics.pixels == 0) return statistics;
  const double scale = 1.0 / static_cast<double>(statistics.pixels);
  statistics.lit *= scale;
  statistics.blocked = 1.0 - statistics.lit;
  statistics.mae *= scale;
  statistics.rmse = std::sqrt(statistics.rmse * scale);
  statistics.mean_error *= scale;
  statistics.false_blocked *= scale;
  statistics.false_lit *= scale;
  statistics.acne = shares[0] * scale;
  statistics.false_occlusion = shares[1] * scale;
  statistics.peter_panning = shares[2] * scale;
  statistics.leak = shares[3] * scale;
  return statistics;
}

Image<float> signed_error(const Image<float>& raster, const Image<float>& truth) {
  assert(raster.size() == truth.size());
  Image<float> error(raster.width, raster.height);
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = raster[i] - truth[i];
  return error;
}

Image<PixelClass> classify(const Image<vec4>& classes, const CountedPixels& counted) {
  Image<PixelClass> result(classes.width, classes.height, PixelClass::correct);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (counted.counting[i] == Counting::background) {
      result[i] = PixelClass::background;
    } else if (counted.counting[i] != Counting::counted) {
      result[i] = PixelClass::not_counted;
    } else {
      float largest = 0.0f;
      for (int c = 0; c < 4; ++c) {
        if (classes[i][c] <= largest) continue;
        largest = classes[i][c];
        result[i] = static_cast<PixelClass>(static_cast<int>(PixelClass::acne) + c);
      }
    }
  }
  return result;
}

std::vector<Column> visibility_columns() {
  return {
      {"pixels", "px", "pixels counted: facing the light, inside its map, cone and range"},
      {"lit", "1", "share that the reference calls lit"},
      {"blocked", "1", "share that the reference calls blocked"},
      {"mae", "1", "mean absolute error of visibility"},
      {"rmse", "1", "root mean square error of visibility"},
      {"acne", "1", "wrongly blocked by the surface's own depth"},
      {"false_occlusion", "1", "wrongly blocked by another surface"},
      {"peter_panning", "1", "wrongly lit: the map saw the blocker, the bias erased it"},
      {"leak", "1", "wrongly lit: the map holds no blocker there"},
      {"mean_error", "1", "mean of raster − truth"},
      {"max_error", "1", "largest absolute error"},
      {"false_blocked", "1", "truth lit, raster blocked"},
      {"false_lit", "1", "truth blocked, raster lit"},
      {"mean_texel", "m", "mean side of a shadow-map texel at the counted surfels"},
  };
}

std::vector<Value> to_row(const VisibilityStatistics& s) {
  return {static_cast<std::int64_t>(s.pixels),
          s.lit,
          s.blocked,
          s.mae,
          s.rmse,
          s.acne,
          s.false_occlusion,
          s.peter_panning,
          s.leak,
          s.mean_error,
          s.max_error,
          s.false_blocked,
          s.false_lit,
          s.mean_texel};
}

}  // namespace umbrameter
