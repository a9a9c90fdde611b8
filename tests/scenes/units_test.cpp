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

TEST(Units, Furniture_rooms_buildings_towns_and_land_are_credible) {
  for (const Bounds& bounds : {box(0.6, 0.5, 0.5), box(4, 2.5, 5), box(30, 15, 70), box(20, 37, 23), box(167, 116, 177),
                               box(2000, 100, 3000), box(4500, 400, 4500), box(4000, 0, 4000)}) {
    const UnitGuess guess = guess_units(bounds);
    EXPECT_EQ(guess.verdict, SizeVerdict::credible) << bounds.extent().x;
    EXPECT_EQ(guess.reason, "");
    EXPECT_TRUE(guess.candidates.empty());
    EXPECT_EQ(size_remark(guess), "");
  }
}

struct Doubtful {
  const char* what;
  Bounds bounds;
  const char* flag;    ///< what the remark says to set
  const char* length;  ///< and the length that it names
};

// Models of public collections that scored like any other, and things that exporters write in a wrong unit.
TEST(Units, Each_size_that_no_scene_has_gets_a_remark_with_its_length_and_the_flag) {
  const Doubtful cases[] = {
      {"a fox in centimetres", box(25, 79, 155), "--scene.unit cm", "155 m"},
      {"a person in centimetres", box(60, 175, 40), "--scene.unit cm", "175 m"},
      {"a toy car in metres", box(0.04, 0.03, 0.07), "--scene.unit", "0.07 m"},
      {"a room in millimetres", box(10000, 2500, 8000), "--scene.unit mm", "side is 10000 m"},
      {"a room in centimetres", box(1000, 270, 800), "--scene.unit cm", "side is 1000 m"},
      {"a room of 8 micrometres", box(8e-6, 2.5e-6, 6e-6), "--scene.unit to its length in metres, such as 1000000",
       "8e-06 m"},
      {"a hall of 37 m in centimetres", box(3700, 1550, 2300), "--scene.unit cm", "side is 3700 m"},
      {"a town in kilometres", box(0.02, 0.01, 0.03), "--scene.unit to its length in metres, such as 1000", "0.03 m"}};
  for (const Doubtful& each : cases) {
    const UnitGuess guess = guess_units(each.bounds);
    EXPECT_NE(guess.verdict, SizeVerdict::credible) << each.what;
    const std::string remark = size_remark(guess);
    EXPECT_NE(remark.find(each.flag), std::string::npos) << each.what << ": " << remark;
    EXPECT_NE(remark.find(each.length), std::string::npos) << each.what << ": " << remark;
    EXPECT_NE(remark.find(guess.reason), std::string::npos) << each.what << ": " << remark;
    EXPECT_EQ(remark.find('\n'), std::string::npos) << remark;
  }
}

// A chess-board of 337 mm and a saw of 375 mm whose numbers are millimetres.
TEST(Units, A_single_thing_of_hundreds_of_metres_is_doubtful_and_may_be_in_either_unit) {
  for (const Bounds& bounds : {box(337, 98, 337), box(375, 20, 130)}) {
    const UnitGuess guess = guess_units(bounds, 1.0, false);
    EXPECT_EQ(guess.verdict, SizeVerdict::doubtful);
    EXPECT_NE(guess.reason.find("longer than 100 m"), std::string::npos) << guess.reason;
    const std::string remark = size_remark(guess);
    const double side = bounds.extent().x;
    // A hundredth and a thousandth of its metres.
    EXPECT_NE(remark.find(side == 337 ? "3.37 m" : "3.75 m"), std::string::npos) << remark;
    EXPECT_NE(remark.find(side == 337 ? "mm, which makes it 0.337 m" : "mm, which makes it 0.375 m"), std::string::npos)
        << remark;
  }
  EXPECT_EQ(guess_units(box(84, 18, 88), 1.0, false).verdict, SizeVerdict::credible);
}

