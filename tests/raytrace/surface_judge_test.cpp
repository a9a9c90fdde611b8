// Surfaces whose continuity is known by construction, seen by a sun, a spot light and a point light.
#include "raytrace/surface_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "scenes/builtin.h"
#include "tests/support/reference_caster.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// From that side, all aimed at the origin; the last two ten metres away.
std::vector<Light> lights_from(const dvec3& towards_light) {
  const Light sun = shapes::directional(towards_light);
  Light spot = sun;
  spot.world_from_light[3] = dvec4(10.0 * glm::normalize(towards_light), 1.0);
  spot.shape = SpotLight{0.0, 0.0, 0.5};
  Light point = spot;
  point.shape = PointLight{};
  return {sun, spot, point};
}

// The point that the light sees on its way to a position in the world.
SurfacePoint seen_towards(const ReferenceCaster& caster, const Light& light, const MapLayout& layout,
                          const dvec3& position) {
  const dvec3 direction = -to_light(light, position);
  const dvec3 origin = position - 50.0 * direction;
  const bool is_sun = layout.kind == MapKind::orthographic;
  const dvec3 start = is_sun ? origin : light.position();
  const auto hit = caster.nearest(start, direction, 0.0, 1e3, false);
  if (!hit) throw std::logic_error("the light sees nothing there");
  return {dvec3(layout.light_from_world * dvec4(start + hit->t * direction, 1.0)), hit->instance, hit->triangle};
}

// What the judge says of the light's view of two positions, for every kind of light.
void expect_own(const Scene& scene, const dvec3& towards_light, const dvec3& receiver, const dvec3& sample, bool own) {
  const Tracer tracer(scene);
  const ReferenceCaster caster(scene);
  for (const Light& light : lights_from(towards_light)) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 1024);
    const TapSurfaces tap{seen_towards(caster, light, layout, receiver), seen_towards(caster, light, layout, sample)};
    EXPECT_EQ(test_same_surface(tracer, layout, {&tap, 1}, Continuity::seen).front() != 0, own)
        << "light " << light.shape.index();
    const TapSurfaces turned{tap.sample, tap.receiver};
    EXPECT_EQ(test_same_surface(tracer, layout, {&turned, 1}, Continuity::seen).front() != 0, own)
        << "turned, light " << light.shape.index();
  }
}

// A surface y = height(x, z) over [-1, 1]², in cells of 2 / cells metres.
Scene height_field(int cells, const std::function<double(double, double)>& height) {
  Mesh mesh;
  const auto at = [cells](int i) { return -1.0 + 2.0 * i / cells; };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) mesh.positions.emplace_back(dvec3(at(i), height(at(i), at(j)), at(j)));
  }
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.triangles.emplace_back(a, a + row, a + 1);
      mesh.triangles.emplace_back(a + 1, a + row, a + row + 1);
    }
  }
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, std::move(mesh));
  return scene;
}

const dvec3 oblique(0.3, 1.0, 0.2);

// A roof over the part x < 0.3 of a bulge, seen from above. The receiver is below the roof, the sample beside it.
TEST(SurfaceJudge, A_blocked_receiver_s_own_layer_goes_on_below_what_blocks_it) {
  Scene scene = height_field(60, [](double x, double z) { return -0.3 * (x * x + z * z); });
  shapes::add_mesh(scene, shapes::quad({-1, 0.5, 1}, {1.3, 0, 0}, {0, 0, -2}));
  const Tracer tracer(scene);
  const ReferenceCaster caster(scene);
  for (const Light& light : lights_from({0.0, 1.0, 0.0})) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 1024);
    const auto at = [&](double x, bool on_roof) {
      SurfacePoint point = seen_towards(caster, light, layout, {x, on_roof ? 0.5 : -0.3 * x * x, 0.1});
      return point;
    };
    const SurfacePoint beside = at(0.4, false);
    const SurfacePoint roof = at(-0.3, true);
    // Straight below that point of the roof.
    Scene open = height_field(60, [](double x, double z) { return -0.3 * (x * x + z * z); });
    const ReferenceCaster below(open);
    const SurfacePoint receiver = seen_towards(below, light, layout, {-0.3, -0.027, 0.1});
    const auto judged = [&](const SurfacePoint& sample, Continuity continuity) {
      const TapSurfaces tap{receiver, sample};
      return test_same_surface(tracer, layout, {&tap, 1}, continuity).front() != 0;
    };
    EXPECT_TRUE(judged(beside, Continuity::own_layer)) << "light " << light.shape.index();
    EXPECT_FALSE(judged(beside, Continuity::seen)) << "the light sees the roof between them";
    EXPECT_FALSE(judged(roof, Continuity::own_layer)) << "light " << light.shape.index();
  }
}

