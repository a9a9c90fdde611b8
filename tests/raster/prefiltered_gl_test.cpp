// Prefiltered shadow maps as they are drawn: against their formulas on the CPU, against PCF, and on every kind of
// light.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "raster/shadow/technique_passes.h"
#include "scenes/builtin/scenes.h"
#include "techniques/shadow/cascades.h"
#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class PrefilteredGl : public GlTest {
 protected:
  // Mean visibility of surfels over x and z from −1 to 1 on the ground, under a map of texels of 5 cm.
  double seen(const Scene& scene, const Light& light, const MapLayout& layout, const ShadowParams& params) const {
    const UploadedScene uploaded = upload(context(), scene);
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(16, 16, -1, 1, -1, 1));
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    return mean(see({uploaded, surfels, map, light}, params));
  }

  struct Drawn {
    const UploadedScene& scene;
    const GpuGBuffer& surfels;
    const ShadowMap& map;
    const Light& light;
  };
  Image<float> see(const Drawn& drawn, const ShadowParams& params) const {
    const ShadowTechnique technique = make_technique(params);
    const FilteredMap filtered = filter_map(context(), drawn.map, technique);
    return draw_visibility(context(), {drawn.scene, drawn.surfels, drawn.map, drawn.light, params.bias, technique,
                                       nullptr, &filtered})
        .visibility;
  }
};

constexpr std::array<ShadowTechniqueName, 5> all{ShadowTechniqueName::esm, ShadowTechniqueName::vsm,
                                                 ShadowTechniqueName::evsm2, ShadowTechniqueName::evsm4,
                                                 ShadowTechniqueName::msm};

ShadowParams with(ShadowTechniqueName technique, Length bias = Length{0.01}) {
  ShadowParams params;
  params.technique = technique;
  params.bias.constant = bias;
  return params;
}

ShadowParams esm(double exponent, int blur) {
  ShadowParams params;
  params.bias.constant = 0.0;
  params.technique = ShadowTechniqueName::esm;
  params.esm = {exponent, blur};
  return params;
}

TEST_F(PrefilteredGl, Under_a_wide_slab_visibility_is_the_exponential_of_the_gap) {
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 2, 20}, {20, 2, 20}, {20, 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0.001, 1, 0.002}, 128, 0.05, 0);
  for (const double exponent : {1.0, 10.0, 40.0}) {
    for (const int blur : {1, 7}) {
      // exp(−c·d)·exp(c·z) = exp(−c·(d − z)), and d − z is the slab's height over the depth range.
      const double expected = std::exp(-exponent * 2.0 / layout.far_depth);
      // Single precision holds the product to about c·2⁻²³ of itself, and the light leans by 1/500.
      EXPECT_NEAR(seen(scene, light_of(layout), layout, esm(exponent, blur)), expected, 1e-3 * expected + 1e-6)
          << exponent << " " << blur;
    }
  }
}

TEST_F(PrefilteredGl, An_open_plane_is_lit_by_every_kind_of_light) {
  Scene scene;
  add_mesh(scene, ground(60));
  const MapLayout flat = exact_layout({0.001, 1, 0.002}, 128, 0.05, 0);
  ShadowParams params = esm(40.0, 3);
  params.bias.constant = 0.01;
  EXPECT_EQ(seen(scene, light_of(flat), flat, params), 1.0);
  const Light point = point_light({0.1, 3, 0.2});
  params.bias.constant = 0.1;
  EXPECT_EQ(seen(scene, point, fit_light(point, bounds_of(scene), 512), params), 1.0);
}

TEST_F(PrefilteredGl, A_blurred_edge_passes_one_half_where_the_kernel_is_half_covered) {
  // A slab over x < 0. At the edge half of the box holds its depth, whose exponential is small beside the ground's:
  // visibility is 1/2 and a little, (1 + exp(−c·gap/far))/2.
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 2, 20}, {0, 2, 20}, {0, 2, -20}, {-20, 2, -20}));
  const MapLayout layout = exact_layout({0, 1, 1e-9}, 128, 0.05, 0);
  const UploadedScene uploaded = upload(context(), scene);
  GBuffer one = surfels_on_ground(1, 1, 0, 1, 0, 1);
  one.position[0] = vec3(0.0f, 0, 0.3f);
  const GpuGBuffer surfel = upload(context(), one);
  const Light light = light_of(layout);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  const Image<float> seen = see({uploaded, surfel, map, light}, esm(40.0, 9));
  const double expected = 0.5 * (1.0 + std::exp(-40.0 * 2.0 / layout.far_depth));
  EXPECT_NEAR(static_cast<double>(seen[0]), expected, 1e-3);
}

