// Cascades and cube faces through real maps: bias per cascade, shimmer, seams and pancaking.
#include <cmath>
#include <vector>

#include "compare/map_views.h"
#include "compare/shimmer.h"
#include "compare/visibility.h"
#include "techniques/shadow/cascades.h"
#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class CascadesGl : public GlTest {
 protected:
  struct Seen {
    View view;
    GpuGBuffer gpu;
    GBuffer gbuffer;
  };
  Seen look(const UploadedScene& scene, const View& view) const {
    GpuGBuffer gpu = draw_gbuffer(context(), scene, view);
    GBuffer gbuffer = read_back(context(), gpu);
    return {view, std::move(gpu), std::move(gbuffer)};
  }
  Image<float> shadow(const UploadedScene& scene, const GpuGBuffer& surfels, const Light& light,
                      const MapLayout& layout, const ShadowParams& params) const {
    const ShadowMap map = draw_shadow_map(context(), scene, light, layout);
    return draw_visibility(context(), {scene, surfels, map, light, params.bias, make_technique(params)}).visibility;
  }
};

// Posts on the ground along −z, and a rail at their side, whose shadow crosses every border between cascades.
Scene posts() {
  Scene scene;
  add_mesh(scene, quad({-60, 0, 60}, {60, 0, 60}, {60, 0, -60}, {-60, 0, -60}));
  add_mesh(scene, box({-1.3f, 0.9f, -42}, {-1.1f, 1.1f, 0}));
  for (int i = 0; i < 8; ++i) {
    const auto z = static_cast<float>(-2 - 5 * i);
    add_mesh(scene, box({-1.0f + 0.13f * static_cast<float>(i), 0, z}, {0.3f, 1.7f, z + 0.4f}));
  }
  return scene;
}

// Item 11 of the known answers: b0 = rho t (p+q) tan theta, rho = 1/2 for a nearest tap, 3/2 for 3×3; with the texel of
// each cascade.
TEST_F(CascadesGl, The_least_bias_without_acne_follows_its_formula_in_every_cascade) {
  Scene scene;
  add_mesh(scene, ground(60.0f));
  const UploadedScene uploaded = upload(context(), scene);
  const Seen seen = look(uploaded, perspective_view(400, 300, {0, 2, 20}, {0, 0, 10}));
  const gl::Texture lit = upload(context(), Image<float>(400, 300, 1.0f));
  const double theta = pi / 3;
  const Light light =
      directional_light({std::sin(theta) * std::cos(0.4), std::cos(theta), std::sin(theta) * std::sin(0.4)});
  for (const CascadeSelection selection : {CascadeSelection::map, CascadeSelection::depth}) {
    for (const CascadeFit cascade_fit : {CascadeFit::tight, CascadeFit::stable}) {
      MapFitParams fit;
      fit.selection = selection;
      fit.cascade_fit = cascade_fit;
      const MapLayout layout = fit_map(light, bounds_of(scene), {256, 3}, {seen.gbuffer, seen.view}, fit);
      ASSERT_EQ(layout.views.size(), 3u);
      const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
      const dvec3 up_in_light(layout.light_from_world * dvec4(0, 1, 0, 0));
      const double p_plus_q =
          (std::abs(up_in_light.x) + std::abs(up_in_light.y)) / std::hypot(up_in_light.x, up_in_light.y);
      for (const auto& [filter, rho] : {std::pair{ShadowFilter::nearest, 0.5}, std::pair{ShadowFilter::box, 1.5}}) {
        ShadowParams params;
        params.pcf.filter = filter;
        for (std::size_t v = 0; v < layout.views.size(); ++v) {
          const double texel = 2.0 * layout.views[v].half_extent / 256;
          const auto acne_at = [&](double bias) {
            params.bias.constant = bias;
            const WrongTaps wrong =
                draw_visibility(context(), {uploaded, seen.gpu, map, light, params.bias, make_technique(params), &lit})
                    .wrong;
            std::uint64_t acne = 0;
            for (std::size_t i = 0; i < wrong.weights.size(); ++i) {
              if (!seen.gbuffer.is_surface(i)) continue;
              const Receiver receiver = project_to_map(layout, dvec3(seen.gbuffer.position[i]));
              if (receiver.view == static_cast<int>(v)) acne += wrong.weights[i].x;
            }
            return acne;
          };
          const double least = rho * texel * p_plus_q * std::tan(theta);
          // A stable map moves vertices by up to 1/512 texel each way: the plane by 1/256 of the half texel of rho.
          EXPECT_EQ(acne_at(1.005 * least), 0u) << "cascade " << v;
          EXPECT_GT(acne_at(0.8 * least), 0u) << "cascade " << v;
        }
      }
    }
  }
}

