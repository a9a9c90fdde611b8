// What follows every AO technique and its blur: light of further bounces, and the strength of the result.
#pragma once

#include "core/gbuffer.h"
#include "core/parameters.h"

namespace umbrameter {

/// Whose albedo the light of further bounces has: that of the parameter, or of each surfel.
enum class AoAlbedo : int { constant, surface };

struct AoToneParams {
  double intensity = 1.0;
  double power = 1.0;
  bool multi_bounce = false;
  double albedo = 0.5;
  AoAlbedo albedo_source = AoAlbedo::constant;
};
Parameters describe(AoToneParams& params);

/// The accessibility that gives the light of all bounces, for a grey surface among others of the same albedo: a fit to
/// traced images (J. Jimenez, X. Wu, A. Pesce and A. Jarabo, Practical Real-Time Strategies for Accurate Indirect
/// Occlusion, SIGGRAPH 2016). Not below `ao`, and at most 1.
float with_bounces(float ao, double albedo);

/// max(0, 1 − intensity · (1 − a))^power for an accessibility from 0 to 1, where a is with_bounces(ao) if the
/// parameters say so. The defaults change no bit.
float with_tone(float ao, const AoToneParams& params);

/// Whether the result depends on the surfel.
inline bool reads_surface(const AoToneParams& params) {
  return params.multi_bounce && params.albedo_source == AoAlbedo::surface;
}

/// The parameters for one surfel: if they read the surface, the albedo is the luminance (Rec. 709) of its diffuse
/// albedo, base colour × (1 − metallic).
AoToneParams at_surface(AoToneParams params, const vec3& base_color, float metallic);
AoToneParams at_surface(const AoToneParams& params, const GBuffer& gbuffer, std::size_t pixel);

}  // namespace umbrameter
