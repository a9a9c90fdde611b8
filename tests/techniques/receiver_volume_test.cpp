// The part of the frustum within the boxes of objects, against vertices worked out by hand.
#include "techniques/shadow/receiver_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "techniques/shadow/cascades.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const dvec3 up{0, 1, 0};

// At the origin, along −z; a side of the frustum is as far from the axis as it is away.
View camera() {
  View view;
  view.width = view.height = 100;
  view.camera.projection = PerspectiveProjection{.vertical_fov = 0.5 * pi, .near_plane = 0.5};
  return view;
}

Bounds box(const dvec3& low, const dvec3& high) {
  Bounds bounds;
  bounds.include(low);
  bounds.include(high);
  return bounds;
}

// Without duplicates, in some order.
std::vector<dvec3> vertices(const GBuffer& volume) {
  std::vector<dvec3> all;
  for (std::size_t i = 0; i < volume.depth.size(); ++i) {
    if (!volume.is_surface(i)) continue;
    const dvec3 p(volume.position[i]);
    EXPECT_NEAR(volume.depth[i], -p.z, 1e-5);
    if (std::ranges::none_of(all, [&](const dvec3& each) { return glm::length(each - p) < 1e-4; })) all.push_back(p);
  }
  return all;
}

void expect_vertices(const GBuffer& volume, const std::vector<dvec3>& expected) {
  const std::vector<dvec3> found = vertices(volume);
  EXPECT_EQ(found.size(), expected.size());
  for (const dvec3& each : expected) {
    const auto is_here = [&](const dvec3& p) { return glm::length(p - each) < 1e-4; };
    EXPECT_TRUE(std::ranges::any_of(found, is_here)) << each.x << " " << each.y << " " << each.z;
  }
}

const Bounds seen_box = box({-3, -1, -10}, {3, 0, -2});

TEST(ReceiverVolume, The_frustum_is_cut_by_the_box_and_by_its_own_sides) {
  // The sides of the frustum meet those of the box at 3 m.
  std::vector<dvec3> expected;
  for (const double y : {-1.0, 0.0}) {
    for (const double x : {-1.0, 1.0})
      expected.insert(expected.end(), {{2 * x, y, -2}, {3 * x, y, -3}, {3 * x, y, -10}});
  }
  expect_vertices(receiver_volume(camera(), up, std::vector{seen_box}, 0.0, infinity), expected);
}

TEST(ReceiverVolume, A_box_that_is_not_seen_widens_it_across_the_light_and_upwards_but_not_in_depth) {
  // Top 7 m, which the frustum reaches at 7 m; across ±20 m, more than the frustum has at 10 m.
  const std::vector<Bounds> boxes{seen_box, box({-20, -5, 5}, {20, 7, 6})};
  std::vector<dvec3> expected;
  for (const double x : {-1.0, 1.0}) {
    expected.insert(expected.end(),
                    {{2 * x, -1, -2}, {2 * x, 2, -2}, {7 * x, 7, -7}, {10 * x, -1, -10}, {10 * x, 7, -10}});
  }
  expect_vertices(receiver_volume(camera(), up, boxes, 0.0, infinity), expected);
}

TEST(ReceiverVolume, Depths_end_it_and_a_camera_that_sees_no_box_has_none) {
  const std::vector<dvec3> found = vertices(receiver_volume(camera(), up, std::vector{seen_box}, 4.0, 5.0));
  EXPECT_EQ(found.size(), 8u);
  for (const dvec3& p : found) EXPECT_TRUE(std::abs(p.z + 4.0) < 1e-4 || std::abs(p.z + 5.0) < 1e-4);
  EXPECT_TRUE(vertices(receiver_volume(camera(), up, std::vector{seen_box}, 11.0, infinity)).empty());
  EXPECT_TRUE(
      vertices(receiver_volume(camera(), up, std::vector{box({0, 0, 2}, {1, 1, 3}), Bounds()}, 0.0, infinity)).empty());
}

TEST(ReceiverVolume, An_orthographic_camera_has_parallel_sides) {
  View flat = camera();
  flat.camera.projection = OrthographicProjection{.half_height = 2.0};
  std::vector<dvec3> expected;
  for (const double y : {-1.0, 0.0}) {
    for (const double x : {-2.0, 2.0}) expected.insert(expected.end(), {{x, y, -2}, {x, y, -10}});
  }
  expect_vertices(receiver_volume(flat, up, std::vector{seen_box}, 0.0, infinity), expected);
}

// A map with and without a warp holds the volume, with one texel beside it.
TEST(ReceiverVolume, A_map_that_is_fitted_to_it_has_one_texel_more_on_each_side) {
  Light sun;
  sun.shape = DirectionalLight{};
  sun.world_from_light = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 0, 0, 1));
  const GBuffer seen(1, 1);
  MapFitParams fit;
  fit.fit = MapFit::view;
  fit.cascade_fit = CascadeFit::boxes;
  for (const Warp warp : {Warp::none, Warp::lispsm}) {
    fit.warp = warp;
    const MapLayout layout = fit_map(sun, {seen_box, {}, {seen_box}}, {512, 1}, {seen, camera()}, fit);
    EXPECT_EQ(layout.warp.has_value(), warp == Warp::lispsm);
    double low = 512.0;
    double high = 0.0;
    for (const dvec3& p : vertices(receiver_volume(camera(), up, std::vector{seen_box}, 0.0, infinity))) {
      const dvec2 texels = project_to_map(layout, p).texels;
      low = std::min(low, texels.y);
      high = std::max(high, texels.y);
    }
    EXPECT_NEAR(low, 1.0, 1e-3);
    EXPECT_NEAR(high, 511.0, 1e-3);
  }
}

}  // namespace
}  // namespace umbrameter
