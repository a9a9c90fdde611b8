// Draws the shaded image, by the forward or the deferred path.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/shading/gbuffer_store.h"
#include "scenes/view.h"
#include "techniques/shading/light_volume.h"
#include "techniques/shading/parameters.h"
#include "techniques/shading/shaded_image.h"

namespace umbrameter {

/// A light and its visibility at each pixel.
struct LitLight {
  const Light* light = nullptr;
  const Image<float>* visibility = nullptr;
};

/// Of the forward path. The deferred path keeps as many visibility images at a time.
inline constexpr std::size_t lights_per_pass = 16;

struct ForwardInput {
  const UploadedScene& scene;
  const GpuGBuffer& surfels;  ///< the depth pre-pass: which fragments to shade, with their positions and normals
  const View& view;
  const ShadingParams& params;
  ShadingTimes* times = nullptr;  ///< if given, it is filled
};

/// Draws the scene and evaluates every light in the fragment shader, up to lights_per_pass per pass.
ShadedImage draw_forward(const gl::Context& context, const ForwardInput& input, std::span<const LitLight> lights,
                         const Image<float>& ao);

/// Shades the surfels of the G-buffer: draws each light over its volume, or over the whole image if it has none, and
/// adds it to a light buffer of 32-bit floats.
ShadedImage draw_deferred(const gl::Context& context, const DeferredInput& input, std::span<const LitLight> lights,
                          const Image<float>& ao);

}  // namespace umbrameter
