#include <cmath>
#include <limits>

#include "core/error.h"
#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"
#include "tests/support/shadow_depths.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;
using test::to_metres;

class ShadowMapGl : public GlTest {
 protected:
  ShadowMapImages draw(const Scene& scene, const Light& light, const MapLayout& layout) const {
    return read_back(context(), draw_shadow_map(context(), upload(context(), scene), light, layout));
  }
};

// Position of a texel's centre in light space at depth 1 along the axis (orthographic: without its depth).
dvec2 center(const MapLayout& layout, int x, int y) {
  const double step = 2.0 * layout.views.front().half_extent / layout.resolution;
  return {(x + 0.5) * step - layout.views.front().half_extent, layout.views.front().half_extent - (y + 0.5) * step};
}

// Depth at which a ray of light space meets the plane y = 0 of the world; direction scaled as depth counts.
double depth_on_floor(const MapLayout& layout, const dvec3& origin, const dvec3& direction) {
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  const dvec3 o(world_from_light * dvec4(origin, 1));
  const dvec3 d(world_from_light * dvec4(direction, 0));
  return d.y < 0 ? -o.y / d.y : std::numeric_limits<double>::infinity();
}

TEST_F(ShadowMapGl, An_orthographic_map_holds_the_depth_of_the_plane_at_each_texel_centre) {
  Scene scene;
  add_mesh(scene, ground(60));
  const MapLayout layout = exact_layout({0.6, 0.7, -0.2}, 128, 0.1, 0.3);
  const ShadowMapImages map = draw(scene, light_of(layout), layout);
  const std::vector<Image<float>> depths = to_metres(map, layout);
  ASSERT_EQ(map.depth.size(), 1u);
  const double slope = std::sqrt(1.0 - 0.49 / 0.89) / (0.7 / std::sqrt(0.89));
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const double expected = depth_on_floor(layout, dvec3(center(layout, x, y), 0), {0, 0, -1});
      // Vertices snap to 1/256 texel, and 32-bit depth resolves 6e-8 of far_depth.
      ASSERT_NEAR(static_cast<double>(depths[0].at(x, y)), expected, 0.1 * slope / 128 + 2e-5) << x << " " << y;
      ASSERT_EQ(map.instance[0].at(x, y), 0u);
      ASSERT_EQ(map.triangle[0].at(x, y), 0u);
    }
  }
}

TEST_F(ShadowMapGl, A_spot_map_holds_linear_depth_along_its_axis) {
  Scene scene;
  add_mesh(scene, ground(200));
  const Light light = spot_light({1, 4, 2}, {0.5, 0, 0}, 0.6);
  const MapLayout layout = fit_light(light, bounds_of(scene), 128);
  const ShadowMapImages map = draw(scene, light, layout);
  const std::vector<Image<float>> depths = to_metres(map, layout);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const double expected = depth_on_floor(layout, dvec3(0), dvec3(center(layout, x, y), -1));
      ASSERT_NEAR(static_cast<double>(depths[0].at(x, y)), expected, 4e-6 * layout.far_depth) << x << " " << y;
    }
  }
}

TEST_F(ShadowMapGl, A_cube_map_holds_radial_distance_on_all_six_faces) {
  Scene scene;
  add_mesh(scene, box({-3, -2, -4}, {5, 3, 4}));
  const Light light = point_light({0.5, 0.25, -0.75});
  const MapLayout layout = fit_light(light, bounds_of(scene), 64);
  const ShadowMapImages map = draw(scene, light, layout);
  const std::vector<Image<float>> depths = to_metres(map, layout);
  ASSERT_EQ(map.depth.size(), 6u);
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  const dvec3 from(0.5, 0.25, -0.75);
  const dvec3 low(-3, -2, -4);
  const dvec3 high(5, 3, 4);
  int on_edges = 0;
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const dvec3 direction = glm::normalize(texel_ray(layout, {x, 63 - y}, face).direction);
        const dvec3 d(world_from_light * dvec4(direction, 0));
        double expected = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
          if (d[axis] != 0) {
            expected = std::min(expected, ((d[axis] > 0 ? high[axis] : low[axis]) - from[axis]) / d[axis]);
          }
        }
        const double error = std::abs(static_cast<double>(depths[static_cast<std::size_t>(face)].at(x, y)) - expected);
        // Where two sides of the box meet, a snapped vertex may give a texel to the other side: 1/256 texel at 45
        // degrees.
        ASSERT_LT(error, texel_at(layout, from + d * expected) / 128) << face << " " << x << " " << y;
        if (error > 5e-6) ++on_edges;
      }
    }
  }
  EXPECT_LT(on_edges, 6 * 64 * 64 / 500);
}

