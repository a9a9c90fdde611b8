#include "techniques/truth/parameters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr int lowest_spp_limit = 64;
constexpr int highest_spp_limit = 1048576;

}  // namespace

Parameters describe(TruthParams& params) {
  static constexpr std::array<std::string_view, 2> weights = {"cosine", "uniform"};
  static constexpr std::array<std::string_view, 2> samplers = {"owen", "random"};
  static constexpr std::array<std::string_view, 7> falloffs = {"none", "linear", "quadratic", "ssao",
                                                               "sao",  "hbao",   "gtao"};
  static constexpr std::array<std::string_view, 2> normals = {"geometric", "shading"};
  static constexpr std::array<std::string_view, 4> layers = {"none", "bent-normal", "hit-distance", "all"};
  static constexpr std::array<std::string_view, 2> samplings = {"area", "solid-angle"};
  static constexpr std::array<std::string_view, 3> shadows = {"point", "pixel", "light"};
  return Description("truth")
      .field("spp", params.spp,
             {.unit = "rays",
              .meaning = "rays per pixel, for AO, area lights and pixel means",
              .min = 1,
              .max = 65536,
              .basic = true})
      .choice("ao-weight", params.ao_weight, weights, {"", "weight of AO directions"})
      .field("ao-distance", params.ao_distance,
             {.unit = "m",
              .meaning = "max distance of occluders; 0: no limit, auto: ao.radius",
              .min = 0.0,
              .units = {.scene_size = true, .automatic = true},
              .basic = true})
      .choice("sampler", params.sampler, samplers, {"", "Owen-scrambled Sobol points, or independent random points"})
      .field("tolerance", params.tolerance,
             {.unit = "1",
              .meaning = "adaptive sampling: max half width of 95 % intervals; 0: off",
              .min = 0.0,
              .max = 1.0,
              .basic = true})
      .field(
          "min-spp", params.min_spp,
          {"rays", "min rays per pixel (adaptive sampling)", static_cast<double>(lowest_spp_limit), highest_spp_limit})
      .field(
          "max-spp", params.max_spp,
          {"rays", "max rays per pixel (adaptive sampling)", static_cast<double>(lowest_spp_limit), highest_spp_limit})
      .choice("ao-falloff", params.ao_falloff, falloffs,
              {"", "falloff of AO occluders with distance: a curve, or that of a technique"})
      .choice("ao-normal", params.ao_normal, normals, {"", "normal that the AO hemisphere is centred on"})
      .choice("ao-layers", params.ao_layers, layers,
              {"", "further AO images: mean unoccluded direction, mean hit distance"})
      .choice("light-sampling", params.light_sampling, samplings,
              {"", "visibility of an area light: visible share of its area or of its solid angle"})
      .choice("shadow", params.shadow, shadows,
              {"",
               "reference of shadows; light: visible share of the light, or 0 or 1 if it has no extent; point: 0 or "
               "1, as if it had none; pixel: mean over the pixel"})
      .take();
}

void check(const TruthParams& params) {
  if (params.ao_falloff != AoFalloff::none && !has_distance_limit(params)) {
    throw Error(ExitCode::usage, "truth.ao-falloff", "a falloff needs a distance limit",
                "set truth.ao-distance above 0, or truth.ao-falloff to none");
  }
  if (params.tolerance > 0.0 && params.max_spp < params.min_spp) {
    throw Error(ExitCode::usage, "truth.max-spp",
                std::to_string(params.max_spp) + " is below truth.min-spp, " + std::to_string(params.min_spp),
                "raise truth.max-spp or lower truth.min-spp");
  }
}

double falloff_weight(AoFalloff falloff, double distance, double limit) {
  constexpr double gtao_start = 0.385;
  const double x = limit > 0.0 ? distance / limit : 0.0;
  if (falloff == AoFalloff::ssao) {
    const double s = x > 1.0 ? 1.0 / x : 1.0;
    return s * s * (3.0 - 2.0 * s);
  }
  const double rest = std::max(1.0 - x * x, 0.0);
  switch (falloff) {
    case AoFalloff::none:
    case AoFalloff::ssao:
      return 1.0;
    case AoFalloff::linear:
      return std::max(1.0 - x, 0.0);
    case AoFalloff::quadratic:
    case AoFalloff::hbao:
      return rest;
    case AoFalloff::sao:
      return rest * rest * rest;
    case AoFalloff::gtao:
      return std::clamp((1.0 - x) / (1.0 - gtao_start), 0.0, 1.0);
  }
  return 1.0;
}

bool has_distance_limit(const TruthParams& params) {
  assert(params.ao_distance.unit == LengthUnit::metres || params.ao_distance.unit == LengthUnit::automatic);
  return params.ao_distance.unit == LengthUnit::metres && params.ao_distance.number > 0.0;
}

double reach_of(const TruthParams& params) {
  const bool is_endless = !has_distance_limit(params) || params.ao_falloff == AoFalloff::ssao;
  return is_endless ? std::numeric_limits<double>::infinity() : params.ao_distance.number;
}

}  // namespace umbrameter
