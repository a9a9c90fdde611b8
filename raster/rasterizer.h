// The OpenGL side in one header: what raster offers to the rest of the toolkit.
#pragma once

#include "core/gbuffer.h"
#include "core/image.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "raster/parameters.h"
#include "raster/uploaded_scene.h"
#include "scenes/light_frame.h"
#include "scenes/view.h"

namespace umbrameter {

/// The surfels of a view in GPU textures (row 0 of the texture is the bottom row of the image).
struct GpuGBuffer;  // raster/gbuffer_pass.h
/// One light's depths and triangle ids in GPU textures.
struct ShadowMap;  // raster/shadow_map.h

GpuGBuffer draw_gbuffer(const gl::Context& context, const UploadedScene& scene, const View& view);
GBuffer read_back(const gl::Context& context, const GpuGBuffer& gbuffer);
GpuGBuffer upload(const gl::Context& context, const GBuffer& gbuffer);

ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const LightFrame& frame, const ShadowParams& params);

/// What a light's map says of each surfel.
struct RasterVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked; 0 where turned away, 1 on background
  /// Share of wrong taps by cause, in x acne, y false occlusion, z peter-panning, w light leak; 0 without a truth.
  /// Their sum is |visibility − truth| where the truth is binary.
  Image<vec4> classes;
};
RasterVisibility draw_visibility(const gl::Context& context, const UploadedScene& scene, const GpuGBuffer& gbuffer,
                                 const ShadowMap& map, const Light& light, const ShadowParams& params,
                                 const gl::Texture* truth);
gl::Texture upload(const gl::Context& context, const Image<float>& image);

/// Screen-space ambient occlusion: accessibility, 1 open and on background, after its blur.
Image<float> draw_ao(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                     std::uint32_t seed);

}  // namespace umbrameter