TEST_F(ShadowMapGl, Depths_agree_with_depth_of_for_every_kind_of_light) {
  Scene scene;
  const std::uint32_t triangle = add_mesh(scene, quad({-1, 1, 1}, {1, 1, 1}, {1, 1.5f, -1}, {-1, 1.5f, -1}));
  const dvec3 middle(0, 1.25, 0);  // on the quad's diagonal
  for (const Light& light :
       {directional_light({1, 3, 0.5}), spot_light({0.5, 4, 1}, middle, 0.5), point_light({0.5, 4, 1})}) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 257);
    const ShadowMapImages map = draw(scene, light, layout);
    const std::vector<Image<float>> depths = to_metres(map, layout);
    // The texel that looks at the middle: the one whose depth there is nearest in angle or position.
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < map.depth.size(); ++face) {
      for (std::size_t i = 0; i < depths[face].size(); ++i) {
        if (map.instance[face][i] != triangle) continue;
        nearest = std::min(nearest, std::abs(static_cast<double>(depths[face][i]) - depth_of(layout, middle)));
      }
    }
    EXPECT_LT(nearest, texel_at(layout, middle));
  }
}

TEST_F(ShadowMapGl, Texels_that_meet_nothing_are_infinitely_deep_and_have_no_id) {
  Scene scene;
  add_mesh(scene, quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}));
  const Light light = point_light({0, 2, 0});
  const ShadowMapImages map = draw(scene, light, fit_light(light, bounds_of(scene), 32));
  const std::vector<Image<float>> depths = to_metres(map, fit_light(light, bounds_of(scene), 32));
  int empty = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t i = 0; i < depths[face].size(); ++i) {
      const bool is_empty = std::isinf(depths[face][i]);
      ASSERT_EQ(map.instance[face][i] == no_id, is_empty);
      ASSERT_EQ(map.triangle[face][i] == no_id, is_empty);
      if (is_empty) ++empty;
    }
  }
  EXPECT_GT(empty, 5 * 32 * 32);
  EXPECT_LT(empty, 6 * 32 * 32);
}

TEST_F(ShadowMapGl, Back_faces_and_mirrored_instances_cast) {
  Scene scene;
  // Seen by the light from behind; no camera would draw it.
  add_mesh(scene, quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}));
  dmat4 mirror(1.0);
  mirror[1][1] = -1.0;
  mirror[3] = dvec4(3, 0, 0, 1);
  scene.instances.push_back({0, 0, mirror});
  const MapLayout layout = exact_layout({0.0, 1.0, 0.001}, 64, 0.2, 0.0);
  const ShadowMapImages map = draw(scene, light_of(layout), layout);
  int seen[2] = {};
  for (const std::uint32_t id : map.instance[0].pixels) {
    if (id != no_id) ++seen[id];
  }
  EXPECT_EQ(seen[0], 100);
  EXPECT_EQ(seen[1], 100);
}

TEST_F(ShadowMapGl, A_resolution_beyond_the_device_is_an_error_that_names_the_parameter) {
  const UploadedScene empty = upload(context(), Scene{});
  Light light = directional_light({0, 1, 0});
  MapLayout layout;
  layout.resolution = context().max_texture_size() + 1;
  EXPECT_THROW(draw_shadow_map(context(), empty, light, layout), Error);
  try {
    draw_shadow_map(context(), empty, light, layout);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("shadow.resolution"), std::string::npos);
  }
}

TEST_F(ShadowMapGl, A_map_drawn_over_another_is_that_of_fresh_textures) {
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, box({-1, 0.1f, -1}, {0, 1.5f, 0}));
  const UploadedScene uploaded = upload(context(), scene);
  const MapLayout first = exact_layout({0.6, 0.7, -0.2}, 128, 0.1, 0.3);
  const MapLayout second = exact_layout({-0.2, 0.9, 0.5}, 128, 0.07, 0.3);
  ShadowMap map = draw_shadow_map(context(), uploaded, light_of(first), first);
  ASSERT_TRUE(has_textures_for(map, second));
  map.layout = second;
  redraw_shadow_map(context(), uploaded, light_of(second), map);
  const ShadowMapImages again = read_back(context(), map);
  const ShadowMapImages fresh = read_back(context(), draw_shadow_map(context(), uploaded, light_of(second), second));
  EXPECT_TRUE(again.depth[0].pixels == fresh.depth[0].pixels);
  EXPECT_TRUE(again.instance[0].pixels == fresh.instance[0].pixels);
  EXPECT_TRUE(again.triangle[0].pixels == fresh.triangle[0].pixels);
  EXPECT_FALSE(has_textures_for(map, exact_layout({-0.2, 0.9, 0.5}, 256, 0.07, 0.3)));
}

}  // namespace
}  // namespace umbrameter
