#include "compare/caster_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flat_ground.h"

namespace umbrameter {
namespace {

constexpr double pixel = 0.005;  // metres
constexpr double texel = 0.02;   // metres
constexpr double elevation = 40.0 * pi / 180.0;
constexpr int foot = 20;            // the first column of ground behind the wall
constexpr int shadow_end = 180;     // the first lit column behind its shadow
constexpr double thickness = 0.05;  // metres, of the wall

// Level ground seen from above behind a wall that stands on it, with the sun before the wall.
struct BehindWall {
  int width;
  FlatGround ground;
  Scene scene;
  View view{width, 8, {}};
  Image<float> truth{width, 8, 1.0f};
  Image<float> raster{width, 8, 1.0f};
  WrongTaps wrong{Image<uvec4>(width, 8, uvec4(0)), 1};
  Image<std::uint32_t> caster{width, 8, no_id};
  Image<float> distance{width, 8, 0.0f};

  /// The image is that many pixels wide, and the shadow ends in that column.
  explicit BehindWall(int columns = 240, int end = shadow_end, double texel_size = texel)
      : width(columns), ground(columns, 8, pixel, dvec3(-std::cos(elevation), std::sin(elevation), 0), texel_size) {
    scene.objects = {{"ground"}, {"wall"}};
    scene.instances = {{0, 0}, {1, 1}};
    view.camera.world_from_camera = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0),
                                          dvec4(0.5 * (width - 1) * pixel, 10, 3.5 * pixel, 1));
    view.camera.projection = OrthographicProjection{0.5 * width * pixel, 4 * pixel, 0.0, 100.0};
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < foot; ++x) {
        ground.gbuffer.instance.at(x, y) = 1;
        ground.gbuffer.position.at(x, y).y = 0.67f;
      }
      for (int x = foot; x < end; ++x) {
        truth.at(x, y) = 0.0f;
        caster.at(x, y) = 1;
        distance.at(x, y) = static_cast<float>(behind(x) / std::cos(elevation));
      }
    }
    draw(end, 0.0);
  }
  // Metres from the wall to a column's middle.
  static double behind(int x) { return (x - foot + 0.5) * pixel; }
  // The map's depth is that of the wall's front: the bias erases it where (behind + thickness) / cos e is no more.
  void draw(int end, double bias) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool is_blocked = x >= foot && x < end && (behind(x) + thickness) / std::cos(elevation) > bias;
        raster.at(x, y) = is_blocked ? 0.0f : 1.0f;
      }
    }
  }
  std::vector<CasterShape> measure() const { return analyze().casters; }
  CasterShapes analyze() const {
    return analyze_casters({{ground.gbuffer, truth, ground.counted, ground.light, ground.layout},
                            raster,
                            wrong,
                            caster,
                            distance,
                            scene,
                            view});
  }
};

// A lit strip of width max(0, b cos e − w).
TEST(CasterShape, The_contact_gap_behind_a_wall_is_what_its_thickness_leaves_of_the_bias) {
  BehindWall wall;
  for (const double bias : {0.0, 0.05, 0.0652, 0.1, 0.2, 0.35, 0.6}) {
    wall.draw(shadow_end, bias);
    const std::vector<CasterShape> found = wall.measure();
    ASSERT_EQ(found.size(), 1u);
    const double strip = std::max(0.0, bias * std::cos(elevation) - thickness);
    EXPECT_EQ(found[0].object, 1u);
    EXPECT_GE(found[0].contacts, 8u) << bias;
    EXPECT_NEAR(found[0].gap_median.metres, strip, 0.5001 * pixel) << bias;
    EXPECT_NEAR(found[0].gap_largest.metres, strip, 0.5001 * pixel) << bias;
    EXPECT_NEAR(found[0].gap_median.pixels, found[0].gap_median.metres / pixel, 1e-6);
    EXPECT_NEAR(found[0].gap_median.texels, found[0].gap_median.metres * std::sin(elevation) / texel, 1e-6);
    EXPECT_EQ(found[0].lost, 0u);
  }
}

TEST(CasterShape, A_shadow_that_is_gone_leaves_a_gap_as_long_as_itself) {
  BehindWall wall;
  wall.draw(foot, 0.0);
  const std::vector<CasterShape> found = wall.measure();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].lost, found[0].contacts);
  EXPECT_NEAR(found[0].gap_median.pixels, shadow_end - foot, 0.5001);
  EXPECT_EQ(found[0].edges, 0u);
  EXPECT_EQ(found[0].unmatched, 8u);
}

TEST(CasterShape, A_gap_is_followed_across_the_widest_images) {
  BehindWall wall(16384, 16000);
  wall.draw(foot, 0.0);
  const std::vector<CasterShape> found = wall.measure();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GE(found[0].contacts, 8u);
  EXPECT_NEAR(found[0].gap_median.pixels, 16000 - foot, 0.01);  // positions are floats, 80 m off the origin
}

