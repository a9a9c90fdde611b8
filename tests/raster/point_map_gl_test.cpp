// The maps of point lights: paraboloids, and cubes drawn in six passes.
#include <algorithm>
#include <cmath>

#include "map_depth_cases.h"
#include "raster/shadow/map_layer.h"
#include "techniques/shadow/reference/lookup.h"
#include "tests/support/shadow_depths.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;
using test::to_metres;

class PointMapGl : public MapDepthGl {};

// A sphere about a point, seen from inside; bands of rings · 2 rings quads.
Mesh sphere(const dvec3& center, double radius, int rings) {
  Mesh mesh;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (2 * rings + 1) + i); };
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i <= 2 * rings; ++i) {
      const double theta = pi * j / rings;
      const double phi = pi * i / rings;
      mesh.positions.emplace_back(
          center + radius * dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
    }
  }
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < 2 * rings; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return mesh;
}

MapLayout paraboloids(const Light& light, const Scene& scene, int resolution) {
  return with_point_map(fit_light(light, bounds_of(scene), resolution), PointMap::paraboloid);
}

// Whether a texel's centre is in the circle that the hemisphere fills, and so many texels from its edge.
bool is_in_circle(const MapLayout& layout, int x, int y, double margin) {
  const dvec2 p = (dvec2(x, y) + 0.5) / static_cast<double>(layout.resolution) * 2.0 - 1.0;
  return glm::length(p) < 1.0 - 2.0 * margin / layout.resolution;
}

TEST_F(PointMapGl, Paraboloids_hold_the_radius_of_a_fine_sphere_in_all_directions) {
  const Light light = point_light({0.5, 0.25, -0.75});
  Scene scene;
  add_mesh(scene, sphere(light.position(), 2.0, 200));
  const MapLayout layout = paraboloids(light, scene, 128);
  const std::vector<Image<float>> depths = to_metres(draw(scene, light, layout), layout);
  ASSERT_EQ(depths.size(), 2u);
  for (const Image<float>& view : depths) {
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        // A quad of 0.9° lies up to 2 m · (1 − cos 0.64°) inside the sphere.
        if (is_in_circle(layout, x, y, 1.0)) {
          ASSERT_NEAR(view.at(x, y), 2.0, 2.5e-4) << x << " " << y;
        }
        if (!is_in_circle(layout, x, y, -1.0)) {
          ASSERT_TRUE(std::isinf(view.at(x, y)));
        }
      }
    }
  }
}

TEST_F(PointMapGl, Paraboloids_bend_no_edges_so_that_large_triangles_are_in_the_wrong_place) {
  const Light light = point_light({0.5, 0.25, -0.75});
  Scene coarse;
  add_mesh(coarse, box({-3, -2, -4}, {5, 3, 4}));
  // The depths along the texels' rays, of the box's twelve triangles.
  const MapLayout layout = paraboloids(light, coarse, 128);
  const std::vector<Image<float>> depths = to_metres(draw(coarse, light, layout), layout);
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  int wrong = 0;
  int counted = 0;
  for (int view = 0; view < 2; ++view) {
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        if (!is_in_circle(layout, x, y, 1.0)) continue;
        const dvec3 d(world_from_light * dvec4(glm::normalize(texel_ray(layout, {x, 127 - y}, view).direction), 0));
        double expected = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
          const double side = d[axis] > 0 ? dvec3(5, 3, 4)[axis] : dvec3(-3, -2, -4)[axis];
          expected = std::min(expected, (side - light.position()[axis]) / d[axis]);
        }
        ++counted;
        const auto depth = static_cast<double>(depths[static_cast<std::size_t>(view)].at(x, y));
        if (!(std::abs(depth - expected) < 0.05 * expected)) ++wrong;
      }
    }
  }
  EXPECT_GT(wrong, counted / 3);
}

