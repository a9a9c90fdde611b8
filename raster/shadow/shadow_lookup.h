// The inputs of every pass that looks up a shadow map, and the functions that make and run such passes.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/gl/pass.h"
#include "raster/shadow/shadow_map.h"
#include "scenes/view.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
struct TechniqueMap;

/// One light's map, looked up at every surfel. Map and surfels must be those of `scene`.
struct ShadowLookup {
  const UploadedScene& scene;
  const GpuGBuffer& gbuffer;
  const ShadowMap& map;
  const Light& light;
  BiasParams bias;
  ShadowTechnique technique;
  const gl::Texture* truth = nullptr;   ///< from upload() or upload_truth(); lit if ≥ 0.5
  const TechniqueMap* drawn = nullptr;  ///< filter_map(); only PCF's techniques need none
  const View* view = nullptr;           ///< that of the surfels, for techniques that read the camera's depth
};

/// The kernel of the look-up's technique, which sums comparisons.
const FilterKernel& kernel_of(const ShadowLookup& lookup);

/// A texture with one float per pixel.
gl::Texture upload(const gl::Context& context, const Image<float>& image);

/// Uploads a truth. Pixels that are not counted get a value below 0, and passes find no wrong taps there.
gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility,
                         const Image<PixelExclusion>& exclusion);

/// A pass over a look-up, with the map, the light, the surfels, the scene and, if there is one, the truth bound.
/// Biases, normal offset and radius are uniforms, so that a sweep over them does not recompile shaders. bias_unit is
/// the unit of constant biases, including those of axes: metres or texels.
gl::Pass lookup_pass(const gl::Context& context, const ShadowLookup& lookup, LengthUnit bias_unit,
                     const gl::ProgramSource& source);

/// An empty list with room for every pixel: PixelList in shaders/pixel_list.glsl.
/// Throws Error (usage) naming view.size if the list exceeds the device's maximum buffer size.
[[nodiscard]] gl::Buffer make_pixel_list(const gl::Context& context, const GpuGBuffer& gbuffer);

/// Number of pixels in the list.
std::uint32_t count_listed(const gl::Context& context, const gl::Buffer& pixel_list);

/// A range of a list's pixels: [first, end).
struct ListedPixels {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Runs the pass over a range of its list, at most four million pixels.
void dispatch_list(gl::Pass& pass, const ListedPixels& pixels);

/// Runs the pass over its whole list, in dispatches that are short enough for the driver's watchdog. `steps` is the
/// number of iterations of the shader's innermost loop per pixel.
void dispatch_whole_list(const gl::Context& context, gl::Pass& pass, const gl::Buffer& pixel_list, std::size_t steps);

}  // namespace umbrameter
