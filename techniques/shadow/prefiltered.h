// What techniques that filter values of the depth before the look-up have in common. Each has its own text, a .glsl
// file that the shaders compile as GLSL and its header as C++ with GLM:
//   struct Settings      what its functions read: numbers of 32 bits
//   map_values()         what the map holds for a texel before the blur, a layer at a time
//   visibility_from()    visibility of a receiver from the blurred values of a layer and from what the layer before it
//                        gave; the last layer gives the result
// A depth is the map's depth over its range, 0 to 1. docs/techniques/filtered-maps.md has the formulas.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/math.h"
#include "core/parameters.h"
#include "techniques/shadow/capabilities.h"

namespace umbrameter {
struct ShadowParams;

namespace shared {

using glm::abs;
using glm::clamp;
using glm::cos;
using glm::exp;
using glm::floor;
using glm::log;
using glm::max;
using glm::min;
using glm::pow;
using glm::sin;
using glm::sqrt;

}  // namespace shared

// Of a parameter in the texts.
#define UNUSED [[maybe_unused]]

enum class BlurKernel : int { box, gaussian };
/// Of each value: float, half float or 16-bit normalised integer.
enum class MomentFormat : int { f32, f16, unorm16 };

/// The kernel is that of ESM too.
struct MomentMapParams {
  BlurKernel kernel = BlurKernel::box;
  int blur = 5;
  MomentFormat format = MomentFormat::f32;
};
Parameters describe(MomentMapParams& params);

/// How a map's texels are made and read.
struct MapSamplingParams {
  int samples = 1;
  bool mipmaps = false;
};
Parameters describe(MapSamplingParams& params);

/// Of look-ups that bound the share of lit texels.
struct MomentBoundParams {
  double min_variance = 1e-6;
  double bleeding_reduction = 0.0;
};
Parameters describe(MomentBoundParams& params);

template <class Settings>
std::vector<std::byte> bytes_of(const Settings& settings) {
  static_assert(std::is_trivially_copyable_v<Settings> && alignof(Settings) == 4);
  const auto bytes = std::as_bytes(std::span(&settings, 1));
  return {bytes.begin(), bytes.end()};
}

/// What the passes of such a technique need.
struct Prefiltered {
  static constexpr TechniqueCapabilities capabilities{};
  std::string_view text;            ///< the file of its text
  std::vector<std::byte> settings;  ///< its Settings
  int values = 4;                   ///< of a texel in a layer: 1, 2 or 4
  std::string constants{};          ///< sets those that are constant in the program, as GLSL: "settings.terms = 16;"
  int groups = 1;                   ///< layers per view
  MomentFormat format = MomentFormat::f32;
  std::vector<float> blur{};  ///< weights of the kernel along one axis; their sum is not 1
  int samples_per_side = 1;   ///< depths along a texel's side, of which a texel's values are the mean
  bool mipmaps = false;       ///< trilinear, by the pixel's footprint in the map
};

/// Adds what the parameters say about map and look-up. Throws Error (usage) if moment-samples is no square number.
Prefiltered make_prefiltered(const ShadowParams& params, Prefiltered technique);

/// What most of these techniques read.
struct FilteredMapParameters {
  /// Of the filter.
  static Parameters map_parameters(ShadowParams& params);
  /// Of the look-up only, besides the biases.
  static Parameters lookup_parameters(ShadowParams& params);
};

/// The base of such a technique in the list. Technique has the name of its file as `text`, the number of values in
/// `values`, settings(), and functions instead of those here that do not fit.
template <class Technique, class TextOf>
struct FilteringTechnique : FilteredMapParameters {
  using Text = TextOf;
  static Prefiltered make(const ShadowParams& params, double /*light_extent*/) {
    return make_prefiltered(params, {Technique::text, bytes_of(Technique::settings(params)), Technique::values});
  }
};

template <class Technique>
concept FiltersMap = std::is_base_of_v<FilteredMapParameters, Technique>;

/// Weights of a kernel along one axis.
std::vector<float> blur_weights(BlurKernel kernel, int size);

}  // namespace umbrameter
