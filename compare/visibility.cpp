#include "compare/visibility.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace umbrameter {

std::string_view cause_meaning(Cause cause) {
  constexpr std::array<std::string_view, cause_count> meanings = {
      "wrongly blocked by the surface itself", "wrongly blocked by another surface",
      "wrongly lit: the bias removed the occluder", "wrongly lit: the map holds no occluder where it is read"};
  return meanings[static_cast<std::size_t>(cause)];
}

std::uint32_t wrong_weight(const uvec4& by_cause) { return by_cause.x + by_cause.y + by_cause.z + by_cause.w; }

CountedPixels count_pixels(const GBuffer& gbuffer, const Light& light, const MapLayout& layout,
                           const Image<std::uint8_t>& unlit) {
  CountedPixels counted{Image<PixelExclusion>(gbuffer.width, gbuffer.height, PixelExclusion::background)};
  std::vector<double> texels(static_cast<std::size_t>(gbuffer.height), 0.0);
  parallel_for(static_cast<std::size_t>(gbuffer.height), [&](std::size_t y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const std::size_t i = gbuffer.instance.index(x, static_cast<int>(y));
      if (!gbuffer.is_surface(i)) continue;
      const dvec3 position(gbuffer.position[i]);
      counted.exclusion[i] = exclusion_of(light, layout, position, dvec3(gbuffer.geometric_normal[i]));
      const bool is_unlit = unlit.size() > 0 && unlit[i] != 0;
      if (is_unlit && counted.exclusion[i] == PixelExclusion::none) counted.exclusion[i] = PixelExclusion::back_facing;
      if (counted.exclusion[i] == PixelExclusion::none) texels[y] += texel_at(layout, position);
    }
  });
  for (const PixelExclusion exclusion : counted.exclusion.pixels) ++counted.totals[static_cast<std::size_t>(exclusion)];
  for (const double texel : texels) counted.mean_texel += texel;
  const std::uint64_t pixels = counted.totals[static_cast<std::size_t>(PixelExclusion::none)];
  if (pixels > 0) counted.mean_texel /= static_cast<double>(pixels);
  return counted;
}

TruthCounts count_truth(const Image<float>& truth, const CountedPixels& counted) {
  assert(truth.size() == counted.exclusion.size());
  TruthCounts counts{0, 0, counted.mean_texel};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (counted.exclusion[i] != PixelExclusion::none) continue;
    ++counts.pixels;
    if (truth[i] >= 0.5f) ++counts.lit;
  }
  return counts;
}

VisibilitySums sum_wrong_taps(const WrongTaps& wrong, const CountedPixels& counted) {
  assert(wrong.weights.size() == counted.exclusion.size());
  VisibilitySums sums;
  sums.weight_sum = wrong.weight_sum;
  for (std::size_t i = 0; i < wrong.weights.size(); ++i) {
    if (counted.exclusion[i] != PixelExclusion::none) continue;
    const uvec4& by_cause = wrong.weights[i];
    const std::uint32_t all = wrong_weight(by_cause);
    if (all == 0) continue;
    for (std::size_t c = 0; c < cause_count; ++c) sums.wrong[c] += by_cause[static_cast<int>(c)];
    sums.squares += static_cast<WideCount>(all) * all;
    sums.largest = std::max(sums.largest, all);
  }
  return sums;
}

VisibilityStatistics to_statistics(const VisibilitySums& sums, const TruthCounts& truth) {
  VisibilityStatistics statistics;
  statistics.pixels = truth.pixels;
  statistics.mean_texel = truth.mean_texel;
  if (truth.pixels == 0) return statistics;
  const auto pixels = static_cast<double>(truth.pixels);
  const double weight = sums.weight_sum;
  // Each of a sum of whole taps, so that equal errors are equal to the last digit, whatever their causes.
  const auto share = [&](auto taps) { return static_cast<double>(taps) / (pixels * weight); };
  const auto& [acne, occlusion, panning, leak] = sums.wrong;
  statistics.lit = static_cast<double>(truth.lit) / pixels;
  statistics.blocked = static_cast<double>(truth.pixels - truth.lit) / pixels;
  statistics.acne = share(acne);
  statistics.false_occlusion = share(occlusion);
  statistics.peter_panning = share(panning);
  statistics.leak = share(leak);
  statistics.false_blocked = share(acne + occlusion);
  statistics.false_lit = share(panning + leak);
  statistics.mae = share(acne + occlusion + panning + leak);
  statistics.mean_error = statistics.false_lit - statistics.false_blocked;
  statistics.rmse = std::sqrt(static_cast<double>(sums.squares) / pixels) / weight;
  statistics.max_error = sums.largest / weight;
  return statistics;
}

