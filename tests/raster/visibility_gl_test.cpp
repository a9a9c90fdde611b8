#include <cmath>
#include <functional>
#include <limits>

#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// Whether anything of the scene lies between the surfel and the light: every triangle, in double precision.
bool is_blocked(const std::vector<Triangle>& triangles, const Light& light, const dvec3& position,
                const dvec3& normal) {
  const dvec3 origin = position + 1e-5 * normal;
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  const dvec3 direction = is_directional ? to_light(light, position) : light.position() - origin;
  const double end = is_directional ? std::numeric_limits<double>::infinity() : 1.0;
  for (const Triangle& triangle : triangles) {
    const dvec3 ab = triangle.b - triangle.a;
    const dvec3 ac = triangle.c - triangle.a;
    const dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) continue;
    const dvec3 from = origin - triangle.a;
    const double u = glm::dot(from, p) / determinant;
    const dvec3 q = glm::cross(from, ab);
    const double v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < end) return true;
  }
  return false;
}

Image<float> trace_truth(const Scene& scene, const GBuffer& gbuffer, const Light& light) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const auto count = scene.meshes[scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < count; ++t) triangles.push_back(world_triangle(scene, i, t));
  }
  Image<float> truth(gbuffer.width, gbuffer.height, 1.0f);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    const dvec3 position(gbuffer.position[i]);
    const dvec3 normal(gbuffer.geometric_normal[i]);
    const bool is_turned_away = glm::dot(normal, to_light(light, position)) <= 0;
    truth[i] = is_turned_away || is_blocked(triangles, light, position, normal) ? 0.0f : 1.0f;
  }
  return truth;
}

Mesh sphere(double radius, int rings) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int y = 0; y <= rings; ++y) {
    for (int x = 0; x < columns; ++x) {
      const double polar = pi * y / rings;
      const double azimuth = 2 * pi * x / columns;
      mesh.positions.emplace_back(radius * std::sin(polar) * std::cos(azimuth), radius * std::cos(polar),
                                  radius * std::sin(polar) * std::sin(azimuth));
    }
  }
  for (int y = 0; y < rings; ++y) {
    for (int x = 0; x < columns; ++x) {
      const auto a = static_cast<std::uint32_t>(y * columns + x);
      const auto b = static_cast<std::uint32_t>(y * columns + (x + 1) % columns);
      const auto row = static_cast<std::uint32_t>(columns);
      if (y > 0) mesh.triangles.emplace_back(a, b, a + row);
      if (y + 1 < rings) mesh.triangles.emplace_back(b, b + row, a + row);
    }
  }
  return mesh;
}

Scene still_life() {
  Scene scene;
  add_mesh(scene, quad({-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, {-6, 0, -6}));
  add_mesh(scene, box({-1, 0, -1}, {0, 1.5f, 0}));
  dmat4 raised(1.0);
  raised[3] = dvec4(1.2, 1.0, 0.6, 1);
  add_mesh(scene, sphere(0.7, 8), raised);
  add_mesh(scene, box({-2.5f, 0.3f, 0.8f}, {-1.5f, 0.31f, 1.8f}));
  return scene;
}

struct Filter {
  ShadowFilter filter;
  int size;
};

class VisibilityGl : public GlTest {};

TEST_F(VisibilityGl, The_classes_add_up_to_the_error_at_every_pixel_for_every_kind_of_light) {
  const Scene scene = still_life();
  const UploadedScene uploaded = upload(context(), scene);
  const View view = perspective_view(120, 80, {4, 5, 6}, {0, 0.5, 0});
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const GBuffer gbuffer = read_back(context(), surfels);
  for (const Light& light :
       {directional_light({1.5, 2, 1}), spot_light({2, 5, 2}, {0, 0, 0}, 0.7), point_light({2, 3, 2.5})}) {
    const Image<float> truth = trace_truth(scene, gbuffer, light);
    const gl::Texture truth_texture = upload(context(), truth);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 128));
    vec4 most(0);
    for (const Filter filter : {Filter{ShadowFilter::nearest, 3}, Filter{ShadowFilter::box, 3}}) {
      for (const double bias : {-0.05, 0.0, 0.02, 0.3, 3.0}) {
        for (const double slope : {0.0, 1.0}) {
          ShadowParams params;
          params.bias.constant = bias;
          params.bias.slope = slope;
          params.pcf.filter = filter.filter;
          params.pcf.size = filter.size;
          const RasterVisibility found = draw_visibility(
              context(), {uploaded, surfels, map, light, params.bias, make_technique(params), &truth_texture});
          for (std::size_t i = 0; i < truth.size(); ++i) {
            const vec4 c = shares(found.wrong, i);
            ASSERT_NEAR(c.x + c.y + c.z + c.w, std::abs(found.visibility[i] - truth[i]), 1e-6f) << i;
            ASSERT_TRUE(c.x >= 0 && c.y >= 0 && c.z >= 0 && c.w >= 0);
            ASSERT_TRUE(gbuffer.is_surface(i) || found.visibility[i] == 1.0f);
            const dvec3 position(gbuffer.position[i]);
            if (gbuffer.is_surface(i) &&
                glm::dot(dvec3(gbuffer.geometric_normal[i]), to_light(light, position)) < -1e-6) {
              ASSERT_EQ(found.visibility[i], 0.0f);
              ASSERT_EQ(c, vec4(0));
            }
          }
          most = glm::max(most, mean(found.wrong));
          // Visibility without a truth is the same picture.
          ASSERT_EQ(draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)})
                        .visibility,
                    found.visibility);
        }
      }
    }
    EXPECT_GT(most.x, 0.1f) << "no acne at a bias of 0";
    EXPECT_GT(most.y, 0.001f) << "no false occlusion at any bias";
    EXPECT_GT(most.z, 0.005f) << "no peter-panning at a bias of 3 m";
    EXPECT_GT(most.w, 0.0002f) << "no leak at any bias";
  }
}

