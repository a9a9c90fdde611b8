// How many depths a texel of a prefiltered map is made of, and where the precision of its values ends.
#include <cmath>
#include <limits>

#include "core/error.h"
#include "prefiltered_case.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// Two depths in a texel, of which a share f is the nearer: Chebyshev's bound is exactly 1 − f at the farther one.
TEST_F(PrefilteredGl, Samples_of_a_texel_are_averaged) {
  constexpr double texel = 0.05;
  constexpr double edge = 0.25 * texel;
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene,
           quad({-20, 2, 20}, {static_cast<float>(edge), 2, 20}, {static_cast<float>(edge), 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0, 1, 1e-9}, 128, texel, 0);
  const UploadedScene uploaded = upload(context(), scene);
  const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, -1, 1, -1, 1));
  const Light light = light_of(layout);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  ShadowParams params = with(ShadowTechniques::choice<Vsm>, Length{0.0});
  params.moment_map.blur = 1;
  params.moment_bound.min_variance = 0.0;
  const auto lit = [&](int samples) {
    params.map_sampling.samples = samples;
    return mean(see({uploaded, surfels, map, light}, params));
  };
  // One sample sees the edge at the border of its texel.
  EXPECT_NEAR(lit(1), 0.5, 5e-4);
  EXPECT_NEAR(lit(16), 0.5 * (1.0 - edge), 5e-4);
  EXPECT_THROW(lit(5), Error);
}

// Exponents end where the sum of the blur is no longer a 32-bit float.
TEST_F(PrefilteredGl, The_largest_exponents_and_blur_are_where_precision_ends) {
  constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
  constexpr int blur = 63;
  ShadowParams limits;
  const double esm_end = require(describe(limits), "shadow.esm-exponent").description.max;
  const double evsm_end = require(describe(limits), "shadow.evsm-positive-exponent").description.max;
  EXPECT_EQ(require(describe(limits), "shadow.moment-blur").description.max, blur);
  EXPECT_LT(std::exp(esm_end) * blur, largest);
  EXPECT_LT(std::exp(2.0 * evsm_end) * blur, largest);
  EXPECT_GT(std::exp(2.0 * (evsm_end + 1.0)) * blur, largest) << "EVSM stores the square, too";
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 2, 20}, {20, 2, 20}, {20, 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0.001, 1, 0.002}, 128, 0.05, 0);
  for (const ShadowTechniques::Choice name :
       {ShadowTechniques::choice<Esm>, ShadowTechniques::choice<Evsm2>, ShadowTechniques::choice<Evsm4>}) {
    ShadowParams params = with(name, Length{0.0});
    params.esm = {esm_end, blur};
    params.moment_map.blur = blur;
    params.evsm.positive_exponent = params.evsm.negative_exponent = evsm_end;
    double last = 1.0;
    for (const double part : {0.125, 0.25, 0.5, 1.0}) {
      params.esm.exponent = part * esm_end;
      params.evsm.positive_exponent = params.evsm.negative_exponent = part * evsm_end;
      const double visibility = seen(scene, light_of(layout), layout, params);
      EXPECT_TRUE(std::isfinite(visibility)) << static_cast<int>(name) << " " << part;
      EXPECT_LE(visibility, last) << "a larger exponent is nearer to the hard shadow";
      last = visibility;
    }
    EXPECT_LT(last, 0.25) << static_cast<int>(name);
  }
  ShadowParams halves = with(ShadowTechniques::choice<Evsm2>);
  halves.moment_map.format = MomentFormat::f16;
  halves.evsm.positive_exponent = 5.6;
  EXPECT_THROW(make_technique(halves), Error) << "the square is above the largest 16-bit float";
}

}  // namespace
}  // namespace umbrameter