VisibilityStatistics analyze_visibility(const WrongTaps& wrong, const Image<float>& truth,
                                        const CountedPixels& counted) {
  const VisibilitySums sums = sum_wrong_taps(wrong, counted);
  VisibilityStatistics statistics = to_statistics(sums, count_truth(truth, counted));
  for (std::size_t i = 0; sums.largest > 0 && i < wrong.weights.size(); ++i) {
    if (counted.exclusion[i] != PixelExclusion::none || wrong_weight(wrong.weights[i]) != sums.largest) continue;
    const auto width = static_cast<std::size_t>(wrong.weights.width);
    statistics.max_x = static_cast<int>(i % width);
    statistics.max_y = static_cast<int>(i / width);
    break;
  }
  return statistics;
}

Image<float> signed_error(const Image<float>& raster, const Image<float>& truth) {
  assert(raster.size() == truth.size());
  Image<float> error(raster.width, raster.height);
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = raster[i] - truth[i];
  return error;
}

Image<PixelClass> classify(const WrongTaps& wrong, const CountedPixels& counted) {
  Image<PixelClass> result(wrong.weights.width, wrong.weights.height, PixelClass::correct);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (counted.exclusion[i] == PixelExclusion::background) {
      result[i] = PixelClass::background;
    } else if (counted.exclusion[i] != PixelExclusion::none) {
      result[i] = PixelClass::not_counted;
    } else {
      std::uint32_t largest = 0;
      for (int c = 0; c < static_cast<int>(cause_count); ++c) {
        if (wrong.weights[i][c] <= largest) continue;
        largest = wrong.weights[i][c];
        result[i] = static_cast<PixelClass>(static_cast<int>(PixelClass::acne) + c);
      }
    }
  }
  return result;
}

Statistics describe(VisibilityStatistics& s) {
  const auto meaning = [](Cause cause) { return std::string(cause_meaning(cause)); };
  return StatisticsDescription()
      .field("pixels", s.pixels, "px", "counted pixels: they face the light and lie inside its map, cone and range")
      .share("lit", s.lit, "share lit in the reference")
      .share("blocked", s.blocked, "share blocked in the reference")
      .share("mae", s.mae, "mean absolute error of visibility",
             {"Mean absolute error of visibility", "mean absolute error [% of counted pixels]", true})
      .field("rmse", s.rmse, "1", "RMS error of visibility")
      .share("acne", s.acne, meaning(Cause::acne), {"Acne", "acne [% of counted pixels]"})
      .share("false_occlusion", s.false_occlusion, meaning(Cause::false_occlusion),
             {"False occlusion", "false occlusion [% of counted pixels]"})
      .share("peter_panning", s.peter_panning, meaning(Cause::peter_panning),
             {"Peter-panning", "peter-panning [% of counted pixels]"})
      .share("leak", s.leak, meaning(Cause::light_leak), {"Light leak", "light leak [% of counted pixels]"})
      .field("mean_error", s.mean_error, "1", "mean signed error, technique − reference")
      .field("max_error", s.max_error, "1", "largest absolute error")
      .share("false_blocked", s.false_blocked, "too dark: reference lit, technique blocked")
      .share("false_lit", s.false_lit, "too bright: reference blocked, technique lit")
      .field("mean_texel", s.mean_texel, "m", mean_texel_meaning)
      .take();
}

}  // namespace umbrameter
