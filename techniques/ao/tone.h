// What follows every AO technique and its blur: the strength of the result.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

struct AoToneParams {
  double intensity = 1.0;
  double power = 1.0;
};
Parameters describe(AoToneParams& params);

/// max(0, 1 − intensity · (1 − ao))^power for an accessibility from 0 to 1. Intensity 1 and power 1 change no bit.
float with_tone(float ao, const AoToneParams& params);

}  // namespace umbrameter