// A stair of three heights over the ground.
Scene stairs() {
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 1, 20}, {-0.4f, 1, 20}, {-0.4f, 1, -20}, {-20, 1, -20}));
  add_mesh(scene, quad({-20, 2, 20}, {0.1f, 2, 0.3f}, {0.3f, 2, -0.2f}, {-20, 2, -20}));
  add_mesh(scene, quad({-20, 3, 0.1f}, {20, 3, 0.5f}, {20, 3, -0.3f}, {-20, 3, -0.1f}));
  return scene;
}

TEST_F(PrefilteredGl, A_drawn_map_gives_what_its_formula_gives_on_the_CPU) {
  const Scene scene = stairs();
  const MapLayout layout = exact_layout({0.2, 1, 0.1}, 128, 0.05, 0.4);
  const UploadedScene uploaded = upload(context(), scene);
  const GBuffer surfels = surfels_on_ground(32, 32, -1, 1, -1, 1);
  const GpuGBuffer gpu = upload(context(), surfels);
  const Light light = light_of(layout);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  const ShadowMapImages images = read_back(context(), map);
  for (const ShadowTechniqueName name : all) {
    for (const BlurKernel kernel : {BlurKernel::box, BlurKernel::gaussian}) {
      ShadowParams params = with(name);
      params.moment_map.kernel = kernel;
      params.moment_map.positive_exponent = 5.0;
      params.esm.exponent = 10.0;
      const auto technique = std::get<Prefiltered>(make_technique(params));
      const Image<float> seen = see({uploaded, gpu, map, light}, params);
      double sum = 0.0;
      double difference = 0.0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const Receiver receiver = project_to_map(layout, dvec3(surfels.position[i]));
        const dvec2 place = receiver.texels - 0.5;
        const ivec2 base(glm::floor(place));
        const dvec2 part = place - dvec2(base);
        dvec4 values(0.0);
        for (int corner = 0; corner < 4; ++corner) {
          const ivec2 at = base + ivec2(corner & 1, corner >> 1);
          const double share = ((corner & 1) != 0 ? part.x : 1.0 - part.x) * (corner > 1 ? part.y : 1.0 - part.y);
          double weights = 0.0;
          dvec4 blurred(0.0);
          const int taps = static_cast<int>(technique.blur.size());
          for (int tap = 0; tap < taps * taps; ++tap) {
            const ivec2 of_tap(tap % taps, tap / taps);
            const double weight = static_cast<double>(technique.blur[static_cast<std::size_t>(of_tap.x)]) *
                                  static_cast<double>(technique.blur[static_cast<std::size_t>(of_tap.y)]);
            const float depth = images.depth[0][texel_index(layout, at + of_tap - taps / 2)];
            blurred += weight * dvec4(shared::map_values(depth, technique.settings));
            weights += weight;
          }
          values += share * blurred / weights;
        }
        const auto depth = static_cast<float>((receiver.depth - 0.01) / layout.far_depth);
        const float expected = shared::visibility_from(vec4(values), depth, technique.settings);
        // MSM divides differences of moments, which single precision holds to 1e-7, by its bias of 1e-5.
        EXPECT_NEAR(seen[i], expected, name == ShadowTechniqueName::msm ? 0.1f : 3e-3f) << static_cast<int>(name);
        difference += static_cast<double>(std::abs(seen[i] - expected));
        sum += static_cast<double>(seen[i]);
      }
      EXPECT_LT(difference, 1e-3 * static_cast<double>(seen.size())) << static_cast<int>(name);
      EXPECT_GT(sum, 0.05 * static_cast<double>(seen.size()));
      EXPECT_LT(sum, 0.95 * static_cast<double>(seen.size()));
    }
  }
}

// A box of PCF with linear taps is the exact share of lit texels under the same blur and interpolation.
ShadowParams exact_share(Length bias) {
  ShadowParams params = with(ShadowTechniqueName::pcf, bias);
  params.pcf.filter = ShadowFilter::box;
  params.pcf.taps = FilterTaps::linear;
  params.pcf.size = MomentMapParams{}.blur;
  return params;
}

