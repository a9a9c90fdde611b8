// What follows every AO technique and its blur: light of further bounces, and the strength of the result.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

struct AoToneParams {
  double intensity = 1.0;
  double power = 1.0;
  bool multi_bounce = false;
  double albedo = 0.5;
};
Parameters describe(AoToneParams& params);

/// The accessibility that gives the light of all bounces, for a grey surface among others of the same albedo: a fit to
/// traced images (J. Jimenez, X. Wu, A. Pesce and A. Jarabo, Practical Real-Time Strategies for Accurate Indirect
/// Occlusion, SIGGRAPH 2016). Not below `ao`, and at most 1.
float with_bounces(float ao, double albedo);

/// max(0, 1 − intensity · (1 − a))^power for an accessibility from 0 to 1, where a is with_bounces(ao) if the
/// parameters say so. The defaults change no bit.
float with_tone(float ao, const AoToneParams& params);

}  // namespace umbrameter