TEST(SurfaceJudge, A_finely_tessellated_bulge_is_one_surface) {
  const Scene scene = height_field(150, [](double x, double z) { return -0.3 * (x * x + z * z); });
  expect_own(scene, oblique, {-0.61, 0.0, 0.13}, {0.42, 0.0, -0.37}, true);
}

TEST(SurfaceJudge, A_finely_tessellated_hollow_is_one_surface) {
  const Scene scene = height_field(150, [](double x, double z) { return 0.3 * (x * x + z * z); });
  expect_own(scene, oblique, {-0.61, 0.0, 0.13}, {0.42, 0.0, -0.37}, true);
}

TEST(SurfaceJudge, A_wave_is_one_surface_although_each_end_s_plane_says_otherwise) {
  // At x = -0.5 the curve 0.1 sin 3x is hollow, at 0.4 it bulges. The sample stands above the receiver's tangent by
  // f(b) - f(a) - f'(a)(b - a) = 0.174, the receiver below the sample's by f(b) - f(a) - f'(b)(b - a) = 0.095.
  const Scene scene = height_field(150, [](double x, double) { return 0.1 * std::sin(3.0 * x); });
  expect_own(scene, oblique, {-0.5, -0.1, 0.1}, {0.4, 0.093, 0.1}, true);
}

TEST(SurfaceJudge, Slopes_that_meet_in_a_fold_are_one_surface) {
  expect_own(height_field(2, [](double x, double) { return -std::abs(x); }), oblique, {-0.6, 0, 0.1}, {0.5, 0, 0},
             true);
  expect_own(height_field(2, [](double x, double) { return std::abs(x); }), oblique, {-0.6, 0, 0.1}, {0.5, 0, 0}, true);
}

// A low tread left of x = 0, a riser, and a high one 0.3 m above it, in one mesh with shared corners.
Scene stair() {
  Mesh mesh;
  for (const float z : {-1.0f, 1.0f}) {
    for (const vec2 p : {vec2(-1, 0), vec2(0, 0), vec2(0, 0.3f), vec2(1, 0.3f)}) mesh.positions.emplace_back(p, z);
  }
  for (const std::uint32_t i : {0u, 1u, 2u}) {
    mesh.triangles.emplace_back(i, i + 4, i + 1);
    mesh.triangles.emplace_back(i + 1, i + 4, i + 5);
  }
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, std::move(mesh));
  return scene;
}

TEST(SurfaceJudge, A_stair_whose_riser_the_light_does_not_see_is_a_jump) {
  expect_own(stair(), {0.4, 1.0, 0.1}, {-0.5, 0.0, 0.0}, {0.1, 0.3, 0.03}, false);
}

TEST(SurfaceJudge, A_stair_whose_riser_the_light_sees_is_one_surface) {
  expect_own(stair(), {-0.4, 1.0, 0.1}, {-0.5, 0.0, 0.0}, {0.1, 0.3, 0.03}, true);
}

// A floor, and a sheet over its right half.
Scene sheets(float gap) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  shapes::add_mesh(scene, shapes::quad({0, gap, 1}, {1, 0, 0}, {0, 0, -2}));
  return scene;
}

TEST(SurfaceJudge, Parallel_sheets_are_two_surfaces_down_to_a_tenth_of_a_millimetre_seen_from_ten_metres) {
  for (const float gap : {0.5f, 0.01f, 1e-4f}) {
    expect_own(sheets(gap), oblique, {-0.6, 0.0, 0.0}, {0.4, static_cast<double>(gap), 0.1}, false);
  }
}

TEST(SurfaceJudge, Planks_side_by_side_in_one_plane_are_one_surface) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-1, 0.2f, 1}, {1, 0, 0}, {0, 0, -2}));
  shapes::add_mesh(scene, shapes::quad({0, 0.2f, 1}, {1, 0, 0}, {0, 0, -2}));
  expect_own(scene, oblique, {-0.6, 0.2, 0.0}, {0.4, 0.2, 0.1}, true);
}

