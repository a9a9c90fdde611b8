#include "compare/bias_flips.h"

#include <algorithm>
#include <cmath>

namespace umbrameter {

OwnSurfaceFlips find_own_surface_flips(const WrongTaps& least, const Image<PixelExclusion>& exclusion,
                                       const Image<float>& truth, std::size_t biases,
                                       const std::function<Image<float>(std::size_t)>& frame) {
  const auto acne_at = [&](std::size_t i) {
    return static_cast<double>(least.weights[i][static_cast<int>(Cause::acne)]) / least.weight_sum;
  };
  double acne = 0.0, lit = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    acne += acne_at(i);
    if (exclusion[i] == PixelExclusion::none) lit += truth[i];
  }
  if (!(acne > least_acne_share * lit)) return {FlipProblem::little_acne};
  const Image<float> first = frame(0);
  const auto share_lit = [&](const Image<float>& drawn) {
    double sum = 0.0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      sum += std::clamp(static_cast<double>(drawn[i]) - static_cast<double>(first[i]), 0.0, acne_at(i));
    }
    return sum / acne;
  };
  OwnSurfaceFlips found{FlipProblem::none, biases - 1, frame(biases - 1)};
  double share = share_lit(found.visibility);
  if (share < own_surface_share) return {FlipProblem::too_short};
  for (std::size_t below = 0; found.bias - below > 1;) {
    const std::size_t middle = below + (found.bias - below) / 2;
    Image<float> drawn = frame(middle);
    const double lit_there = share_lit(drawn);
    if (lit_there < own_surface_share) {
      below = middle;
    } else {
      found = {FlipProblem::none, middle, std::move(drawn)};
      share = lit_there;
    }
  }
  if (share > most_own_surface_share) return {FlipProblem::too_coarse};
  return found;
}

void separate_too_bright(WrongTaps& wrong, const Image<float>& own_surface) {
  for (std::size_t i = 0; i < own_surface.size(); ++i) {
    auto& peter_panning = wrong.weights[i][static_cast<int>(Cause::peter_panning)];
    auto& leak = wrong.weights[i][static_cast<int>(Cause::light_leak)];
    const std::uint32_t bright = peter_panning + leak;
    const double lit = std::round(static_cast<double>(own_surface[i]) * wrong.weight_sum);
    leak = static_cast<std::uint32_t>(std::min(static_cast<double>(bright), lit));
    peter_panning = bright - leak;
  }
}

}  // namespace umbrameter