TEST_F(VisibilityGl, Visibility_never_falls_as_the_bias_grows) {
  const Scene scene = still_life();
  const UploadedScene uploaded = upload(context(), scene);
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, perspective_view(120, 80, {4, 5, 6}, {0, 0.5, 0}));
  for (const Light& light :
       {directional_light({1.5, 2, 1}), spot_light({2, 5, 2}, {0, 0, 0}, 0.7), point_light({2, 3, 2.5})}) {
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 128));
    for (const bool is_slope : {false, true}) {
      ShadowParams params;
      params.pcf.filter = ShadowFilter::box;
      params.pcf.size = 5;
      Image<float> before(120, 80, 0.0f);
      double grown = 0.0;
      for (const double bias : {-1.0, 0.0, 0.01, 0.1, 0.5, 2.0, 100.0}) {
        params.bias.constant = is_slope ? 0.02 : bias;
        params.bias.slope = is_slope ? bias : 0.0;
        const Image<float> now =
            draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)}).visibility;
        for (std::size_t i = 0; i < now.size(); ++i) ASSERT_GE(now[i], before[i]) << i << " at " << bias;
        grown += mean(now) - mean(before);
        before = now;
      }
      EXPECT_GT(grown, 0.3);
    }
  }
}

// The bias at which a surfel flips, to a relative 1e-6.
double flip_bias(const std::function<bool(double)>& is_lit, double blocked, double lit) {
  EXPECT_FALSE(is_lit(blocked));
  EXPECT_TRUE(is_lit(lit));
  while (lit - blocked > 1e-6 * lit) {
    const double middle = 0.5 * (blocked + lit);
    (is_lit(middle) ? lit : blocked) = middle;
  }
  return lit;
}

TEST_F(VisibilityGl, Constant_and_slope_scaled_bias_flip_a_tap_at_its_critical_bias_for_every_kind_of_light) {
  // A slab two metres above the floor: its critical bias is the receiver's depth less the slab's.
  Scene scene;
  add_mesh(scene, ground(30));
  add_mesh(scene, quad({-20, 2, 20}, {20, 2, 20}, {20, 2, -20}, {-20, 2, -20}));
  const UploadedScene uploaded = upload(context(), scene);
  const dvec3 position(0.7, 0, -0.4);
  GBuffer one = surfels_on_ground(1, 1, 0, 1, 0, 1);
  one.position[0] = vec3(position);
  const GpuGBuffer surfel = upload(context(), one);
  for (const Light& light :
       {directional_light({1.5, 4, 1}), spot_light({3, 6, 2}, {0, 0, 0}, 0.7), point_light({3, 6, 2.5})}) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 1024);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    const auto is_lit = [&](double constant, double slope) {
      ShadowParams params;
      params.bias.constant = constant;
      params.bias.slope = slope;
      return draw_visibility(context(), {uploaded, surfel, map, light, params.bias, make_technique(params)})
                 .visibility[0] == 1.0f;
    };
    const dvec3 l = to_light(light, position);
    const double tangent = std::sqrt(1.0 - l.y * l.y) / l.y;
    const double texel = texel_at(layout, position);
    const double beta = flip_bias([&](double bias) { return is_lit(bias, 0.0); }, 0.0, 50.0);
    // The ray meets the slab 2 / l.y before the floor; the sample is up to half a texel's diagonal aside.
    const double along = 2.0 / l.y * (layout.kind == MapKind::perspective ? glm::dot(-light.axis(), l) : 1.0);
    EXPECT_NEAR(beta, along, texel * (1.0 + tangent));
    const double factor = flip_bias([&](double slope) { return is_lit(0.0, slope); }, 0.0, 1e5);
    EXPECT_NEAR(factor * texel * tangent, beta, 1e-5 * beta) << "one texel of slope is texel_at times tan";
  }
}

