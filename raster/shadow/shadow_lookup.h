// What every pass over a shadow map's taps reads, and how it is bound.
#pragma once

#include <cstdint>
#include <string>

#include "core/image.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/shadow/filtered_map.h"
#include "raster/shadow/shadow_map.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

/// One light's map, looked up at every surfel. The scene is the one that the map and the surfels came from.
struct ShadowLookup {
  const UploadedScene& scene;
  const GpuGBuffer& gbuffer;
  const ShadowMap& map;
  const Light& light;
  BiasParams bias;
  ShadowTechnique technique;
  const gl::Texture* truth = nullptr;     ///< made by upload() or upload_truth(); lit from 0.5 on
  const FilteredMap* filtered = nullptr;  ///< where the technique has one
};

/// The taps of a technique that sums comparisons.
const FilterKernel& kernel_of(const ShadowLookup& lookup);

/// One float a pixel.
gl::Texture upload(const gl::Context& context, const Image<float>& image);

/// A truth in which pixels that no statistics count are below 0: they have no wrong taps.
gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility,
                         const Image<PixelExclusion>& counting);

/// The shaders' text that the look-up decides. Biases, offset and radius stay out: a sweep must not compile anew.
std::string lookup_defines(const ShadowLookup& lookup);

/// Binds textures, triangles and the light's block, which lives as long as what is returned. Constant biases, those of
/// bound axes too, are in bias_unit: metres or texels.
[[nodiscard]] gl::Buffer bind(const ShadowLookup& lookup, LengthUnit bias_unit);

/// Room for every pixel, empty, bound: PixelList in shaders/pixel_list.glsl.
/// Throws Error (usage) naming view.size when the device's buffers are too small for it.
[[nodiscard]] gl::Buffer bind_pixel_list(const gl::Context& context, const GpuGBuffer& gbuffer);

/// Runs the program over every pixel, and makes what it wrote visible.
void dispatch_pixels(const gl::Program& program, const GpuGBuffer& gbuffer);

/// How many pixels a program has listed.
std::uint32_t count_listed(const gl::Context& context, const gl::Buffer& pixel_list);

/// A part of a list's pixels: [first, end).
struct ListedPixels {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Runs the program over a part of the bound list, four million pixels at most, and makes what it wrote visible.
void dispatch_list(const gl::Program& program, const ListedPixels& pixels);

/// Runs it over all of the list, in parts that are short work: `steps` is how often a pixel goes through the program's
/// innermost loop.
void dispatch_whole_list(const gl::Context& context, const gl::Program& program, const gl::Buffer& pixel_list,
                         std::size_t steps);

}  // namespace umbrameter
