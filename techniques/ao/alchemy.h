// Alchemy AO and Scalable Ambient Obscurance (McGuire et al. 2011, 2012), without mip chain.
// alchemy.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct AlchemyMethod : AoScreen {
#define SHARED
#include "techniques/ao/alchemy.glsl"
#undef SHARED
};

}  // namespace shared

enum class AlchemyEstimator : int { alchemy, sao };

struct AlchemyParams {
  AlchemyEstimator estimator = AlchemyEstimator::sao;
  int turns = 7;
  double bias = 0.01;
  double intensity = 1.0;
};
Parameters describe(AlchemyParams& params);

struct Alchemy {
  static constexpr std::string_view title = "Alchemy AO";
  AoSamplingParams sampling;
  AoNoiseParams noise;
  AlchemyParams params;
};
Parameters describe(Alchemy& technique);

shared::AlchemyMethod::AlchemySettings settings_of(const Alchemy& technique);

}  // namespace umbrameter
