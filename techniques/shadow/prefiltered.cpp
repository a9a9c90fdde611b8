#include "techniques/shadow/prefiltered.h"

#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> kernel_names{"box", "gaussian"};
constexpr std::array<std::string_view, 3> moment_format_names{"32f", "16f", "unorm16"};

}  // namespace

Parameters describe(MomentMapParams& params) {
  return Description("shadow")
      .choice("blur-kernel", params.kernel, kernel_names,
              {.unit = {}, .meaning = "filtered maps: kernel of the blur of the map"})
      .field("moment-blur", params.blur,
             {.unit = "texels",
              .meaning = "filtered maps except ESM: side of the blur of the map",
              .min = 1,
              .max = 63,
              .odd = true})
      .choice("moment-format", params.format, moment_format_names,
              {.unit = {}, .meaning = "filtered maps except ESM: format; unorm16 is not for EVSM"})
      .take();
}

Parameters describe(MapSamplingParams& params) {
  return Description("shadow")
      .field("moment-samples", params.samples,
             {.unit = "1",
              .meaning = "filtered maps: depths per texel whose stored values are averaged: 1, 4, 9 or 16",
              .min = 1,
              .max = 16})
      .field("moment-mipmaps", params.mipmaps,
             {.unit = {}, .meaning = "filtered maps: trilinear look-up by the pixel's footprint in the map"})
      .take();
}

Parameters describe(MomentBoundParams& params) {
  return Description("shadow")
      .field("min-variance", params.min_variance,
             // Times the square of the largest slope of a warp, the largest is still a 32-bit float.
             {.unit = "1",
              .meaning = "VSM and EVSM: least variance of the depth, as a share of the square of the map's depth range",
              .min = 0,
              .max = 0.01})
      .field("bleeding-reduction", params.bleeding_reduction,
             {.unit = "1",
              .meaning = "VSM, EVSM and MSM: visibility up to which all is dark (GPU Gems 3, chapter 8)",
              .min = 0,
              .max = 0.99})
      .take();
}

Prefiltered make_prefiltered(const ShadowParams& params, Prefiltered technique) {
  technique.format = params.moment_map.format;
  technique.blur = blur_weights(params.moment_map.kernel, params.moment_map.blur);
  technique.mipmaps = params.map_sampling.mipmaps;
  const int samples = params.map_sampling.samples;
  technique.samples_per_side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (technique.samples_per_side * technique.samples_per_side != samples) {
    throw Error(ExitCode::usage, "shadow.moment-samples", std::to_string(samples) + " is no square number",
                "choose 1, 4, 9 or 16");
  }
  return technique;
}

// The Gaussian is as wide as that of PCF (filter.cpp), with unrounded weights.
std::vector<float> blur_weights(BlurKernel kernel, int size) {
  std::vector<float> weights;
  const int middle = size / 2;
  for (int i = 0; i < size; ++i) {
    const double x = (i - middle) / ((size + 1) / 6.0);
    weights.push_back(kernel == BlurKernel::box ? 1.0f : static_cast<float>(std::exp(-0.5 * x * x)));
  }
  return weights;
}

Parameters FilteredMapParameters::map_parameters(ShadowParams& params) {
  return concatenate({describe(params.moment_map), describe(params.map_sampling)});
}

Parameters FilteredMapParameters::lookup_parameters(ShadowParams& params) { return describe(params.moment_bound); }

}  // namespace umbrameter