// Each cascade's pixels are those that its own bias draws, on the GPU as on the CPU.
TEST_F(CascadesGl, Factors_multiply_the_constant_bias_of_each_cascade) {
  const Scene scene = posts();
  const UploadedScene uploaded = upload(context(), scene);
  const Seen seen = look(uploaded, perspective_view(200, 150, {0, 2, 6}, {0, 0, -10}));
  const gl::Texture lit = upload(context(), Image<float>(200, 150, 1.0f));
  const Light light = directional_light({0.8, 0.7, 0.3});
  MapFitParams fit;
  fit.cascade_bias = "1,4,16";
  const MapLayout layout = fit_map(light, bounds_of(scene), {128, 3}, {seen.gbuffer, seen.view}, fit);
  ASSERT_EQ(layout.views.size(), 3u);
  MapLayout plain = layout;
  for (MapView& view : plain.views) view.bias_factor = 1.0;
  ASSERT_EQ(layout.views.back().bias_factor, 16.0);
  const auto drawn = [&](const MapLayout& each, Length bias) {
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, each);
    ShadowParams params;
    params.bias.constant = bias;
    return draw_visibility(context(), {uploaded, seen.gpu, map, light, params.bias, make_technique(params), &lit})
        .visibility;
  };
  for (const LengthUnit unit : {LengthUnit::metres, LengthUnit::texels, LengthUnit::map_depth}) {
    const double bias = unit == LengthUnit::texels ? 0.25 : unit == LengthUnit::metres ? 0.02 : 0.0005;
    const Image<float> with_factors = drawn(layout, {bias, unit});
    std::size_t changed = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      const Image<float> own = drawn(plain, {bias * std::pow(4.0, static_cast<double>(v)), unit});
      const Image<float> first = drawn(plain, {bias, unit});
      for (std::size_t i = 0; i < own.pixels.size(); ++i) {
        if (!seen.gbuffer.is_surface(i)) continue;
        const Receiver receiver = project_to_map(layout, dvec3(seen.gbuffer.position[i]));
        if (receiver.view != static_cast<int>(v)) continue;
        EXPECT_EQ(with_factors.pixels[i], own.pixels[i]) << "cascade " << v;
        if (own.pixels[i] != first.pixels[i]) ++changed;
      }
    }
    EXPECT_GT(changed, 100u);
  }
}

