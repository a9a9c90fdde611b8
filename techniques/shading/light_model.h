// The light model in C++. Namespace shared compiles light_model.glsl and gbuffer_encoding.glsl, which the shaders
// compile too and which document its functions. The other functions fill their inputs and shade images.
#pragma once

#include "core/gbuffer.h"
#include "core/image.h"
#include "core/math.h"
#include "scenes/scene.h"
#include "scenes/view.h"
#include "techniques/shading/parameters.h"

namespace umbrameter {
namespace shared {

using glm::abs;
using glm::dot;
using glm::exp2;
using glm::floor;
using glm::frexp;
using glm::ldexp;
using glm::length;
using glm::log2;
using glm::max;
using glm::min;
using glm::normalize;
using glm::sqrt;

#define SHARED inline
#define PRECISE
#include "techniques/shading/gbuffer_encoding.glsl"
#include "techniques/shading/light_model.glsl"
#undef PRECISE
#undef SHARED

}  // namespace shared

shared::LightModel light_model(const ShadingParams& params);
shared::LightSource light_source(const Light& light);

/// The surfel of a pixel, as the light model reads it.
shared::SurfacePoint surface_point(const GBuffer& gbuffer, const View& view, std::size_t pixel);

/// Adds the light that surfels reflect: visibility × (diffuse + specular). `visibility` has a value from 0 to 1 per
/// pixel. Does not change the background.
void add_light(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Light& light,
               const Image<float>& visibility, const ShadingParams& params);

/// Adds reflected ambient light × accessibility (`ao`).
void add_ambient(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Image<float>& ao,
                 const ShadingParams& params);

}  // namespace umbrameter
