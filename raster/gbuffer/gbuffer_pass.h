// The surfels of a view, drawn: a pass for ids and materials, then one that finds each surfel on its triangle.
#pragma once

#include "core/gbuffer.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "raster/gl/pass.h"
#include "scenes/view.h"

namespace umbrameter {

/// The quantities of GBuffer in textures, bottom row first.
struct GpuGBuffer {
  int width = 0;
  int height = 0;
  gl::Texture ids;               ///< RG32UI: instance, triangle; no_id on background
  gl::Texture position_depth;    ///< RGBA32F: world position, depth along the camera's axis
  gl::Texture geometric_normal;  ///< RGBA32F, the last component unused
  gl::Texture shading_normal;    ///< as geometric_normal
  gl::Texture albedo;            ///< RGBA32F: base colour, metallic
  gl::Texture specular;          ///< RGBA32F: reflectance at normal incidence, perceptual roughness
};

/// Textures of that size with undefined contents.
GpuGBuffer make_gbuffer(int width, int height);

/// Binds ids, position_depth and geometric_normal.
gl::Pass& bind(gl::Pass& pass, const GpuGBuffer& gbuffer);

/// Throws Error (usage) when the view is larger than the device's textures.
GpuGBuffer draw_gbuffer(const gl::Context& context, const UploadedScene& scene, const View& view);

/// Exact copies in both directions: read_back(upload(g)) == g for every GBuffer whose background is zero.
GBuffer read_back(const gl::Context& context, const GpuGBuffer& gbuffer);
GpuGBuffer upload(const gl::Context& context, const GBuffer& gbuffer);

}  // namespace umbrameter