// The same surfels before and after a step of the camera: change of their visibility where the same view serves them.
TEST_F(CascadesGl, Whole_texels_make_the_shimmer_of_a_moving_camera_zero) {
  const Scene scene = posts();
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = directional_light({0.6, 1.0, 0.3});
  const View first = perspective_view(320, 180, {1, 1.8, 3}, {0, 0.5, -10});
  const Seen seen = look(uploaded, first);
  ShadowParams params;
  params.pcf.filter = ShadowFilter::bilinear;
  params.bias.constant = Length{3.0, LengthUnit::texels};
  for (const int cascades : {1, 3}) {
    for (const CascadeFit cascade_fit : {CascadeFit::tight, CascadeFit::stable}) {
      MapFitParams fit;
      fit.fit = MapFit::view;
      fit.split_range = SplitRange::camera;
      fit.max_distance = 30.0;
      fit.cascade_fit = cascade_fit;
      const auto layout_of = [&](const Seen& part) {
        return fit_map(light, bounds_of(scene), {512, cascades}, {part.gbuffer, part.view}, fit);
      };
      const MapLayout before = layout_of(seen);
      const Image<float> visibility = shadow(uploaded, seen.gpu, light, before, params);
      double change = 0.0;
      std::size_t compared = 0;
      bool has_moved = false;
      for (const dvec3& step : {dvec3(0.1, 0, 0), dvec3(0, 0.07, 0), dvec3(0, 0, -0.33), dvec3(0.21, 0.05, -0.4)}) {
        View view = first;
        view.camera.world_from_camera[3] += dvec4(step, 0.0);
        const MapLayout after = layout_of(look(uploaded, view));
        has_moved = has_moved || after.views.front().center != before.views.front().center;
        const Image<float> again = shadow(uploaded, seen.gpu, light, after, params);
        for (std::size_t i = 0; i < again.size(); ++i) {
          if (!seen.gbuffer.is_surface(i)) continue;
          const Receiver a = project_to_map(before, dvec3(seen.gbuffer.position[i]));
          const Receiver b = project_to_map(after, dvec3(seen.gbuffer.position[i]));
          if (!a.is_inside || !b.is_inside || a.view != b.view) continue;
          ++compared;
          change += std::abs(static_cast<double>(again[i]) - static_cast<double>(visibility[i]));
        }
      }
      EXPECT_TRUE(has_moved);
      EXPECT_GT(compared, 60000u);
      if (cascade_fit == CascadeFit::stable) {
        EXPECT_EQ(change, 0.0) << cascades;
      } else {
        EXPECT_GT(change, 20.0) << cascades;
      }
    }
  }
}

TEST_F(CascadesGl, Seams_compare_the_cascade_with_the_next_one) {
  const Scene scene = posts();
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = directional_light({0.6, 1.0, 0.3});
  const Seen seen = look(uploaded, perspective_view(320, 180, {1, 1.8, 3}, {0, 0.5, -10}));
  ShadowParams params;
  params.bias.constant = Length{3.0, LengthUnit::texels};
  MapLayout layout = fit_map(light, bounds_of(scene), {256, 2}, {seen.gbuffer, seen.view});
  const CountedPixels counted = count_pixels(seen.gbuffer, light, layout);
  const Image<std::uint8_t> seams = find_seams(seen.gbuffer, layout, counted);
  const Image<float> own = shadow(uploaded, seen.gpu, light, layout, params);
  layout.uses_neighbour = true;
  const Image<float> neighbour = shadow(uploaded, seen.gpu, light, layout, params);
  const SeamStatistics found = analyze_seams(seams, own, neighbour, counted);
  EXPECT_GT(found.pixels, 100u);
  EXPECT_GT(found.mean_difference, 0.0) << "the next cascade's texels are coarser";
  EXPECT_LT(found.mean_difference, 0.2);
  // The neighbour is what a map of the last view alone answers.
  MapLayout last = layout;
  last.uses_neighbour = false;
  last.views = {layout.views.back()};
  const Image<float> alone = shadow(uploaded, seen.gpu, light, last, params);
  EXPECT_EQ(neighbour.pixels, alone.pixels);
}

