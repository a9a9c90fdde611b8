// The light model in C++: light_model.glsl and gbuffer_encoding.glsl, which the shaders compile too, and the functions
// that fill their inputs. Every function of namespace shared is documented there.
#pragma once

#include <span>

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
#include "techniques/shading/gbuffer_encoding.glsl"
#include "techniques/shading/light_model.glsl"
#undef SHARED

}  // namespace shared

shared::LightModel light_model(const ShadingParams& params);
shared::LightSource light_source(const Light& light);

/// The surfel of a pixel as the model reads it.
shared::SurfacePoint surface_point(const GBuffer& gbuffer, const View& view, std::size_t pixel);

/// Adds what a light reflects: visibility × (diffuse + specular). `visibility` has a value per pixel, 0 to 1. The
/// background stays as it is.
void add_light(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Light& light,
               const Image<float>& visibility, const ShadingParams& params);

/// Adds ambient light × accessibility.
void add_ambient(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Image<float>& ao,
                 const ShadingParams& params);

}  // namespace umbrameter