TEST_F(PrefilteredGl, On_two_occluders_no_bound_is_too_dark_and_better_techniques_bleed_less) {
  const Scene scene = builtin::make_two_occluders();
  const Light light = scene.lights[0];
  const UploadedScene uploaded = upload(context(), scene);
  const View view{320, 180, scene.cameras[0]};
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 1024));
  const Length bias{0.15};  // above the depth that a texel's kernel spans on the ground, so that nothing shades itself
  const Image<float> exact = see({uploaded, surfels, map, light}, exact_share(bias));
  const auto bleeding = [&](const ShadowParams& params) {
    const Image<float> seen = see({uploaded, surfels, map, light}, params);
    double sum = 0.0;
    std::size_t too_dark = 0;
    std::size_t dark = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i] < exact[i] - 0.02f) ++too_dark;
      if (exact[i] > 0.0f) continue;
      sum += static_cast<double>(seen[i]);
      ++dark;
    }
    EXPECT_EQ(too_dark, 0u) << static_cast<int>(params.technique);
    EXPECT_GT(dark, 5000u);
    return sum / static_cast<double>(dark);
  };
  const double vsm = bleeding(with(ShadowTechniqueName::vsm, bias));
  const double msm = bleeding(with(ShadowTechniqueName::msm, bias));
  EXPECT_GT(vsm, 0.005);
  EXPECT_LT(msm, 0.5 * vsm);
  double last = 1.0;
  for (const double exponent : {1.0, 5.0, 15.0, 40.0}) {
    ShadowParams params = with(ShadowTechniqueName::evsm4, bias);
    params.moment_map.positive_exponent = exponent;
    params.moment_map.negative_exponent = exponent;
    const double evsm = bleeding(params);
    EXPECT_LT(evsm, last) << exponent;
    last = evsm;
  }
  EXPECT_LT(last, 0.2 * vsm);
  ShadowParams reduced = with(ShadowTechniqueName::vsm, bias);
  reduced.moment_lookup.bleeding_reduction = 0.3;
  EXPECT_LT(mean(see({uploaded, surfels, map, light}, reduced)),
            mean(see({uploaded, surfels, map, light}, with(ShadowTechniqueName::vsm, bias))));
}

TEST_F(PrefilteredGl, Every_technique_and_format_draws_under_every_kind_of_light) {
  for (const Scene& scene : {builtin::make_contact_box(), builtin::make_two_occluders()}) {
    const UploadedScene uploaded = upload(context(), scene);
    const View view{160, 90, scene.cameras[0]};
    const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
    const Bounds bounds = bounds_of(scene);
    const std::array<Light, 3> lights{scene.lights[0], spot_light({3, 6, 3}, {0, 0, 0}, 0.9), point_light({1, 4, 2})};
    for (const Light& light : lights) {
      for (const int cascades : {1, 3}) {
        if (cascades > 1 && !std::holds_alternative<DirectionalLight>(light.shape)) continue;
        const ShadowMapParams sizes{256, cascades};
        const ShadowMap map =
            draw_shadow_map(context(), uploaded, light, fit_map(light, bounds, sizes, {read_back(context(), surfels)}));
        for (const ShadowTechniqueName name : all) {
          for (const MomentFormat format : {MomentFormat::f32, MomentFormat::f16, MomentFormat::unorm16}) {
            ShadowParams params = with(name, Length{1.5, LengthUnit::texels});
            const bool is_evsm = name == ShadowTechniqueName::evsm2 || name == ShadowTechniqueName::evsm4;
            if (is_evsm && format == MomentFormat::unorm16) continue;
            params.moment_map.format = format;
            if (format == MomentFormat::f16) params.moment_map.positive_exponent = 5.0;
            if (format != MomentFormat::f32) params.moment_lookup = {1e-4, 0.0, 1e-3};
            const Image<float> seen = see({uploaded, surfels, map, light}, params);
            const auto [low, high] = std::minmax_element(seen.pixels.begin(), seen.pixels.end());
            EXPECT_TRUE(std::all_of(seen.pixels.begin(), seen.pixels.end(), [](float v) { return v >= 0 && v <= 1; }));
            const std::string at = scene.name + " " + std::to_string(static_cast<int>(name)) + " " +
                                   std::to_string(static_cast<int>(format));
            EXPECT_LT(*low, 0.05f) << at;
            EXPECT_EQ(*high, 1.0f) << at;
            // Shadows are as large as those of PCF, but for the blur and the light that bleeds.
            const double compared =
                mean(see({uploaded, surfels, map, light}, with(ShadowTechniqueName::pcf, params.bias.constant)));
            EXPECT_NEAR(mean(seen), compared, 0.1) << at;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
