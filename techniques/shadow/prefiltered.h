// Techniques that filter values of the depth before the look-up: exponential (ESM), variance (VSM), exponential
// variance (EVSM), moment (MSM) and convolution shadow maps (CSM). prefiltered.glsl has their formulas and sources, for
// the shaders too.
#pragma once

#include <vector>

#include "core/math.h"
#include "core/parameters.h"
#include "techniques/shadow/capabilities.h"

namespace umbrameter {
namespace shared {

using glm::cos;
using glm::exp;
using glm::max;
using glm::min;
using glm::sin;
using glm::sqrt;

#define SHARED inline
#include "techniques/shadow/prefiltered.glsl"
#undef SHARED

}  // namespace shared

enum class BlurKernel : int { box, gaussian };
/// Of each value: float, half float or 16-bit normalised integer.
enum class MomentFormat : int { f32, f16, unorm16 };
enum class MomentBound : int { hamburger, hausdorff };

struct EsmParams {
  double exponent = 40.0;
  int blur = 5;
};
Parameters describe(EsmParams& params);

/// What the filtered maps depend on. The kernel is that of ESM too.
struct MomentMapParams {
  BlurKernel kernel = BlurKernel::box;
  int blur = 5;
  MomentFormat format = MomentFormat::f32;
  double positive_exponent = 40.0;
  double negative_exponent = 5.0;
  int terms = 16;
  int samples = 1;
  bool mipmaps = false;
};
Parameters describe(MomentMapParams& params);

/// What only the look-up reads.
struct MomentLookupParams {
  double min_variance = 1e-6;
  double bleeding_reduction = 0.0;
  double moment_bias = 1e-5;
  MomentBound bound = MomentBound::hamburger;
  double ringing_reduction = 1.0;
  double contrast = 2.0;
};
Parameters describe(MomentLookupParams& params);

struct Prefiltered {
  static constexpr TechniqueCapabilities capabilities{};
  shared::PrefilterSettings settings;
  MomentFormat format = MomentFormat::f32;
  std::vector<float> blur;   ///< weights of the kernel along one axis; their sum is not 1
  int groups = 1;            ///< layers per view
  int samples_per_side = 1;  ///< depths along a texel's side, of which a texel's values are the mean
  bool mipmaps = false;      ///< trilinear, by the pixel's footprint in the map
};

/// `technique` is one of the constants of prefiltered.glsl. Throws Error (usage) if the format cannot hold the values.
Prefiltered make_prefiltered(int technique, const EsmParams& esm, const MomentMapParams& map,
                             const MomentLookupParams& lookup);

}  // namespace umbrameter
