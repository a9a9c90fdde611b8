#include "scenes/units.h"

#include <gtest/gtest.h>

#include "scenes/memory.h"

namespace umbrameter {
namespace {

Bounds box(double width, double height, double depth) {
  Bounds bounds;
  bounds.include(dvec3(0));
  bounds.include({width, height, depth});
  return bounds;
}

std::string_view likeliest(const UnitGuess& guess) {
  return guess.candidates.empty() ? "none" : guess.candidates.front().unit;
}

TEST(Units, A_temple_of_30000_m_is_implausible_and_likeliest_in_millimetres) {
  const UnitGuess guess = guess_units(box(30000, 14000, 70000));
  EXPECT_EQ(guess.verdict, SizeVerdict::implausible);
  EXPECT_NE(guess.reason.find("20 km"), std::string::npos) << guess.reason;
  ASSERT_EQ(likeliest(guess), "mm");
  EXPECT_DOUBLE_EQ(guess.candidates.front().metres, 0.001);
  EXPECT_DOUBLE_EQ(guess.candidates.front().longest_side, 70.0);  // 70000 · 0.001 m
}

TEST(Units, Rooms_buildings_towns_and_land_are_credible) {
  for (const Bounds& bounds : {box(0.3, 0.2, 0.1), box(4, 2.5, 5), box(30, 15, 70), box(500, 830, 500),
                               box(2000, 100, 3000), box(15000, 3000, 15000), box(10000, 0, 10000)}) {
    const UnitGuess guess = guess_units(bounds);
    EXPECT_EQ(guess.verdict, SizeVerdict::credible) << bounds.extent().x;
    EXPECT_EQ(guess.reason, "");
    EXPECT_TRUE(guess.candidates.empty());
  }
}

TEST(Units, A_hall_in_centimetres_is_given_away_by_its_height) {
  // 37 m × 15.5 m × 23 m: higher than the tallest building, 830 m, if these were metres.
  const UnitGuess guess = guess_units(box(3700, 1550, 2300));
  EXPECT_EQ(guess.verdict, SizeVerdict::doubtful);
  EXPECT_EQ(likeliest(guess), "cm");
}

TEST(Units, A_town_in_kilometres_is_too_small_to_be_one_in_metres) {
  const UnitGuess guess = guess_units(box(0.02, 0.01, 0.03));
  EXPECT_EQ(guess.verdict, SizeVerdict::implausible);
  EXPECT_NE(guess.reason.find("5 cm"), std::string::npos) << guess.reason;
  ASSERT_EQ(guess.candidates.size(), 1u);
  EXPECT_EQ(likeliest(guess), "km");
  EXPECT_DOUBLE_EQ(guess.candidates.front().longest_side, 30.0);
}

TEST(Units, A_size_that_no_unit_explains_has_no_candidates) {
  for (const double side : {1e-9, 1e12}) {
    const UnitGuess guess = guess_units(box(side, side, side));
    EXPECT_EQ(guess.verdict, SizeVerdict::implausible);
    EXPECT_TRUE(guess.candidates.empty());
  }
}

TEST(Units, Without_triangles_there_is_nothing_to_doubt) {
  EXPECT_EQ(guess_units(Bounds{}).verdict, SizeVerdict::credible);
}

TEST(Memory, Bytes_are_elements_by_their_sizes) {
  Scene scene;
  Mesh mesh;
  mesh.positions.resize(4);
  mesh.texcoords.resize(4);
  mesh.triangles.resize(2);
  scene.meshes = {mesh};
  scene.instances.resize(3);
  scene.textures.push_back({"a", Image<glm::u8vec4>(5, 7)});
  const SceneBytes bytes = bytes_in_memory(scene);
  EXPECT_EQ(bytes.vertices, 4u * 12 + 4 * 8);         // three and two floats
  EXPECT_EQ(bytes.indices, 2u * 12);                  // three 32-bit indices
  EXPECT_EQ(bytes.instances, 3u * (2 * 4 + 16 * 8));  // two 32-bit indices and a double matrix
  EXPECT_EQ(bytes.textures, 5u * 7 * 4);
  EXPECT_EQ(bytes.total(), bytes.vertices + bytes.indices + bytes.instances + bytes.textures);
}

}  // namespace
}  // namespace umbrameter
