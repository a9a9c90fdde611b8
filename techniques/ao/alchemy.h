// Alchemy AO and Scalable Ambient Obscurance (McGuire et al. 2011, 2012), with or without its depth pyramid.
// alchemy.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct AlchemyMethod : AoScreen {
#include "techniques/ao/depth_pyramid.glsl"
  // Finds the depth that the pyramid holds without building it.
  float depth_at_level(ivec2 texel, int level) {
    for (; level > 0; --level) texel = source_texel(texel, level_size(size, level - 1));
    return depth_at(texel);
  }
#include "techniques/ao/alchemy.glsl"
};

}  // namespace shared

enum class AlchemyEstimator : int { alchemy, sao };

struct AlchemyParams {
  AlchemyEstimator estimator = AlchemyEstimator::sao;
  int turns = 7;
  double bias = 0.01;
  double intensity = 1.0;
  bool mip_chain = false;
  int mip_offset = 3;  ///< q′ of the paper; levels as in the code published with it
  int mip_levels = 5;
};
Parameters describe(AlchemyParams& params);

struct Alchemy {
  static constexpr std::string_view name = "alchemy";
  static constexpr std::string_view title = "Alchemy AO";
  static constexpr AoBlur denoiser = AoBlur::bilateral;  ///< SAO_blur.pix: 9 taps along each axis, by depth
  static constexpr std::string_view text = "alchemy.glsl";
  static constexpr std::string_view settings = "AlchemySettings";
  AoSamplingParams sampling;
  AoNoiseParams noise;
  AlchemyParams params;
};

shared::AlchemyMethod::AlchemySettings settings_of(const Alchemy& technique);

}  // namespace umbrameter