TEST_F(VisibilityGl, Each_class_has_the_cause_that_it_is_named_for) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-8, 2, -8}, {8, 2.5f, 8}));
  const UploadedScene uploaded = upload(context(), scene);
  const MapLayout layout = exact_layout({0.02, 1, 0.01}, 64, 0.25, 0.1);
  const Light light = light_of(layout);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
  const GpuGBuffer under = upload(context(), surfels_on_ground(32, 32, -4, 4, -4, 4));
  const gl::Texture lit = upload(context(), Image<float>(32, 32, 1.0f));
  const gl::Texture blocked = upload(context(), Image<float>(32, 32, 0.0f));
  const auto classes = [&](const UploadedScene& in, const ShadowMap& with, double bias, const gl::Texture& truth) {
    ShadowParams params;
    params.bias.constant = bias;
    return mean(
        draw_visibility(context(), {in, under, with, light, params.bias, make_technique(params), &truth}).wrong);
  };
  EXPECT_EQ(classes(uploaded, map, 0.1, lit), vec4(0, 1, 0, 0)) << "the slab above stands in front";
  EXPECT_EQ(classes(uploaded, map, 4.0, blocked), vec4(0, 0, 1, 0)) << "the bias is more than the slab's height";
  Scene bare;
  add_mesh(bare, ground(20));
  const UploadedScene uploaded_bare = upload(context(), bare);
  const ShadowMap bare_map = draw_shadow_map(context(), uploaded_bare, light, layout);
  EXPECT_EQ(classes(uploaded_bare, bare_map, 0.1, blocked), vec4(0, 0, 0, 1)) << "the map holds no blocker";
  EXPECT_EQ(classes(uploaded_bare, bare_map, -0.1, lit), vec4(1, 0, 0, 0)) << "the plane shadows itself";
  EXPECT_EQ(classes(uploaded_bare, bare_map, 0.1, lit), vec4(0));
}

TEST_F(VisibilityGl, A_flat_floor_of_many_turned_tiles_is_one_surface) {
  // Neighbouring tiles are different instances whose stored positions differ by rounding.
  Scene scene;
  const dmat4 turned = look_at({31.7, -12.9, 55.3}, {30.1, -10.2, 54.4});
  for (int z = -8; z < 8; ++z) {
    for (int x = -8; x < 8; ++x) {
      dmat4 placed(1.0);
      placed[3] = dvec4(0.37 * x, 0, 0.37 * z, 1);
      dmat4 world = turned * placed;
      for (int column = 0; column < 4; ++column) world[column] = dvec4(vec4(world[column]));  // as a file stores it
      add_mesh(scene, quad({0, 0, 0.37f}, {0.37f, 0, 0.37f}, {0.37f, 0, 0}, {0, 0, 0}), world);
    }
  }
  const UploadedScene uploaded = upload(context(), scene);
  const dvec3 up(turned[1]);
  const dvec3 middle(turned[3]);
  const View view = perspective_view(200, 200, middle + 3.0 * up + dvec3(0.5, 0, 0), middle);
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const gl::Texture lit = upload(context(), Image<float>(200, 200, 1.0f));
  const dvec3 above = middle + 4.0 * up + 3.0 * dvec3(turned[0]);
  for (const Light& light : {directional_light(above - middle), spot_light(above, middle, 0.6), point_light(above)}) {
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 256));
    ShadowParams params;
    params.bias.constant = 0.0;
    params.pcf.filter = ShadowFilter::box;
    const vec4 classes = mean(
        draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params), &lit}).wrong);
    EXPECT_GT(classes.x, 0.2f);
    EXPECT_EQ(classes.y, 0.0f);
  }
}

