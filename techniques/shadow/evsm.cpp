#include "techniques/shadow/evsm.h"

#include "core/error.h"
#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

// The square of the exponential is stored: exp(2c) ≤ 65504, the largest half float.
constexpr double max_half_exponent = 5.54;

}  // namespace

Parameters describe(EvsmParams& params) {
  return Description("shadow")
      .field("evsm-positive-exponent", params.positive_exponent,
             // The square of the exponential of the largest is still a 32-bit float, summed over the largest blur.
             {.unit = "1",
              .meaning = "EVSM: exponent c of exp(c·t), t from −1 to 1 over the map's depth range",
              .min = 0.1,
              .max = 42})
      .field("evsm-negative-exponent", params.negative_exponent,
             {.unit = "1", .meaning = "EVSM4: exponent c of the second warp, −exp(−c·t)", .min = 0.1, .max = 42})
      .take();
}

template <int values>
shared::EvsmText::Settings Evsm<values>::settings(const ShadowParams& params) {
  return {values == 4 ? 1 : 0, static_cast<float>(params.evsm.positive_exponent),
          static_cast<float>(params.evsm.negative_exponent), static_cast<float>(params.moment_bound.min_variance),
          static_cast<float>(params.moment_bound.bleeding_reduction)};
}

template <int values>
Prefiltered Evsm<values>::make(const ShadowParams& params, double light_extent) {
  const auto fail = [](std::string_view why) {
    throw Error(ExitCode::usage, "shadow.moment-format", std::string(why), "use 32f");
  };
  const MomentFormat format = params.moment_map.format;
  if (format == MomentFormat::unorm16) fail("EVSM stores exponentials, which unorm16 cannot hold");
  if (format == MomentFormat::f16 && (params.evsm.positive_exponent > max_half_exponent ||
                                      (values == 4 && params.evsm.negative_exponent > max_half_exponent))) {
    fail("16f holds EVSM's exponentials only for exponents up to 5.54");
  }
  return FilteringTechnique<Evsm, shared::EvsmText>::make(params, light_extent);
}

template <int values>
Parameters Evsm<values>::map_parameters(ShadowParams& params) {
  Parameters of_warps = describe(params.evsm);
  if (values == 2) of_warps = select(of_warps, {"shadow.evsm-positive-exponent"});
  return concatenate({FilteredMapParameters::map_parameters(params), of_warps});
}

template struct Evsm<2>;
template struct Evsm<4>;

}  // namespace umbrameter
