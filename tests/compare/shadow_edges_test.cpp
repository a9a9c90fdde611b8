#include "compare/shadow_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flat_ground.h"

namespace umbrameter {
namespace {

const dvec3 overhead(0, 1, 0);

TEST(ShadowEdges, Lie_between_lit_and_blocked_neighbours) {
  const FlatGround ground(6, 4, 1.0, overhead, 1.0);
  const ShadowEdges edges = find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted);
  EXPECT_EQ(edges.count, 4u);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) EXPECT_EQ(edges.bits.at(x, y), x == 2 ? 1 : 0) << x << " " << y;
  }
}

TEST(ShadowEdges, A_silhouette_is_none) {
  FlatGround ground(6, 2, 1.0, overhead, 1.0);
  for (int y = 0; y < 2; ++y) {
    for (int x = 3; x < 6; ++x) ground.gbuffer.instance.at(x, y) = 1;
  }
  EXPECT_EQ(find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted).count, 0u);
}

TEST(ShadowEdges, A_jump_in_depth_within_one_instance_is_none) {
  FlatGround ground(6, 2, 1.0, overhead, 1.0);
  for (int y = 0; y < 2; ++y) {
    for (int x = 3; x < 6; ++x) ground.gbuffer.position.at(x, y).y = -5.0f;
  }
  EXPECT_EQ(find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted).count, 0u);
}

TEST(ShadowEdges, A_slope_below_45_degrees_between_neighbours_is_no_jump) {
  FlatGround ground(6, 1, 1.0, overhead, 1.0);
  for (int x = 3; x < 6; ++x) ground.gbuffer.position.at(x, 0).y = -0.9f;
  EXPECT_EQ(find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted).count, 1u);
}

TEST(ShadowEdges, Pixels_that_are_not_counted_have_none) {
  FlatGround ground(6, 3, 1.0, overhead, 1.0);
  ground.counted.exclusion.at(3, 1) = PixelExclusion::back_facing;
  EXPECT_EQ(find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted).count, 2u);
}

TEST(ShadowEdges, The_distance_to_a_straight_edge_counts_from_the_pixels_centre) {
  const FlatGround ground(8, 3, 1.0, overhead, 1.0);
  const NearestEdges nearest =
      nearest_edges(find_shadow_edges(blocked_from(ground, 3), ground.gbuffer, ground.counted));
  for (int x = 0; x < 8; ++x) {
    EXPECT_FLOAT_EQ(nearest.distance.at(x, 1), static_cast<float>(std::abs(x - 2.5))) << x;
    EXPECT_EQ(position_of(nearest.edge.at(x, 1), ground.gbuffer), dvec3(2.5, 0, 1)) << x;
  }
}

TEST(ShadowEdges, Without_an_edge_every_distance_is_infinite) {
  const FlatGround ground(5, 5, 1.0, overhead, 1.0);
  const NearestEdges nearest =
      nearest_edges(find_shadow_edges(Image<float>(5, 5, 1.0f), ground.gbuffer, ground.counted));
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_TRUE(std::isinf(nearest.distance[i]));
    EXPECT_EQ(nearest.edge[i], no_id);
  }
}

TEST(ShadowEdges, An_image_of_no_pixels_has_none) {
  const FlatGround ground(0, 0, 1.0, overhead, 1.0);
  EXPECT_TRUE(nearest_edges(find_shadow_edges({}, ground.gbuffer, ground.counted)).distance.empty());
}

// Every pixel against every edge, one by one.
TEST(ShadowEdges, The_transform_is_exact_on_random_images) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const int width = 1 + static_cast<int>(seed * 7 % 23);
    const int height = 1 + static_cast<int>(seed * 5 % 17);
    ShadowEdges edges{Image<std::uint8_t>(width, height, 0), 0};
    std::vector<dvec2> places;
    std::uint32_t state = seed;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        state = state * 1664525u + 1013904223u;
        if (state >> 28 != 0) continue;
        const bool right = (state >> 20 & 1) != 0;
        edges.bits.at(x, y) = right ? 1 : 2;
        ++edges.count;
        places.emplace_back(right ? x + 0.5 : x, right ? y : y + 0.5);
      }
    }
    const NearestEdges nearest = nearest_edges(edges);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double least = std::numeric_limits<double>::infinity();
        for (const dvec2& place : places) least = std::min(least, glm::distance(place, dvec2(x, y)));
        ASSERT_FLOAT_EQ(nearest.distance.at(x, y), static_cast<float>(least)) << seed << ": " << x << " " << y;
        if (places.empty()) continue;
        const EdgeId edge = nearest.edge.at(x, y);
        const std::size_t pixel = edge / 2;
        const auto columns = static_cast<std::size_t>(width);
        const dvec2 found(static_cast<double>(pixel % columns) + (edge % 2 == 0 ? 0.5 : 0.0),
                          static_cast<double>(pixel / columns) + (edge % 2 == 0 ? 0.0 : 0.5));
        ASSERT_NE(edges.bits[pixel] & (edge % 2 == 0 ? 1 : 2), 0);
        ASSERT_NEAR(glm::distance(found, dvec2(x, y)), least, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
