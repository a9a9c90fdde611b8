// Prefiltered shadow maps as they are drawn: against their formulas on the CPU, against PCF, and on every kind of
// light.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "prefiltered_case.h"
#include "prefiltered_window.h"
#include "scenes/builtin/scenes.h"
#include "techniques/shadow/cascades.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

const std::vector<ShadowTechniques::Choice> all = filtering_techniques();

ShadowParams esm(double exponent, int blur) {
  ShadowParams params;
  params.bias.constant = 0.0;
  params.technique = ShadowTechniques::choice<Esm>;
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
  for (const ShadowTechniques::Choice name : all) {
    for (const BlurKernel kernel : {BlurKernel::box, BlurKernel::gaussian}) {
      ShadowParams params = with(name);
      params.moment_map.kernel = kernel;
      params.evsm.positive_exponent = 5.0;
      params.esm.exponent = 10.0;
      const auto technique = std::get<Prefiltered>(make_technique(params));
      const test::PrefilteredText text = test::text_of(params);
      const Image<float> seen = see({uploaded, gpu, map, light}, params);
      double sum = 0.0;
      double difference = 0.0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const Receiver receiver = project_to_map(layout, dvec3(surfels.position[i]));
        const Window window = window_at(layout, images, technique, text, receiver, 0.01);
        const float expected = visibility_of(window, text);
        // The shaders add up ten texels and interpolate twice in single precision.
        const float rounding = rounding_of(window, text);
        EXPECT_NEAR(seen[i], expected, 1e-4f + rounding) << static_cast<int>(name);
        difference += static_cast<double>(std::abs(seen[i] - expected));
        sum += static_cast<double>(seen[i]);
      }
      EXPECT_LT(difference, 1e-4 * static_cast<double>(seen.size())) << static_cast<int>(name);
      EXPECT_GT(sum, 0.05 * static_cast<double>(seen.size()));
      EXPECT_LT(sum, 0.95 * static_cast<double>(seen.size()));
    }
  }
}

TEST_F(PrefilteredGl, On_two_occluders_no_bound_is_too_dark_and_better_techniques_bleed_less) {
  const Scene scene = builtin::make_two_occluders();
  const Light light = scene.lights[0];
  const UploadedScene uploaded = upload(context(), scene);
  const View view{320, 180, scene.cameras[0]};
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const GBuffer gbuffer = read_back(context(), surfels);
  const MapLayout layout = fit_light(light, bounds_of(scene), 1024);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  const ShadowMapImages images = read_back(context(), map);
  // Mean visibility where no texel of the window is lit.
  const auto bleeding = [&](const ShadowParams& params) {
    const auto technique = std::get<Prefiltered>(make_technique(params));
    const test::PrefilteredText text = test::text_of(params);
    const Image<float> seen = see({uploaded, surfels, map, light}, params);
    double sum = 0.0;
    std::size_t dark = 0;
    std::size_t loose = 0;
    std::size_t too_dark = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!gbuffer.is_surface(i)) continue;
      const dvec3 position(gbuffer.position[i]);
      if (exclusion_of(light, layout, position, dvec3(gbuffer.geometric_normal[i])) != PixelExclusion::none) continue;
      const Window window =
          window_at(layout, images, technique, text, project_to_map(layout, position), params.bias.constant.number);
      const double tolerance = 2e-5 + static_cast<double>(rounding_of(window, text));
      if (static_cast<double>(seen[i]) < window.lit_share - tolerance) ++too_dark;
      if (tolerance > 0.002) ++loose;
      if (window.lit_share > 0.0) continue;
      sum += static_cast<double>(seen[i]);
      ++dark;
    }
    EXPECT_EQ(too_dark, 0u) << static_cast<int>(params.technique);
    EXPECT_LT(loose, seen.size() / 20);
    EXPECT_GT(dark, 4500u);
    return sum / static_cast<double>(dark);
  };
  const double vsm = bleeding(with(ShadowTechniques::choice<Vsm>));
  const double msm = bleeding(with(ShadowTechniques::choice<Msm>));
  EXPECT_GT(vsm, 0.005);
  EXPECT_LT(msm, 0.5 * vsm);
  ShadowParams hausdorff = with(ShadowTechniques::choice<Msm>);
  hausdorff.msm.bound = MomentBound::hausdorff;
  EXPECT_LT(bleeding(hausdorff), msm);
  double last_esm = 1.0;
  double last_evsm = 1.0;
  for (const double exponent : {1.0, 5.0, 15.0, 40.0}) {
    ShadowParams params = with(ShadowTechniques::choice<Evsm4>);
    params.evsm.positive_exponent = exponent;
    params.evsm.negative_exponent = exponent;
    const double evsm = bleeding(params);
    EXPECT_LT(evsm, last_evsm) << exponent;
    last_evsm = evsm;
    params.technique = ShadowTechniques::choice<Esm>;
    params.esm.exponent = 2.0 * exponent;
    const double esm = bleeding(params);
    EXPECT_LT(esm, last_esm) << exponent;
    last_esm = esm;
  }
  EXPECT_LT(last_evsm, 0.2 * vsm);
  EXPECT_LT(last_esm, 0.02);
  ShadowParams reduced = with(ShadowTechniques::choice<Vsm>);
  reduced.moment_bound.bleeding_reduction = 0.3;
  EXPECT_LT(mean(see({uploaded, surfels, map, light}, reduced)),
            mean(see({uploaded, surfels, map, light}, with(ShadowTechniques::choice<Vsm>))));
}