// A floor that crosses the edge between a cube's lower and right face, and the shadow of a half-plane across that edge:
// light at height 1, occluder z > 0 at height 0.5, so that the floor is lit for z < 0 and blocked for z > 0.
TEST_F(CascadesGl, Cube_faces_meet_without_a_seam) {
  Scene scene;
  add_mesh(scene, ground(20.0f));
  Light light;
  light.shape = PointLight{};
  light.world_from_light[3] = dvec4(0, 1, 0, 1);
  const GBuffer surfels = surfels_on_ground(256, 256, 0.9, 1.1, -0.1, 0.1);
  const GpuGBuffer gpu = upload(context(), surfels);
  MapLayout layout = fit_light(light, bounds_of(scene), 256);
  MapLayout beside = layout;
  beside.uses_neighbour = true;
  const Image<std::uint8_t> seams = find_seams(surfels, layout, count_pixels(surfels, light, layout));
  std::size_t at_seam = 0;
  std::size_t faces[6] = {};
  for (std::size_t i = 0; i < seams.size(); ++i) {
    at_seam += seams[i];
    ++faces[project_to_map(layout, dvec3(surfels.position[i])).view];
  }
  EXPECT_GT(at_seam, 1000u);
  EXPECT_GT(faces[0], 10000u);  // +x
  EXPECT_GT(faces[3], 10000u);  // −y
  for (const ShadowFilter filter : {ShadowFilter::nearest, ShadowFilter::bilinear, ShadowFilter::box}) {
    ShadowParams params;
    params.pcf.filter = filter;
    params.bias.slope = 4.0;  // above b0, also at grazing angles to a face
    {
      const UploadedScene bare = upload(context(), scene);
      EXPECT_EQ(mean(shadow(bare, gpu, light, layout, params)), 1.0) << "a plane that its bias frees has no seam";
      const Image<float> other = shadow(bare, gpu, light, beside, params);
      for (std::size_t i = 0; i < seams.size(); ++i) {
        ASSERT_TRUE(seams[i] == 0 || other[i] == 1.0f) << "nor has it one in the face beside";
      }
    }
    Scene shaded = scene;
    add_mesh(shaded, quad({-9, 0.5f, 0}, {-9, 0.5f, 9}, {9, 0.5f, 9}, {9, 0.5f, 0}));
    const UploadedScene uploaded = upload(context(), shaded);
    const Image<float> own = shadow(uploaded, gpu, light, layout, params);
    const Image<float> other = shadow(uploaded, gpu, light, beside, params);
    // Half of the widest kernel, 1.5 texels, plus half a texel of the map; a texel at the face's edge is 2 · 1 / 256 m.
    const double reach = 2.0 * 2.0 / 256;
    for (std::size_t i = 0; i < seams.size(); ++i) {
      const double z = static_cast<double>(surfels.position[i].z);
      if (std::abs(z) <= reach) continue;
      const float expected = z < 0.0 ? 1.0f : 0.0f;
      ASSERT_EQ(own[i], expected) << surfels.position[i].x << " " << z;
      ASSERT_TRUE(seams[i] == 0 || other[i] == expected) << surfels.position[i].x << " " << z;
    }
  }
}

// A roof 30 m above the ground lies before the depth range that starts at the ground.
TEST_F(CascadesGl, Pancaking_changes_no_shadow_while_receivers_are_deeper_than_the_bias) {
  Scene scene = posts();
  add_mesh(scene, box({-4, 30, -20}, {4, 31, -5}));
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = directional_light({0.1, 1.0, 0.05});
  const Seen seen = look(uploaded, perspective_view(320, 180, {1, 1.8, 3}, {0, 0.5, -10}));
  MapFitParams fit;
  const auto fitted = [&] { return fit_map(light, bounds_of(scene), {512, 2}, {seen.gbuffer, seen.view}, fit); };
  const MapLayout whole = fitted();
  ShadowParams params;
  params.bias.constant = 0.1;
  const Image<float> expected = shadow(uploaded, seen.gpu, light, whole, params);
  fit.pancaking = true;
  const MapLayout shortened = fitted();
  EXPECT_LT(shortened.far_depth, whole.far_depth - 20.0);
  EXPECT_EQ(shadow(uploaded, seen.gpu, light, shortened, params).pixels, expected.pixels);
  EXPECT_GT(mean(expected), 0.2);
  EXPECT_LT(mean(expected), 0.95);
  // Its known failure: a bias that is larger than the depth of a receiver removes the shadow of what was clamped.
  fit.near_offset = 0.0;
  params.bias.constant = 3.0;
  const Image<float> lost = shadow(uploaded, seen.gpu, light, fitted(), params);
  EXPECT_GT(mean(lost), mean(shadow(uploaded, seen.gpu, light, whole, params)) + 0.02);
}

}  // namespace
}  // namespace umbrameter
