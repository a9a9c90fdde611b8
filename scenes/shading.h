// The picture that goes with a measurement: diffuse light by the visibility and AO images at hand.
// Nothing is measured on it.
#pragma once

#include <span>
#include <vector>

#include "core/gbuffer.h"
#include "core/image.h"
#include "scenes/scene.h"

namespace umbrameter {

/// A light and the visibility image that one side found for it.
struct LitBy {
  const Light* light = nullptr;
  const Image<float>* visibility = nullptr;
};

/// Outgoing radiance of each surfel, linear, divided by the scene's key illuminance so that 1 is about white.
/// Lambert: albedo / π · (Σ E_i · visibility_i + ambient · AO); E_i from KHR_lights_punctual (lux by the cosine,
/// candela over squared distance with its range window, spot cone from outer to inner angle). The ambient
/// illuminance is a fixed quarter of the key. Background is a pale sky colour. Without an AO image it counts as 1.
Image<vec3> shade(const GBuffer& gbuffer, std::span<const LitBy> lights, const Image<float>* ao);

/// Illuminance of a surfel that the light sees, lux: 0 where turned away, outside cone or range.
double illuminance(const Light& light, const dvec3& position, const dvec3& normal);

}  // namespace umbrameter
