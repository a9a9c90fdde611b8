// Prefiltered shadow maps against the exact share of lit texels. The shaders compile the same formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/error.h"
#include "tests/techniques/prefiltered_depths.h"

namespace umbrameter {
namespace {

using namespace test;

// CSM's is none.
constexpr std::array bounds{ShadowTechniques::choice<Vsm>, ShadowTechniques::choice<Evsm2>,
                            ShadowTechniques::choice<Evsm4>, ShadowTechniques::choice<Msm>};

TEST(Prefiltered, No_bound_is_darker_than_the_share_of_lit_texels) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform;
  std::size_t checked = 0;
  std::size_t loose = 0;
  for (int round = 0; round < 20000; ++round) {
    // From one to ten surfaces, near one another or not, and a receiver among them.
    Depths surfaces(1 + random() % 10);
    const float first = uniform(random) * 0.5f;
    const float spread = round % 2 == 0 ? 0.5f : 0.05f;
    for (float& z : surfaces) z = first + spread * uniform(random);
    Depths depths(25);
    for (float& z : depths) z = surfaces[random() % surfaces.size()];
    const float depth = round % 3 == 0 ? surfaces[0] : first + spread * uniform(random);
    for (const auto technique : bounds) {
      const PrefilteredText text = text_of(with(technique));
      // A moment is rounded when it is stored and when it is averaged, and the formula adds as much again.
      const float rounding = change_by_rounding(mean_of(depths, text), depth, text, 4 * half_ulp);
      const double tolerance = 1e-5 + static_cast<double>(rounding);  // MSM's bias takes at most 1e-5
      EXPECT_GE(visibility(depths, depth, with(technique)), exact(depths, depth) - tolerance)
          << name_of(technique) << " " << round;
      if (tolerance > 0.002) ++loose;
      ++checked;
    }
  }
  EXPECT_LT(loose, checked / 50);
}

float fourier_visibility(float z, float depth, const ShadowParams& params) {
  const PrefilteredText text = text_of(params);
  float visibility = 0.0f;
  for (int layer = 0; 2 * layer < params.csm_map.terms; ++layer) {
    visibility = text.visibility_from(dvec4(text.map_values(z, layer)), static_cast<double>(depth), layer, visibility);
  }
  return visibility;
}

TEST(Prefiltered, Csm_is_the_fourier_series_of_a_step) {
  for (const int terms : {1, 2, 5, 16}) {
    for (const double a : {0.0, 1.0}) {
      for (const bool is_quantized : {false, true}) {
        ShadowParams params = with(ShadowTechniques::choice<Csm>);
        params.csm_map.terms = terms;
        params.moment_map.format = is_quantized ? MomentFormat::unorm16 : MomentFormat::f32;
        params.csm_lookup.ringing_reduction = a;
        EXPECT_NEAR(fourier_visibility(0.4f, 0.4f, params), 1.0f, 1e-5f) << terms;
        for (const double gap : {-0.3, -0.01, 0.004, 0.03, 0.2, 0.5}) {
          double series = 0.5;
          for (int k = 1; k <= terms; ++k) {
            const double c = pi * (2 * k - 1);
            series -= 2.0 / c * std::exp(-a * k * k / (terms * terms)) * std::sin(c * gap);
          }
          const double expected = std::clamp(2.0 * series, 0.0, 1.0);
          EXPECT_NEAR(fourier_visibility(0.4f, static_cast<float>(0.4 + gap), params), expected, 5e-5)
              << terms << " " << gap;
        }
      }
    }
  }
}

TEST(Prefiltered, Csm_converges_to_the_hard_shadow_as_its_terms_grow) {
  // The M-th partial sum of the step differs from it by at most 1/(π·M·sin(π·gap)) (summation by parts), twice that
  // with the contrast of 2.
  ShadowParams params = with(ShadowTechniques::choice<Csm>);
  params.csm_lookup.ringing_reduction = 0.0;
  for (const int terms : {1, 2, 4, 8, 16}) {
    params.csm_map.terms = terms;
    for (const double gap : {0.02, 0.05, 0.1, 0.3, 0.5, 0.8}) {
      const double bound = 2.0 / (pi * terms * std::sin(pi * gap));
      EXPECT_LE(fourier_visibility(0.1f, static_cast<float>(0.1 + gap), params), bound) << terms << " " << gap;
    }
  }
}

TEST(Prefiltered, A_map_of_one_depth_gives_a_hard_step) {
  ShadowParams sharp;
  sharp.moment_bound.min_variance = 1e-9;
  constexpr float gap = 0.005f;
  for (const float z : {0.1f, 0.37f, 0.5f, 0.9f}) {
    for (const auto technique : bounds) {
      const ShadowParams params = with(technique, sharp);
      EXPECT_NEAR(visibility({z}, z - gap, params), 1.0f, 1e-4f) << name_of(technique) << " " << z;
      // MSM's bias mixes a depth of 0 and one of 1 into the map. The variance V of the mixture is α·(½ − z + z²), and
      // no bound from moments exceeds Chebyshev's V/(V + gap²), here 0.07 to 0.14. For the others V is 1e-9.
      const double z_exact = static_cast<double>(z);
      const double variance = technique == ShadowTechniques::choice<Msm>
                                  ? MsmParams{}.moment_bias * (0.5 - z_exact + z_exact * z_exact)
                                  : 1e-9;
      const double bound = variance / (variance + static_cast<double>(gap) * static_cast<double>(gap));
      EXPECT_LT(visibility({z}, z + gap, params), bound + 0.01) << name_of(technique) << " " << z;
    }
  }
}

TEST(Prefiltered, Behind_one_depth_the_least_variance_alone_gives_light) {
  ShadowParams params;
  params.moment_bound.min_variance = 1e-4;
  for (const double gap : {0.005, 0.01, 0.03}) {
    const auto depth = static_cast<float>(0.4 + gap);
    EXPECT_NEAR(visibility({0.4f}, depth, with(ShadowTechniques::choice<Vsm>, params)), 1e-4 / (1e-4 + gap * gap),
                1e-3);
    for (const double exponent : {0.2, 5.0, 20.0}) {
      // Over the gap the warp w grows to w·exp(2c·gap), and its slope is 2c·w.
      const double growth = std::expm1(2.0 * exponent * gap);
      const double variance = 1e-4 * 4.0 * exponent * exponent;
      params.evsm.positive_exponent = exponent;
      const PrefilteredText text = text_of(with(ShadowTechniques::choice<Evsm2>, params));
      const float rounding = change_by_rounding(mean_of({0.4f}, text), depth, text, 2 * half_ulp);
      EXPECT_NEAR(visibility({0.4f}, depth, with(ShadowTechniques::choice<Evsm2>, params)),
                  variance / (variance + growth * growth), 1e-3 + static_cast<double>(rounding))
          << gap << " " << exponent;
    }
  }
}

TEST(Prefiltered, Far_behind_one_depth_the_least_variance_gives_no_light) {
  for (const auto technique :
       {ShadowTechniques::choice<Vsm>, ShadowTechniques::choice<Evsm2>, ShadowTechniques::choice<Evsm4>}) {
    EXPECT_LT(visibility({0.3f}, 0.7f, with(technique)), 1e-4f) << name_of(technique);
  }
}

TEST(Prefiltered, Parameters_at_their_limits_give_a_visibility) {
  ShadowParams params;
  const auto set_all = [](const Parameters& parameters, bool is_max) {
    for (const Parameter& parameter : parameters) {
      const double limit = is_max ? parameter.description.max : parameter.description.min;
      if (auto* const* number = std::get_if<double*>(&parameter.field)) **number = limit;
    }
  };
  for (const bool map_at_max : {false, true}) {
    for (const bool lookup_at_max : {false, true}) {
      set_all(filtered_map_parameters(params), map_at_max);
      for (const auto technique : bounds) {
        params.technique = technique;
        set_all(lookup_parameters(params), lookup_at_max);
        for (const Depths& depths : {Depths{0.0f}, Depths{1.0f}, Depths{0.0f, 1.0f}, Depths{0.3f, 0.4f, 1.0f}}) {
          for (const float depth : {0.0f, 0.3f, 0.999f, 1.0f, 1.01f}) {
            const float found = visibility(depths, depth, params);
            EXPECT_TRUE(found >= 0.0f && found <= 1.0f) << name_of(technique) << " " << depth << " " << found;
          }
        }
      }
    }
  }
}

TEST(Prefiltered, Esm_converges_to_the_hard_shadow_as_its_exponent_grows) {
  // exp(−c·gap) behind all depths, and 1 in front of them. 80, the limit of the parameter, is the last whole tenth
  // before a sum of 63² exponentials exceeds a 32-bit float.
  for (const float gap : {0.01f, 0.1f, 0.5f}) {
    for (const double exponent : {1.0, 5.0, 20.0, 80.0}) {
      ShadowParams params = with(ShadowTechniques::choice<Esm>);
      params.esm = {exponent, 1};
      const double expected = std::exp(-exponent * static_cast<double>(gap));
      EXPECT_NEAR(visibility({0.4f}, 0.4f + gap, params), expected, 1e-5) << gap << " " << exponent;
      EXPECT_EQ(visibility({0.4f}, 0.4f - gap, params), 1.0f) << gap << " " << exponent;
    }
  }
}

TEST(Prefiltered, Evsm_converges_to_the_hard_shadow_as_its_exponents_grow) {
  // Two occluders and the lit receiver itself; and a receiver behind all three.
  const Depths depths{0.3f, 0.3f, 0.3f, 0.55f, 0.55f, 0.8f, 0.8f, 0.8f};
  ShadowParams params;
  params.moment_bound.min_variance = 1e-9;
  for (const auto technique : {ShadowTechniques::choice<Evsm2>, ShadowTechniques::choice<Evsm4>}) {
    params.technique = technique;
    for (const float depth : {0.8f, 0.9f}) {
      double last = 1.0;
      for (const double exponent : {0.1, 2.0, 5.0, 10.0, 20.0}) {
        params.evsm = {exponent, exponent};
        const double error = visibility(depths, depth, params) - exact(depths, depth);
        EXPECT_LT(error, last) << exponent;
        last = error;
      }
      EXPECT_LT(last, 0.02) << name_of(technique) << " " << depth;
    }
  }
  // Between the occluders only the second warp has the answer.
  params.evsm = {20.0, 20.0};
  EXPECT_GT(visibility(depths, 0.45f, with(ShadowTechniques::choice<Evsm2>, params)), 0.99f);
  EXPECT_NEAR(visibility(depths, 0.45f, with(ShadowTechniques::choice<Evsm4>, params)), exact(depths, 0.45f), 0.02);
}

TEST(Prefiltered, Quantised_moments_are_in_range_and_read_back) {
  for (int i = 0; i <= 1000; ++i) {
    const float z = static_cast<float>(i) / 1000.0f;
    const vec4 moments(z, z * z, z * z * z, z * z * z * z);
    const vec4 code = shared::MsmText::quantized_moments(moments);
    const vec4 back = shared::MsmText::moments_of_quantized(code);
    for (int k = 0; k < 4; ++k) {
      EXPECT_GE(code[k], -1e-4f) << z;
      EXPECT_LE(code[k], 1.0001f) << z;
      EXPECT_NEAR(back[k], moments[k], 1e-5f) << z;
    }
  }
}

TEST(Prefiltered, Bleeding_reduction_keeps_full_light_and_blackens_up_to_its_value) {
  EXPECT_EQ(shared::MsmText::reduce_bleeding(1.0, 0.3), 1.0);
  EXPECT_EQ(shared::MsmText::reduce_bleeding(0.3, 0.3), 0.0);
  EXPECT_EQ(shared::MsmText::reduce_bleeding(0.1, 0.3), 0.0);
  EXPECT_NEAR(shared::MsmText::reduce_bleeding(0.65, 0.3), 0.5, 1e-12);
  EXPECT_EQ(shared::MsmText::reduce_bleeding(0.37, 0.0), 0.37);
}

TEST(Prefiltered, A_format_that_cannot_hold_the_values_is_an_error) {
  ShadowParams params;
  const auto make = [&]<class T>(std::type_identity<T>) { return T::make(params, 0.0); };
  constexpr std::type_identity<Evsm2> evsm2;
  constexpr std::type_identity<Evsm4> evsm4;
  params.moment_map.format = MomentFormat::f16;
  EXPECT_THROW(make(evsm2), Error);
  EXPECT_NO_THROW(make(std::type_identity<Msm>{}));
  params.evsm.positive_exponent = 5.5;
  EXPECT_NO_THROW(make(evsm4));
  params.evsm.negative_exponent = 6.0;
  EXPECT_NO_THROW(make(evsm2));
  EXPECT_THROW(make(evsm4), Error);
  params.moment_map.format = MomentFormat::unorm16;
  EXPECT_THROW(make(evsm2), Error);
  EXPECT_NO_THROW(make(std::type_identity<Vsm>{}));
}

TEST(Prefiltered, A_gaussian_blur_falls_off_symmetrically) {
  const std::vector<float> weights = blur_weights(BlurKernel::gaussian, 7);
  ASSERT_EQ(weights.size(), 7u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(weights[i], weights[6 - i]);
    EXPECT_LT(weights[i], weights[i + 1]);
  }
  // The deviation is (size + 1)/6 texels.
  EXPECT_FLOAT_EQ(weights[2], std::exp(-0.5f * 0.75f * 0.75f));
}

}  // namespace
}  // namespace umbrameter