TEST(Units, A_camera_or_a_lamp_in_a_scene_makes_it_a_surrounding) {
  Scene scene;
  scene.materials.resize(1);
  scene.objects.resize(1);
  scene.meshes.push_back({"", {{0, 0, 0}, {337, 98, 0}, {0, 0, 337}}, {}, {}, {{0, 1, 2}}, 0});
  scene.instances.push_back({0, 0, dmat4(1.0)});
  EXPECT_FALSE(is_surrounding(scene));
  const auto at = [](double x) { return dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {x, 2, 100, 1}); };
  scene.cameras.push_back({"outside", at(-5), PerspectiveProjection{}});
  Light sun;
  sun.world_from_light = at(100);
  scene.lights = {sun};
  EXPECT_FALSE(is_surrounding(scene)) << "a directional light has no place";
  scene.lights[0].shape = PointLight{};
  EXPECT_TRUE(is_surrounding(scene));
  scene.lights.clear();
  scene.cameras.push_back({"inside", at(100), PerspectiveProjection{}});
  EXPECT_TRUE(is_surrounding(scene));
}

TEST(Units, A_hall_in_centimetres_is_given_away_by_its_height) {
  // 37 m × 15.5 m × 23 m: higher than any building if these were metres.
  const UnitGuess guess = guess_units(box(3700, 1550, 2300));
  EXPECT_EQ(guess.verdict, SizeVerdict::doubtful);
  EXPECT_EQ(likeliest(guess), "cm");
}

TEST(Units, Of_a_unit_that_was_set_the_remark_says_what_the_file_is_without_it) {
  const std::string remark = size_remark(guess_units(box(0.2, 0.15, 0.374), 0.01));
  EXPECT_TRUE(remark.ends_with("; without --scene.unit, in metres, it is 37.4 m")) << remark;
}

TEST(Units, A_town_in_kilometres_is_too_small_to_be_one_in_metres) {
  const UnitGuess guess = guess_units(box(0.02, 0.01, 0.03));
  EXPECT_EQ(guess.verdict, SizeVerdict::doubtful);
  ASSERT_EQ(guess.candidates.size(), 1u);
  EXPECT_EQ(likeliest(guess), "km");
  EXPECT_DOUBLE_EQ(guess.candidates.front().longest_side, 30.0);
}

TEST(Units, The_verdict_is_about_the_scaled_scene_and_the_candidates_about_the_numbers_of_the_file) {
  // A fox of 155 units, read in feet: 47.2 m long and 24 m high, which a building may be.
  EXPECT_EQ(guess_units(box(25 * 0.3048, 79 * 0.3048, 155 * 0.3048), 0.3048).verdict, SizeVerdict::credible);
  // Read in kilometres it is 155 km long. In metres it is doubtful, in centimetres 1.55 m.
  const UnitGuess guess = guess_units(box(25e3, 79e3, 155e3), 1000.0);
  ASSERT_EQ(likeliest(guess), "cm");
  EXPECT_NEAR(guess.candidates.front().longest_side, 1.55, 1e-9);
  for (const UnitCandidate& candidate : guess.candidates) EXPECT_NE(candidate.unit, "km");
}

TEST(Units, A_size_that_no_unit_explains_has_no_candidates) {
  for (const double side : {1e-9, 1e12}) {
    const UnitGuess guess = guess_units(box(side, side, side));
    EXPECT_EQ(guess.verdict, SizeVerdict::implausible);
    EXPECT_TRUE(guess.candidates.empty());
    EXPECT_NE(size_remark(guess).find("--scene.unit to its length"), std::string::npos) << size_remark(guess);
  }
}

TEST(Units, A_point_is_remarked_on_without_a_number_that_is_none) {
  const std::string remark = size_remark(guess_units(box(0, 0, 0)));
  EXPECT_NE(remark.find("0 m"), std::string::npos) << remark;
  EXPECT_EQ(remark.find("inf"), std::string::npos) << remark;
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
