#include "techniques/shadow/prefiltered.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> kernel_names{"box", "gaussian"};
constexpr std::array<std::string_view, 3> moment_format_names{"32f", "16f", "unorm16"};
constexpr std::array<std::string_view, 2> bound_names{"hamburger", "hausdorff"};

// The square of the exponential is stored: exp(2c) ≤ 65504, the largest half float.
constexpr double max_half_exponent = 5.54;

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

void require_format(int technique, const MomentMapParams& map) {
  const auto fail = [](std::string_view why) {
    throw Error(ExitCode::usage, "shadow.moment-format", std::string(why), "use 32f");
  };
  if (technique != shared::EVSM2 && technique != shared::EVSM4) return;
  if (map.format == MomentFormat::unorm16) fail("EVSM stores exponentials, which unorm16 cannot hold");
  if (map.format == MomentFormat::f16 && (map.positive_exponent > max_half_exponent ||
                                          (technique == shared::EVSM4 && map.negative_exponent > max_half_exponent))) {
    fail("16f holds EVSM's exponentials only for exponents up to 5.54");
  }
}

}  // namespace

Parameters describe(EsmParams& params) {
  return Description("shadow")
      .field("esm-exponent", params.exponent,
             // The exponential of the largest is still a 32-bit float, summed over the largest blur.
             {.unit = "1", .meaning = "ESM: exponent over the map's depth range", .min = 1, .max = 80})
      .field("esm-blur", params.blur,
             {.unit = "texels", .meaning = "ESM: side of the blur of the map", .min = 1, .max = 63, .odd = true})
      .take();
}

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
      .field("evsm-positive-exponent", params.positive_exponent,
             // The square of the exponential of the largest is still a 32-bit float, summed over the largest blur.
             {.unit = "1",
              .meaning = "EVSM: exponent c of exp(c·t), t from −1 to 1 over the map's depth range",
              .min = 0.1,
              .max = 42})
      .field("evsm-negative-exponent", params.negative_exponent,
             {.unit = "1", .meaning = "EVSM4: exponent c of the second warp, −exp(−c·t)", .min = 0.1, .max = 42})
      .field("csm-terms", params.terms,
             {.unit = "1", .meaning = "CSM: terms of the Fourier series, two to a layer", .min = 1, .max = 16})
      .field("moment-samples", params.samples,
             {.unit = "1",
              .meaning = "filtered maps: depths in a texel whose values are averaged, a square number",
              .min = 1,
              .max = 16})
      .field("moment-mipmaps", params.mipmaps,
             {.unit = {}, .meaning = "filtered maps: trilinear look-up by the pixel's footprint in the map"})
      .take();
}

Parameters describe(MomentLookupParams& params) {
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
      .field("msm-moment-bias", params.moment_bias,
             {.unit = "1",
              .meaning = "MSM: share of ½ in each moment, against rounding; about 6e-5 for unorm16",
              .min = 0,
              .max = 0.1})
      .choice("msm-bound", params.bound, bound_names,
              {.unit = {}, .meaning = "MSM: hausdorff uses that no depth lies outside the map's range"})
      .field(
          "csm-ringing-reduction", params.ringing_reduction,
          {.unit = "1", .meaning = "CSM: a in the weight exp(−a·(k/M)²) of the k-th of M terms", .min = 0, .max = 10})
      .field("csm-contrast", params.contrast,
             {.unit = "1", .meaning = "CSM: factor of the series, which is ½ at the occluder", .min = 1, .max = 10})
      .take();
}

Prefiltered make_prefiltered(int technique, const EsmParams& esm, const MomentMapParams& map,
                             const MomentLookupParams& lookup) {
  require_format(technique, map);
  const bool is_esm = technique == shared::ESM;
  Prefiltered made;
  made.format = is_esm ? MomentFormat::f32 : map.format;
  made.blur = blur_weights(map.kernel, is_esm ? esm.blur : map.blur);
  made.settings = {technique,
                   made.format == MomentFormat::unorm16 ? 1 : 0,
                   lookup.bound == MomentBound::hausdorff ? 1 : 0,
                   map.terms,
                   vec2(is_esm ? esm.exponent : map.positive_exponent, map.negative_exponent),
                   static_cast<float>(lookup.min_variance),
                   static_cast<float>(lookup.bleeding_reduction),
                   static_cast<float>(lookup.moment_bias),
                   static_cast<float>(lookup.ringing_reduction),
                   static_cast<float>(lookup.contrast)};
  made.mipmaps = map.mipmaps;
  made.samples_per_side = static_cast<int>(std::lround(std::sqrt(map.samples)));
  if (made.samples_per_side * made.samples_per_side != map.samples) {
    throw Error(ExitCode::usage, "shadow.moment-samples", std::to_string(map.samples) + " is no square number",
                "choose 1, 4, 9 or 16");
  }
  if (technique == shared::CSM) made.groups = (map.terms + 1) / 2;
  return made;
}

}  // namespace umbrameter