// 16 by 16 pixels of 16 texels each, seen from above.
TEST_F(PrefilteredGl, Mipmaps_average_the_texels_under_a_pixel) {
  const Scene scene = stairs();
  constexpr double texel = 0.05;
  const MapLayout layout = exact_layout({0, 1, 1e-9}, 256, texel, 0);
  const Light light = light_of(layout);
  const UploadedScene uploaded = upload(context(), scene);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  const ShadowMapImages images = read_back(context(), map);
  const View view = orthographic_view(16, 16, {0, 10, 0}, {0, 0, 0}, 128 * texel, {0, 0, -1});
  GBuffer surfels(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const auto i = static_cast<std::size_t>(y * 16 + x);
      const Ray ray = pixel_ray(view, x, y);
      surfels.instance[i] = surfels.triangle[i] = 0;
      surfels.position[i] = vec3(ray.origin + ray.direction * (-ray.origin.y / ray.direction.y));
      surfels.geometric_normal[i] = surfels.shading_normal[i] = vec3(0, 1, 0);
    }
  }
  const GpuGBuffer gpu = upload(context(), surfels);
  double difference = 0.0;
  for (const ShadowTechniques::Choice name : all) {
    ShadowParams params = with(name);
    params.moment_map.blur = params.esm.blur = 1;
    params.evsm.positive_exponent = 5.0;
    params.esm.exponent = 10.0;
    const Image<float> first_level = see({uploaded, gpu, map, light, &view}, params);
    params.map_sampling.mipmaps = true;
    const auto technique = std::get<Prefiltered>(make_technique(params));
    const test::PrefilteredText text = test::text_of(params);
    const Image<float> seen = see({uploaded, gpu, map, light, &view}, params);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Receiver receiver = project_to_map(layout, dvec3(surfels.position[i]));
      Window pixel{std::vector<dvec4>(static_cast<std::size_t>(technique.groups), dvec4(0.0))};
      pixel.depth = static_cast<float>((receiver.depth - 0.01) / layout.far_depth);
      const ivec2 first(glm::round(receiver.texels - 8.0));
      for (int t = 0; t < 256; ++t) {
        const float depth = images.depth[0][texel_index(layout, first + ivec2(t % 16, t / 16))];
        for (int group = 0; group < technique.groups; ++group) {
          pixel.groups[static_cast<std::size_t>(group)] += dvec4(text.map_values(depth, group)) / 256.0;
        }
      }
      // The footprint of 16 texels is exact to 1e-6, and so is the share of the next level in the interpolation.
      EXPECT_NEAR(seen[i], visibility_of(pixel, text), 1e-3f + rounding_of(pixel, text))
          << static_cast<int>(name) << " " << i;
      difference += static_cast<double>(std::abs(seen[i] - first_level[i]));
    }
  }
  EXPECT_GT(difference, 1.0);
}

