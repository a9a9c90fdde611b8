// The techniques of ambient occlusion. A technique holds the parameters that it reads. Other code depends on these,
// never on its name.
//
// AoTechniques is the only list: choice, names, dispatch and build follow from it. A technique is a struct with its
// name, its title and the denoiser that it was published with. Its members are groups of AoParams that it reads;
// `reads_samples = false` leaves out ao.samples. Its header, with settings_of(), is included here; the source and the
// text (.glsl) of the same name are built with it. The text gives accessibility() and, if the struct has_bent_normal,
// bent_normal(); raster/ao/ao_passes.h runs it. Parameters of a new technique become a member of AoParams.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/parameters.h"
#include "core/type_list.h"
#include "techniques/ao/alchemy.h"
#include "techniques/ao/bitmask.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/crytek.h"
#include "techniques/ao/gtao.h"
#include "techniques/ao/hbao.h"
#include "techniques/ao/inputs.h"
#include "techniques/ao/kernel.h"
#include "techniques/ao/marched.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/resolution.h"
#include "techniques/ao/ssao.h"
#include "techniques/ao/tone.h"

namespace umbrameter {

using AoTechniques = TypeList<Ssao, Gtao, Hbao, Alchemy, Crytek, Bitmask, Marched>;

/// The ao.* parameters: those that techniques share, those of each technique, and those of what follows.
struct AoParams {
  AoSamplingParams sampling;
  AoBiasParams bias;
  AoNoiseParams noise;
  AoInputParams inputs;
  AoTechniques::Choice technique = AoTechniques::choice<Ssao>;
  SsaoParams ssao;
  AoKernelParams kernel;
  AoSliceParams slices;
  GtaoParams gtao;
  HbaoParams hbao;
  AlchemyParams alchemy;
  BitmaskParams bitmask;
  MarchedParams marched;
  AoBlurParams blur;
  AoResolutionParams resolution;
  AoToneParams tone;

  /// All members, in the order of the documentation.
  auto groups() {
    return std::tie(sampling, bias, noise, inputs, technique, ssao, kernel, slices, gtao, hbao, alchemy, bitmask,
                    marched, blur, resolution, tone);
  }
};
Parameters describe(AoParams& params);

/// Converts all lengths to metres, as draw_ao() expects. scene_size is the diagonal of the scene's bounds, metres.
AoParams in_metres(AoParams params, double scene_size);

using AoTechnique = AoTechniques::Variant<std::type_identity_t>;

/// The chosen technique. Those members of `params` whose types it has as parameters are copied into it.
AoTechnique make_technique(AoParams params);

/// The parameters that the technique reads.
Parameters describe(AoTechnique& technique);

/// The blur that follows the technique: that of the parameters, or its own.
AoBlurParams blur_of(const AoParams& params);

struct AoCapabilities {
  bool flips_at_bias = false;       ///< each sample occludes up to a critical value of ao.bias, and adds to a sum
  bool samples_are_prefix = false;  ///< n samples are the first n of more samples
  int depth_levels = 0;             ///< of the depth pyramid that it reads, beyond the depth buffer
};
AoCapabilities capabilities_of(const AoTechnique& technique);

/// The points of the technique's kernel, in the unit hemisphere around +z; none if it has no such kernel.
std::vector<vec4> kernel_of(const AoTechnique& technique, std::uint32_t seed);

/// The technique's noise: a tile of noise.size × noise.size texels, row by row from the top left. Rotation vectors of
/// hemisphere SSAO, else pairs of numbers from 0 to 1 (noise.h).
std::vector<vec4> noise_of(const AoTechnique& technique, std::uint32_t seed);

/// What it samples in each pixel: "64 samples", "3 slices × 2 × 3 steps".
std::string sampling_text(AoTechnique technique);

/// The technique's name in titles.
std::string_view title_of(const AoTechnique& technique);

}  // namespace umbrameter
