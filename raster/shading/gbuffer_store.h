// The compact G-buffer of the deferred path, and the surfels decoded from it.
#pragma once

#include <string>

#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "raster/gl/pass.h"
#include "raster/gl/timer.h"
#include "scenes/view.h"
#include "techniques/shading/light_model.h"

namespace umbrameter {

/// Textures in the formats that shading.* selects; zero on the background.
struct StoredGBuffer {
  ShadingParams formats;         ///< only the members of gbuffer_parameters() matter
  gl::Texture depth;             ///< depth 32F, reversed: 1 at the near plane; rounded to depth-format
  gl::Texture normal;            ///< shading normal
  gl::Texture geometric_normal;  ///< for shadow lookups and AO, in the same format
  gl::Texture diffuse;           ///< rgb: diffuse reflectance
  gl::Texture specular;          ///< rgb: specular reflectance; a: shininess
  gl::Texture position;          ///< world, metres; empty unless shading.position is stored
};

StoredGBuffer store_gbuffer(const gl::Context& context, const GpuGBuffer& surfels, const View& view,
                            const ShadingParams& params);

/// The surfels decoded from the G-buffer. It holds no ids; these are copied from `surfels`. The albedo is the diffuse
/// reflectance, and metallic is 0.
GpuGBuffer decode_surfels(const gl::Context& context, const StoredGBuffer& stored, const GpuGBuffer& surfels,
                          const View& view);

/// The block `Shading` of shaders/shading.glsl.
struct ShadingBlock {
  shared::LightModel model;
  mat4 world_from_clip{1.0f};
  float ambient = 0.0f;
  int light_count = 0;
  int unused[2] = {};
};
static_assert(sizeof(ShadingBlock) == 112);

ShadingBlock make_shading_block(const View& view, const ShadingParams& params, int light_count);

/// The #defines for shaders that include stored_gbuffer.glsl.
std::string stored_gbuffer_defines(const ShadingParams& params);

/// Time of the draws alone, for benchmarks: without uploads, counters and reading back.
struct ShadingTimes {
  gl::PassTime lights;   ///< of the forward path: everything
  gl::PassTime resolve;  ///< of the deferred path
};

/// What the passes of the deferred path read. `surfels` are those that were stored; their ids mark the background.
struct DeferredInput {
  const StoredGBuffer& stored;
  const GpuGBuffer& surfels;
  const View& view;
  const ShadingParams& params;
  ShadingTimes* times = nullptr;  ///< if given, it is filled, and no fragments are counted
};

/// Binds what stored_gbuffer.glsl reads, and the ids.
void bind_stored(gl::Pass& pass, const DeferredInput& input, int light_count);

}  // namespace umbrameter