TEST(PointMap, A_texels_ray_falls_on_that_texel_and_texels_are_as_large_as_stated) {
  const Light light = point_light({1, 2, 3});
  Bounds bounds;
  bounds.include(dvec3(-5));
  bounds.include(dvec3(6));
  const MapLayout layout = with_point_map(fit_light(light, bounds, 256), PointMap::paraboloid);
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  const auto place = [&](int x, int y, int view) {
    return dvec3(world_from_light * dvec4(3.0 * glm::normalize(texel_ray(layout, {x, y}, view).direction), 1.0));
  };
  for (int view = 0; view < 2; ++view) {
    for (int y = 0; y < 255; y += 5) {
      for (int x = 0; x < 255; x += 5) {
        const dvec3 here = place(x, y, view);
        const Receiver receiver = project_to_map(layout, here);
        ASSERT_NEAR(receiver.depth, 3.0, 1e-9);
        EXPECT_NEAR(depth_of(layout, here), 3.0, 1e-9);
        if (!is_in_circle(layout, x, y, 1.0)) continue;
        ASSERT_EQ(receiver.view, view);
        ASSERT_EQ(receiver.texel, ivec2(x, y));
        EXPECT_TRUE(receiver.is_inside);
        const double side = texel_at(layout, here);
        EXPECT_NEAR(glm::length(place(x + 1, y, view) - here), side, 0.01 * side);
        EXPECT_NEAR(glm::length(place(x, y + 1, view) - here), side, 0.01 * side);
      }
    }
  }
}

TEST_F(PointMapGl, A_cube_drawn_in_six_passes_is_the_same_map) {
  Scene scene;
  add_mesh(scene, box({-3, -2, -4}, {5, 3, 4}));
  add_mesh(scene, box({-1, -1, 1}, {0, 0, 2}));
  const Light light = point_light({0.5, 0.25, -0.75});
  const MapLayout layout = fit_light(light, bounds_of(scene), 128);
  for (const DepthEncoding encoding : {DepthEncoding::linear, DepthEncoding::perspective}) {
    for (const StoredSurface surface : {StoredSurface::nearest, StoredSurface::midpoint}) {
      MapDepthParams params = stored_as(MapDepthFormat::fixed24, encoding);
      params.surface = surface;
      const ShadowMapImages once = draw(scene, light, layout, params);
      params.cube_passes = true;
      const ShadowMapImages passes = draw(scene, light, layout, params);
      for (std::size_t face = 0; face < 6; ++face) {
        ASSERT_TRUE(once.depth[face].pixels == passes.depth[face].pixels);
        ASSERT_TRUE(once.instance[face].pixels == passes.instance[face].pixels);
        ASSERT_TRUE(once.triangle[face].pixels == passes.triangle[face].pixels);
      }
    }
  }
}

TEST_F(PointMapGl, Surfaces_and_offsets_work_on_paraboloids_too) {
  const Light light = point_light({0.5, 0.25, -0.75});
  Scene scene;
  add_mesh(scene, sphere(light.position(), 3.0, 100));
  add_mesh(scene, sphere(light.position(), 2.0, 100));
  const MapLayout layout = paraboloids(light, scene, 64);
  struct Case {
    MapDepthParams params;
    double depth;
  };
  MapDepthParams dual = of_surface(StoredSurface::dual);
  dual.dual_offset = 0.25;
  MapDepthParams offset = stored_as(MapDepthFormat::fixed16, DepthEncoding::reversed);
  offset.polygon_offset_units = 1000.0;
  const double unit = measure_offset_unit(context(), MapDepthFormat::fixed16);
  for (const Case& c : {Case{of_surface(StoredSurface::second), 3.0}, Case{of_surface(StoredSurface::midpoint), 2.5},
                        Case{dual, 2.25}, Case{offset, 2.0 + 1000.0 * unit * layout.far_depth},
                        Case{stored_as(MapDepthFormat::fixed24, DepthEncoding::perspective), 2.0}}) {
    for (const Image<float>& view : to_metres(draw(scene, light, layout, c.params), layout)) {
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          if (is_in_circle(layout, x, y, 1.0)) {
            ASSERT_NEAR(view.at(x, y), c.depth, 2e-3) << x << " " << y;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
