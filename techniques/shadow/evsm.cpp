#include "techniques/shadow/evsm.h"

#include "core/error.h"
#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

// The square of the exponential is stored: exp(2c) ≤ 65504, the largest half float.
constexpr double max_half_exponent = 5.54;

shared::EvsmText::Settings evsm_settings(const ShadowParams& params, bool has_second_warp) {
  return {has_second_warp ? 1 : 0, static_cast<float>(params.evsm.positive_exponent),
          static_cast<float>(params.evsm.negative_exponent), static_cast<float>(params.moment_bound.min_variance),
          static_cast<float>(params.moment_bound.bleeding_reduction)};
}

Prefiltered make_evsm(const ShadowParams& params, bool has_second_warp) {
  const auto fail = [](std::string_view why) {
    throw Error(ExitCode::usage, "shadow.moment-format", std::string(why), "use 32f");
  };
  const MomentFormat format = params.moment_map.format;
  if (format == MomentFormat::unorm16) fail("EVSM stores exponentials, which unorm16 cannot hold");
  if (format == MomentFormat::f16 && (params.evsm.positive_exponent > max_half_exponent ||
                                      (has_second_warp && params.evsm.negative_exponent > max_half_exponent))) {
    fail("16f holds EVSM's exponentials only for exponents up to 5.54");
  }
  return make_prefiltered(params, "evsm.glsl", bytes_of(evsm_settings(params, has_second_warp)),
                          has_second_warp ? 4 : 2);
}

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

Evsm2::Text::Settings Evsm2::settings(const ShadowParams& params) { return evsm_settings(params, false); }
Evsm4::Text::Settings Evsm4::settings(const ShadowParams& params) { return evsm_settings(params, true); }

Prefiltered Evsm2::make(const ShadowParams& params, double) { return make_evsm(params, false); }
Prefiltered Evsm4::make(const ShadowParams& params, double) { return make_evsm(params, true); }

Parameters Evsm2::map_parameters(ShadowParams& params) {
  return concatenate({moment_map_parameters(params), select(describe(params.evsm), {"shadow.evsm-positive-exponent"})});
}
Parameters Evsm4::map_parameters(ShadowParams& params) {
  return concatenate({moment_map_parameters(params), describe(params.evsm)});
}

Parameters Evsm2::lookup_parameters(ShadowParams& params) { return describe(params.moment_bound); }
Parameters Evsm4::lookup_parameters(ShadowParams& params) { return describe(params.moment_bound); }

}  // namespace umbrameter