TEST(CasterShape, The_inset_is_positive_where_the_raster_shadow_is_smaller) {
  BehindWall wall;
  for (const int inside : {-7, 0, 1, 12}) {
    wall.draw(shadow_end - inside, 0.0);
    const std::vector<CasterShape> found = wall.measure();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].edges, 8u);
    EXPECT_NEAR(found[0].inset_median.pixels, inside, 1e-6);
    EXPECT_NEAR(found[0].inset_median.metres, inside * pixel, 1e-6);
    EXPECT_NEAR(found[0].inset_median.texels, inside * pixel * std::sin(elevation) / texel, 1e-5);
  }
}

TEST(CasterShape, Acne_beside_a_shadow_does_not_move_its_outline) {
  BehindWall wall;
  wall.draw(shadow_end - 5, 0.0);
  for (int y = 0; y < 8; ++y) {
    wall.raster.at(shadow_end + 1, y) = 0.0f;
    wall.wrong.weights.at(shadow_end + 1, y).x = 1;
  }
  EXPECT_NEAR(wall.measure().at(0).inset_median.pixels, 5.0, 1e-6);
}

TEST(CasterShape, A_caster_that_floats_has_no_contact) {
  BehindWall wall;
  for (float& distance : wall.distance.pixels) distance += 0.1f;
  EXPECT_EQ(wall.measure().at(0).contacts, 0u);
  const ContactSearch search = wall.analyze().search;
  EXPECT_EQ(search.measured, 0u);
  EXPECT_EQ(search.distant, search.shadowed);
}

// 1.5 px = 7.5 mm. The first column of shadow is half a pixel behind the wall, 2.5 mm / cos 40° = 3.3 mm along the ray.
TEST(CasterShape, Contacts_are_found_however_fine_the_texels_are) {
  const double strip = 0.2 * std::cos(elevation) - thickness;
  for (const double texel_size : {0.004, 0.002, 0.0005, 1e-6}) {
    BehindWall wall(240, shadow_end, texel_size);
    wall.draw(shadow_end, 0.2);
    const CasterShapes found = wall.analyze();
    ASSERT_EQ(found.casters.size(), 1u);
    EXPECT_EQ(found.casters[0].contacts, 8u) << texel_size;
    EXPECT_EQ(found.search.measured, 8u) << texel_size;
    EXPECT_NEAR(found.casters[0].gap_median.metres, strip, 0.5001 * pixel) << texel_size;
    EXPECT_NEAR(found.casters[0].gap_median.texels,
                found.casters[0].gap_median.metres * std::sin(elevation) / texel_size, 1e-6 / texel_size);
  }
}

TEST(CasterShape, The_search_says_what_became_of_every_pixel_in_shadow) {
  const std::uint64_t shadowed = 8 * (shadow_end - foot);
  BehindWall wall;
  const auto expect_all = [&](std::uint64_t ContactSearch::*reason) {
    const ContactSearch search = wall.analyze().search;
    EXPECT_EQ(search.shadowed, shadowed);
    EXPECT_EQ(search.own_object + search.head_on + search.distant + search.hidden + search.measured, shadowed);
    EXPECT_EQ(search.*reason, shadowed);
  };
  const ContactSearch found = wall.analyze().search;
  EXPECT_GE(found.measured, 8u);
  EXPECT_EQ(found.measured + found.distant, shadowed);
  for (float& distance : wall.distance.pixels) distance = 1.0f;
  expect_all(&ContactSearch::distant);
  wall.scene.instances[1].object = 0;
  expect_all(&ContactSearch::own_object);
  BehindWall overhead;
  overhead.ground = FlatGround(240, 8, pixel, dvec3(0, 1, 0), texel);
  EXPECT_EQ(overhead.analyze().search.head_on, shadowed);
}

TEST(CasterShape, Hidden_ways_do_not_count) {
  BehindWall wall;
  wall.draw(shadow_end, 0.3);
  for (int y = 0; y < 8; ++y) wall.ground.gbuffer.instance.at(foot + 4, y) = 1;
  EXPECT_EQ(wall.measure().at(0).contacts, 0u);
  EXPECT_GE(wall.analyze().search.hidden, 8u);
}

TEST(CasterShape, Without_a_shadow_there_is_no_caster) {
  BehindWall wall;
  wall.truth = Image<float>(240, 8, 1.0f);
  wall.caster = Image<std::uint32_t>(240, 8, no_id);
  EXPECT_TRUE(wall.measure().empty());
}

TEST(CasterShape, Everything_blocked_has_no_outline) {
  BehindWall wall;
  wall.truth = Image<float>(240, 8, 0.0f);
  wall.raster = wall.truth;
  for (const CasterShape& caster : wall.measure()) {
    EXPECT_EQ(caster.edges, 0u);
    EXPECT_EQ(caster.gap_largest.metres, 0.0);
  }
}

}  // namespace
}  // namespace umbrameter
