#include "compare/by_object.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// Two materials; "floor" is one instance, the nameless second object two of both materials. Four pixels of eight taps.
struct ThreeInstances {
  Scene scene = shapes::empty_scene();
  GBuffer gbuffer{5, 1};
  WrongTaps wrong{Image<uvec4>(5, 1, uvec4(0)), 8};
  CountedPixels counted{Image<PixelExclusion>(5, 1, PixelExclusion::none), {}, 0.5};
  ThreeInstances() {
    scene.materials.push_back(scene.materials.front());
    scene.materials.back().name = "paint";
    for (int i = 0; i < 3; ++i) shapes::add_mesh(scene, shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
    scene.objects = {{"floor"}, {""}, {"never seen"}};
    scene.instances[1].object = scene.instances[2].object = 1;
    scene.meshes[2].material = 1;
    gbuffer.instance.pixels = {0, 1, 2, 2, 0};
    wrong.weights.pixels = {uvec4(1, 0, 0, 0), uvec4(0, 2, 0, 0), uvec4(0, 0, 4, 0), uvec4(0, 0, 0, 8),
                            uvec4(8, 0, 0, 0)};
    counted.exclusion[4] = PixelExclusion::back_facing;
  }
};

TEST(ByObject, Error_belongs_to_the_receiver_s_object_and_the_worst_comes_first) {
  const ThreeInstances three;
  const std::vector<PartError> parts =
      errors_by_part(three.scene, PartKind::object, three.gbuffer, three.wrong, three.counted);
  ASSERT_EQ(parts.size(), 2u) << "an object without counted pixels has no row";
  EXPECT_EQ(parts[0].name, "object 1");
  EXPECT_EQ(parts[0].pixels, 3u);
  EXPECT_EQ(parts[0].wrong, (std::array<std::uint64_t, 4>{0, 2, 4, 8}));
  EXPECT_EQ(parts[1].name, "floor");
  EXPECT_EQ(parts[1].pixels, 1u) << "the turned-away pixel does not count";
  EXPECT_EQ(parts[1].wrong, (std::array<std::uint64_t, 4>{1, 0, 0, 0}));
}

TEST(ByObject, Error_belongs_to_the_receiver_s_material) {
  const ThreeInstances three;
  const std::vector<PartError> parts =
      errors_by_part(three.scene, PartKind::material, three.gbuffer, three.wrong, three.counted);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].name, "paint");
  EXPECT_EQ(parts[0].wrong, (std::array<std::uint64_t, 4>{0, 0, 4, 8}));
  EXPECT_EQ(parts[1].name, "grey");
  EXPECT_EQ(parts[1].wrong, (std::array<std::uint64_t, 4>{1, 2, 0, 0}));
}

TEST(ByObject, Shares_are_of_the_part_s_own_pixels_and_its_error_a_share_of_all) {
  const ThreeInstances three;
  const std::vector<PartError> parts =
      errors_by_part(three.scene, PartKind::object, three.gbuffer, three.wrong, three.counted);
  const Table table = part_table(PartKind::object, parts, 8);
  ASSERT_EQ(table.rows.size(), 2u);
  const std::vector<Value>& row = table.rows[0];
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "mae")]), 14.0 / 24.0);
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "acne")]), 0.0);
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "false_occlusion")]), 2.0 / 24.0);
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "peter_panning")]), 4.0 / 24.0);
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "leak")]), 8.0 / 24.0);
  EXPECT_DOUBLE_EQ(to_number(row[column_index(table, "share_of_error")]), 14.0 / 15.0);
  EXPECT_EQ(part_table(PartKind::object, parts, 8, 1).rows.size(), 1u);
}

}  // namespace
}  // namespace umbrameter
