// Shadow-map look-ups for every surfel, and which cause each wrong tap has.
#pragma once

#include "core/image.h"
#include "core/math.h"
#include "raster/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "raster/parameters.h"
#include "raster/shadow_map.h"
#include "raster/uploaded_scene.h"

namespace umbrameter {

/// What a light's map says of each surfel.
struct RasterVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked; 0 where turned away, 1 on background; lit off the map
  /// Share of wrong taps by cause, in x acne, y false occlusion, z peter-panning, w light leak; 0 on background and
  /// where turned away, and everywhere without a truth. Their sum is |visibility − truth| where the truth is binary.
  Image<vec4> classes;
};

/// The truth, where given, is a texture made by upload(): lit from 0.5 on. The scene is the one that the map and the
/// surfels came from.
RasterVisibility draw_visibility(const gl::Context& context, const UploadedScene& scene, const GpuGBuffer& gbuffer,
                                 const ShadowMap& map, const Light& light, const ShadowParams& params,
                                 const gl::Texture* truth);

/// One float a pixel, as draw_visibility() takes its truth.
gl::Texture upload(const gl::Context& context, const Image<float>& image);

}  // namespace umbrameter
