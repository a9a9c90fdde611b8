// GTAO with a visibility bitmask: surfaces have a thickness, so that light passes behind them (Therrien, Levesque and
// Gilet 2023). bitmask.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct BitmaskMethod : AoScreen {
#include "techniques/ao/bitmask.glsl"
};

}  // namespace shared

enum class BitmaskWeight : int { angle, cosine };
enum class BitmaskRounding : int { up, nearest };

/// Weight and rounding are those of the paper's code; the other numbers are our choice.
struct BitmaskParams {
  double thickness = 0.25;
  double distribution = 2.0;
  BitmaskWeight weight = BitmaskWeight::angle;
  BitmaskRounding rounding = BitmaskRounding::up;
};
Parameters describe(BitmaskParams& params);

struct Bitmask {
  static constexpr std::string_view name = "bitmask";
  static constexpr std::string_view title = "Visibility bitmask";
  static constexpr AoBlur denoiser = AoBlur::xegtao;  ///< ours: that of GTAO, whose slices and noise it has
  static constexpr std::string_view text = "bitmask.glsl";
  static constexpr std::string_view settings = "BitmaskSettings";
  static constexpr bool reads_samples = false;
  static constexpr bool has_bent_normal = true;
  AoSamplingParams sampling;
  AoNoiseParams noise;
  AoSliceParams slices;
  BitmaskParams params;
};

shared::BitmaskMethod::BitmaskSettings settings_of(const Bitmask& technique);

}  // namespace umbrameter
