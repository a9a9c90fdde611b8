// What both shading paths need: the buffer of lights, and the reading of colours. Internal to raster/shading/.
#pragma once

#include <span>

#include "core/image.h"
#include "raster/gl/objects.h"
#include "raster/shading/shading_pass.h"

namespace umbrameter {

/// The block `Lights` of shaders/shading.glsl.
gl::Buffer make_light_buffer(std::span<const LitLight> lights);

/// The red, green and blue of an rgba32f texture.
Image<vec3> read_colors(const gl::Texture& texture);

}  // namespace umbrameter
