// What every pass over a shadow map's taps reads, and how it is bound.
#pragma once

#include <string>

#include "core/image.h"
#include "raster/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "raster/parameters.h"
#include "raster/shadow_map.h"
#include "raster/uploaded_scene.h"
#include "scenes/light_frame.h"

namespace umbrameter {

/// One light's map, looked up at every surfel. The scene is the one that the map and the surfels came from.
struct ShadowLookup {
  const UploadedScene& scene;
  const GpuGBuffer& gbuffer;
  const ShadowMap& map;
  const Light& light;
  const ShadowParams& params;
  const gl::Texture* truth = nullptr;  ///< made by upload() or upload_truth(); lit from 0.5 on
};

/// One float a pixel.
gl::Texture upload(const gl::Context& context, const Image<float>& image);

/// A truth in which pixels that no statistics count are below 0: they have no wrong taps.
gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility, const Image<Counting>& counting);

/// The shaders' text that the look-up decides. Biases, offset and radius stay out: a sweep must not compile anew.
std::string lookup_defines(const ShadowLookup& lookup);

/// Binds textures, triangles and the light's block, which lives as long as what is returned.
[[nodiscard]] gl::Buffer bind(const ShadowLookup& lookup);

/// Room for every pixel, empty, bound: PixelList in shaders/pixel_list.glsl.
[[nodiscard]] gl::Buffer bind_pixel_list(const GpuGBuffer& gbuffer);

/// Runs the program over every pixel, and makes what it wrote visible.
void dispatch_pixels(const gl::Program& program, const GpuGBuffer& gbuffer);

/// Runs the program over a list's pixels.
void dispatch_list(const gl::Program& program, const gl::Buffer& pixel_list);

}  // namespace umbrameter