TEST_F(PrefilteredGl, A_map_with_texels_larger_than_pixels_is_read_at_its_first_level) {
  const Scene scene = builtin::make_contact_box();
  const UploadedScene uploaded = upload(context(), scene);
  const View view{160, 90, scene.cameras[0]};
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const Light light = scene.lights[0];
  for (const auto& [resolution, is_equal] : {std::pair{16, true}, std::pair{1024, false}}) {
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), resolution));
    for (const ShadowTechniques::Choice name : all) {
      ShadowParams params = with(name, Length{1.5, LengthUnit::texels});
      params.csm_map.terms = 3;
      const Image<float> without = see({uploaded, surfels, map, light, &view}, params);
      params.map_sampling.mipmaps = true;
      EXPECT_EQ(see({uploaded, surfels, map, light, &view}, params) == without, is_equal) << resolution;
    }
  }
}

TEST_F(PrefilteredGl, Many_look_ups_in_one_pass_give_what_each_gives_alone) {
  const Scene scene = builtin::make_two_occluders();
  const UploadedScene uploaded = upload(context(), scene);
  const View view{160, 90, scene.cameras[0]};
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const Light light = scene.lights[0];
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 512));
  for (const ShadowTechniques::Choice name : all) {
    std::vector<ShadowParams> params;
    for (int i = 0; i < 5; ++i) {
      const double part = 0.1 * i;
      ShadowParams& each = params.emplace_back(with(name, Length{part, LengthUnit::texels}));
      each.bias.slope = 0.5 * part;
      each.moment_bound = {1e-5 * (1 + i), part};
      each.msm = {1e-4 * part, i % 2 == 0 ? MomentBound::hamburger : MomentBound::hausdorff};
      each.csm_lookup = {part, 1.0 + part};
      each.csm_map.terms = 5;
    }
    const ShadowTechnique technique = make_technique(params[0]);
    const TechniqueMap filtered = filter_map({context(), uploaded, light, map}, technique);
    std::vector<PrefilteredLookup> lookups;
    for (const ShadowParams& each : params) {
      lookups.push_back(lookup_of(each.bias, std::get<Prefiltered>(make_technique(each))));
    }
    const std::vector<Image<float>> together =
        draw_lookups(context(), {uploaded, surfels, map, light, params[0].bias, technique, nullptr, &filtered},
                     std::get<Prefiltered>(technique), lookups);
    ASSERT_EQ(together.size(), params.size());
    for (std::size_t i = 0; i < params.size(); ++i) {
      EXPECT_EQ(together[i], see({uploaded, surfels, map, light}, params[i])) << static_cast<int>(name) << " " << i;
      EXPECT_EQ(together[i] == together[0], i == 0);
    }
  }
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
        for (const ShadowTechniques::Choice name : all) {
          for (const MomentFormat format : {MomentFormat::f32, MomentFormat::f16, MomentFormat::unorm16}) {
            ShadowParams params = with(name, Length{1.5, LengthUnit::texels});
            const bool is_evsm = name == ShadowTechniques::choice<Evsm2> || name == ShadowTechniques::choice<Evsm4>;
            if (is_evsm && format == MomentFormat::unorm16) continue;
            params.moment_map.format = format;
            params.csm_map.terms = 4;
            if (format == MomentFormat::f16) params.evsm.positive_exponent = 5.0;
            if (format != MomentFormat::f32) {
              params.moment_bound.min_variance = 1e-4;
              params.msm.moment_bias = 1e-3;
            }
            const Image<float> seen = see({uploaded, surfels, map, light}, params);
            const auto [low, high] = std::minmax_element(seen.pixels.begin(), seen.pixels.end());
            EXPECT_TRUE(std::all_of(seen.pixels.begin(), seen.pixels.end(), [](float v) { return v >= 0 && v <= 1; }));
            const std::string at = scene.name + " " + std::to_string(static_cast<int>(name)) + " " +
                                   std::to_string(static_cast<int>(format));
            EXPECT_LT(*low, 0.05f) << at;
            EXPECT_EQ(*high, 1.0f) << at;
            // Shadows are as large as those of PCF, but for the blur and the light that bleeds.
            const double compared =
                mean(see({uploaded, surfels, map, light}, with(ShadowTechniques::choice<Pcf>, params.bias.constant)));
            EXPECT_NEAR(mean(seen), compared, 0.1) << at;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