TEST(SurfaceJudge, A_slit_between_planks_is_a_jump_even_where_the_light_meets_nothing_behind) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-1, 0.2f, 1}, {0.8f, 0, 0}, {0, 0, -2}));
  shapes::add_mesh(scene, shapes::quad({0, 0.2f, 1}, {1, 0, 0}, {0, 0, -2}));
  expect_own(scene, {0, 1, 0.01}, {-0.5, 0.2, 0.0}, {0.3, 0.2, 0.1}, false);
}

// Two planks that meet at x = 0, over a floor; the left one's mask is clear on its last three eighths, or nowhere.
Scene masked_planks(bool has_hole) {
  Scene scene = shapes::empty_scene();
  Material mask = scene.materials.front();
  mask.alpha_mode = AlphaMode::mask;
  mask.base_color_texture = 0;
  scene.materials.push_back(mask);
  Texture texture;
  texture.texels = Image<glm::u8vec4>(8, 1, glm::u8vec4(255));
  texture.wrap_u = texture.wrap_v = Wrap::clamp_to_edge;
  for (int x = 5; x < 8 && has_hole; ++x) texture.texels.at(x, 0).w = 0;
  scene.textures.push_back(texture);
  Mesh left = shapes::quad({-1, 0.2f, 1}, {1, 0, 0}, {0, 0, -2});
  left.material = 1;
  shapes::add_mesh(scene, std::move(left));
  shapes::add_mesh(scene, shapes::quad({0, 0.2f, 1}, {1, 0, 0}, {0, 0, -2}));
  shapes::add_mesh(scene, shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  return scene;
}

TEST(SurfaceJudge, What_an_alpha_mask_clears_is_a_hole) {
  expect_own(masked_planks(true), {0, 1, 0.01}, {-0.8, 0.2, 0.0}, {0.2, 0.2, 0.1}, false);
  expect_own(masked_planks(false), {0, 1, 0.01}, {-0.8, 0.2, 0.0}, {0.2, 0.2, 0.1}, true);
}

TEST(SurfaceJudge, A_wall_that_reaches_over_an_edge_of_the_cube_is_one_surface) {
  // The corner of a room about a point light; the planes x = 2 and z = 2 meet on the diagonal between two faces.
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({2, -1, 2}, {0, 2, 0}, {0, 0, -4}));
  shapes::add_mesh(scene, shapes::quad({2, -1, 2}, {0, 2, 0}, {-4, 0, 0}));
  const Tracer tracer(scene);
  const ReferenceCaster caster(scene);
  Light light;
  light.shape = PointLight{};
  const MapLayout layout = fit_light(light, bounds_of(scene), 256);
  const TapSurfaces tap{{{2.0, 0.1, 1.0}, 0, 0}, {{1.2, -0.2, 2.0}, 1, 0}};
  TapSurfaces known = tap;
  known.receiver = seen_towards(caster, light, layout, tap.receiver.in_light);
  known.sample = seen_towards(caster, light, layout, tap.sample.in_light);
  EXPECT_EQ(test_same_surface(tracer, layout, {&known, 1}, Continuity::seen).front(), 1);
}

TEST(SurfaceJudge, Its_verdicts_do_not_depend_on_the_number_of_threads) {
  const Scene scene = load_scene("contact-box");
  const Light light = scene.lights.front();
  const MapLayout layout = fit_light(light, bounds_of(scene), 512);
  const Tracer tracer(scene);
  const Bounds bounds = bounds_of(scene);
  const ReferenceCaster caster(scene);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const dvec3 at = bounds.min + bounds.extent() * dvec3((i + 0.5) / 40.0, 0.0, (j + 0.5) / 40.0);
      const dvec3 direction = -to_light(light, at);
      const dvec3 origin = at - 50.0 * direction;
      const auto hit = caster.nearest(origin, direction, 0.0, 1e3, false);
      if (!hit) continue;
      points.push_back(
          {dvec3(layout.light_from_world * dvec4(origin + hit->t * direction, 1.0)), hit->instance, hit->triangle});
    }
  }
  std::vector<TapSurfaces> taps;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) taps.push_back({points[i], points[i + 1]});
  const auto judged = [&](int threads) {
    const ThreadLimit limit(threads);
    return test_same_surface(tracer, layout, taps, Continuity::seen);
  };
  const std::vector<std::uint8_t> one = judged(1);
  EXPECT_EQ(judged(4), one);
  EXPECT_GT(std::count(one.begin(), one.end(), 0), 0);
  EXPECT_GT(std::count(one.begin(), one.end(), 1), 0);
}

}  // namespace
}  // namespace umbrameter