TEST_F(VisibilityGl, A_sphere_shadows_itself_with_acne_and_not_with_false_occlusion) {
  Scene scene;
  add_mesh(scene, sphere(1.0, 24));
  const UploadedScene uploaded = upload(context(), scene);
  const View view = orthographic_view(128, 128, {2, 5, 1}, {0, 0, 0}, 1.1);
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const gl::Texture lit = upload(context(), Image<float>(128, 128, 1.0f));
  const Light light = directional_light({2, 4, 0});
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 128));
  ShadowParams params;
  params.bias.constant = 0.0;
  const vec4 classes = mean(
      draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params), &lit}).wrong);
  EXPECT_GT(classes.x, 0.1f);
  EXPECT_LT(classes.y, 0.005f * classes.x);
}

TEST_F(VisibilityGl, Box_taps_go_on_over_the_edges_of_cube_faces) {
  // A closed room lit from inside: no tap of any surfel may miss the map, whatever face it is on.
  Scene scene;
  add_mesh(scene, box({-3, -3, -3}, {3, 3, 3}));
  scene.materials[0].double_sided = true;
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = point_light({0.2, 0.1, -0.3});
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 16));
  for (const dvec3& target : {dvec3(1, 1, 1), dvec3(-1, 0.5, 1), dvec3(0.3, -1, -1)}) {
    const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, perspective_view(96, 96, {0, 0, 0}, target, 2.0));
    ShadowParams params;
    params.pcf.filter = ShadowFilter::box;
    params.pcf.size = 7;
    params.bias.constant = -20.0;  // a tap with any blocker says blocked
    EXPECT_EQ(mean(draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)})
                       .visibility),
              0.0);
    params.bias.constant = 20.0;
    EXPECT_EQ(mean(draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)})
                       .visibility),
              1.0);
  }
}

TEST_F(VisibilityGl, Off_the_map_everything_is_lit) {
  Scene scene;
  add_mesh(scene, ground(50));
  add_mesh(scene, box({-20, 2, -20}, {20, 3, 20}));
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = spot_light({0, 5, 0}, {0, 0, 0.01}, 0.3);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 64));
  // The cone meets the floor within 5 tan 0.3 = 1.55 m of the origin, the map's corner within 2.2 m.
  ShadowParams params;
  params.pcf.filter = ShadowFilter::box;
  const GpuGBuffer outside = upload(context(), surfels_on_ground(16, 16, 4, 6, -1, 1));
  const GpuGBuffer within = upload(context(), surfels_on_ground(16, 16, -0.5, 0.5, -0.5, 0.5));
  EXPECT_EQ(
      mean(draw_visibility(context(), {uploaded, outside, map, light, params.bias, make_technique(params)}).visibility),
      1.0);
  EXPECT_EQ(
      mean(draw_visibility(context(), {uploaded, within, map, light, params.bias, make_technique(params)}).visibility),
      0.0);
}

TEST_F(VisibilityGl, A_masked_fence_casts_the_holes_of_its_mask) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, quad({-2, 2, 2}, {2, 2, 2}, {2, 2, -2}, {-2, 2, -2}));
  Texture texture;
  texture.texels = Image<glm::u8vec4>(2, 1, glm::u8vec4(255));
  texture.texels[0].w = 0;
  texture.wrap_u = Wrap::clamp_to_edge;
  scene.textures = {texture};
  scene.materials[1].base_color_texture = 0;
  scene.materials[1].alpha_mode = AlphaMode::mask;
  for (const bool is_cube : {false, true}) {
    const Light light = is_cube ? point_light({0.001, 200, 0.002}) : directional_light({0.001, 1, 0.002});
    MapLayout layout =
        is_cube ? fit_light(light, bounds_of(scene), 2048) : exact_layout({0.001, 1, 0.002}, 256, 0.05, 0);
    const UploadedScene uploaded = upload(context(), scene);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    ShadowParams params;
    params.bias.constant = 0.5;
    // Alpha is 1/2 at the middle, x = 0: transparent to its left, opaque to its right.
    const GpuGBuffer left = upload(context(), surfels_on_ground(16, 16, -1.5, -0.3, -1.5, 1.5));
    const GpuGBuffer right = upload(context(), surfels_on_ground(16, 16, 0.3, 1.5, -1.5, 1.5));
    const Light seen = is_cube ? light : light_of(layout);
    EXPECT_EQ(
        mean(draw_visibility(context(), {uploaded, left, map, seen, params.bias, make_technique(params)}).visibility),
        1.0);
    EXPECT_EQ(
        mean(draw_visibility(context(), {uploaded, right, map, seen, params.bias, make_technique(params)}).visibility),
        0.0);
  }
}

}  // namespace
}  // namespace umbrameter
