// The inputs of every pass that looks up a shadow map, and the functions that bind them.
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

/// One light's map, looked up at every surfel. Map and surfels must be those of `scene`.
struct ShadowLookup {
  const UploadedScene& scene;
  const GpuGBuffer& gbuffer;
  const ShadowMap& map;
  const Light& light;
  BiasParams bias;
  ShadowTechnique technique;
  const gl::Texture* truth = nullptr;     ///< from upload() or upload_truth(); lit if ≥ 0.5
  const FilteredMap* filtered = nullptr;  ///< nullptr if the technique has none
};

/// The kernel of a technique that sums comparisons.
const FilterKernel& kernel_of(const ShadowLookup& lookup);

/// A texture with one float per pixel.
gl::Texture upload(const gl::Context& context, const Image<float>& image);

/// Uploads a truth. Pixels that are not counted get a value below 0, and passes find no wrong taps there.
gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility,
                         const Image<PixelExclusion>& exclusion);

/// The #defines for a look-up. Biases, normal offset and radius are uniforms, so that a sweep over them does not
/// recompile shaders.
std::string lookup_defines(const ShadowLookup& lookup);

/// Binds textures, triangles and the light's block, and returns the block's buffer, which must outlive the pass.
/// bias_unit is the unit of constant biases, including those of bound axes: metres or texels.
[[nodiscard]] gl::Buffer bind(const ShadowLookup& lookup, LengthUnit bias_unit);

/// Makes and binds an empty list with room for every pixel: PixelList in shaders/pixel_list.glsl.
/// Throws Error (usage) naming view.size if the list exceeds the device's maximum buffer size.
[[nodiscard]] gl::Buffer bind_pixel_list(const gl::Context& context, const GpuGBuffer& gbuffer);

/// Runs the program over every pixel, then issues a memory barrier.
void dispatch_pixels(const gl::Program& program, const GpuGBuffer& gbuffer);

/// Number of pixels in the list.
std::uint32_t count_listed(const gl::Context& context, const gl::Buffer& pixel_list);

/// A range of a list's pixels: [first, end).
struct ListedPixels {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Runs the program over a range of the bound list, at most four million pixels, then issues a memory barrier.
void dispatch_list(const gl::Program& program, const ListedPixels& pixels);

/// Runs the program over the whole list, in dispatches that are short enough for the driver's watchdog. `steps` is the
/// number of iterations of the program's innermost loop per pixel.
void dispatch_whole_list(const gl::Context& context, const gl::Program& program, const gl::Buffer& pixel_list,
                         std::size_t steps);

}  // namespace umbrameter
