#include "scenes/emitter.h"

#include <gtest/gtest.h>

#include "gltf_files.h"

namespace umbrameter {
namespace {

using test::expect_unreadable;
using test::glb;
using test::TemporaryFolder;
using test::triangle_json;
using test::triangle_positions;

// A file with one light of that type; members of its own extras and of its node's, empty for none.
test::Bytes with_light(const std::string& type, const std::string& of_light, const std::string& of_node) {
  const auto extras = [](const std::string& members) {
    return members.empty() ? "" : R"(,"extras":{)" + members + "}";
  };
  const std::string spot = type == "spot" ? R"(,"spot":{})" : "";
  return glb(triangle_json(R"("nodes":[{"mesh":0},{"scale":[3,3,3],"extensions":{"KHR_lights_punctual":{"light":0}})" +
                               extras(of_node) + "}]",
                           R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":")" + type + "\"" + spot +
                               extras(of_light) + "}]}}"),
             triangle_positions());
}

Scene read(const std::string& type, const std::string& of_light, const std::string& of_node) {
  const TemporaryFolder folder;
  return test::load(folder, with_light(type, of_light, of_node));
}

Emitter emitter_of(const std::string& type, const std::string& of_node, const std::string& of_light = "") {
  return read(type, of_light, of_node).lights.at(0).emitter;
}

TEST(Emitter, Extras_of_a_light_node_give_it_an_extent_that_no_node_scales) {
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("point", R"("radius":0.25)")).radius, 0.25);
  EXPECT_EQ(std::get<DiskEmitter>(emitter_of("spot", R"("radius":2)")).radius, 2.0);
  EXPECT_EQ(std::get<DiskEmitter>(emitter_of("point", R"("radius":2,"shape":"disk")")).radius, 2.0);
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("spot", R"("radius":2,"shape":"sphere")")).radius, 2.0);
  const auto rectangle = std::get<RectangleEmitter>(emitter_of("point", R"("width":0.5,"height":1.5)"));
  EXPECT_EQ(rectangle.width, 0.5);
  EXPECT_EQ(rectangle.height, 1.5);
  EXPECT_EQ(std::get<DistantEmitter>(emitter_of("directional", R"("angularDiameter":0.0093)")).angular_diameter,
            0.0093);
}

TEST(Emitter, Extras_of_the_light_itself_count_where_its_node_says_nothing) {
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("point", "", R"("radius":0.25)")).radius, 0.25);
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("point", R"("note":"x")", R"("radius":0.25)")).radius, 0.25);
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("point", R"("radius":0.5)", R"("radius":0.25)")).radius, 0.5);
  EXPECT_EQ(emitter_of("point", R"("radius":0)", R"("radius":0.25)").index(), 0u);
}

TEST(Emitter, Extras_of_the_node_win_member_by_member) {
  EXPECT_EQ(std::get<DiskEmitter>(emitter_of("point", R"("shape":"disk")", R"("radius":0.25)")).radius, 0.25);
  EXPECT_EQ(std::get<DiskEmitter>(emitter_of("point", R"("radius":0.5)", R"("radius":1,"shape":"disk")")).radius, 0.5);
  EXPECT_EQ(std::get<RectangleEmitter>(emitter_of("spot", R"("height":3)", R"("width":2,"height":1)")).height, 3.0);
}

TEST(Emitter, An_extent_of_the_node_rules_out_another_of_the_light) {
  const char* const round = R"("radius":0.25,"shape":"sphere")";
  const char* const flat = R"("width":2,"height":1)";
  EXPECT_EQ(std::get<RectangleEmitter>(emitter_of("point", flat, round)).width, 2.0);
  EXPECT_EQ(std::get<SphereEmitter>(emitter_of("point", round, flat)).radius, 0.25);
  EXPECT_EQ(emitter_of("point", R"("radius":0)", flat).index(), 0u);
}

TEST(Emitter, A_shape_without_a_radius_is_an_error) {
  const std::vector<std::string> words = {"light 0", "node 1", "a shape and no radius"};
  expect_unreadable(with_light("point", "", R"("shape":"disk")"), words);
  expect_unreadable(with_light("spot", R"("shape":"sphere")", ""), words);
  expect_unreadable(with_light("point", R"("width":2,"height":1)", R"("shape":"disk")"), words);
}

TEST(Emitter, Lights_without_sizes_or_with_sizes_of_nothing_have_no_extent) {
  for (const char* type : {"point", "spot", "directional"}) EXPECT_EQ(emitter_of(type, "").index(), 0u);
  EXPECT_EQ(emitter_of("point", R"("radius":0)").index(), 0u);
  EXPECT_EQ(emitter_of("point", R"("width":0,"height":0.0)").index(), 0u);
  EXPECT_EQ(emitter_of("directional", R"("angularDiameter":0)").index(), 0u);
}

TEST(Emitter, A_size_that_a_kind_of_light_cannot_have_is_a_note) {
  const Scene sun = read("directional", "", R"("radius":3)");
  EXPECT_EQ(sun.lights.at(0).emitter.index(), 0u);
  ASSERT_EQ(sun.notes.size(), 1u);
  EXPECT_NE(sun.notes[0].find("angularDiameter"), std::string::npos);
  const Scene shaped = read("directional", "", R"("angularDiameter":0.1,"shape":"disk")");
  EXPECT_EQ(std::get<DistantEmitter>(shaped.lights.at(0).emitter).angular_diameter, 0.1);
  EXPECT_EQ(shaped.notes.size(), 1u);
  const Scene bulb = read("point", "", R"("angularDiameter":0.1)");
  EXPECT_EQ(bulb.lights.at(0).emitter.index(), 0u);
  EXPECT_EQ(bulb.notes.size(), 1u);
}

TEST(Emitter, Sizes_that_cannot_be_are_errors_that_name_light_and_node) {
  for (const char* bad : {R"("radius":-1)", R"("radius":1e13)", R"("radius":1e308)", R"("width":1)", R"("height":1)",
                          R"("width":1,"height":0)", R"("width":1,"height":-1)", R"("radius":1,"width":1,"height":1)",
                          R"("angularDiameter":-0.1)", R"("angularDiameter":3.15)", R"("shape":"cube","radius":1)",
                          R"("radius":18446744073709551615)"}) {
    SCOPED_TRACE(bad);
    expect_unreadable(with_light("point", "", bad), {"light 0", "node 1"});
    expect_unreadable(with_light("point", bad, ""), {"light 0", "node 1"});
  }
  for (const char* bad : {R"("radius":"1")", R"("radius":null)", R"("radius":[1])", R"("radius":{"value":1})",
                          R"("width":true,"height":1)", R"("angularDiameter":"1 degree")"}) {
    SCOPED_TRACE(bad);
    expect_unreadable(with_light("point", "", bad), {"nodes/1/extras/", "not a number"});
    expect_unreadable(with_light("point", bad, ""), {"lights/0/extras/", "not a number"});
  }
  expect_unreadable(with_light("spot", "", R"("shape":3)"), {"extras/shape", "not a text"});
}

TEST(Emitter, Extras_of_other_nodes_may_hold_anything) {
  const TemporaryFolder folder;
  const Scene scene = test::load(
      folder,
      glb(triangle_json(R"("nodes":[{"mesh":0,"extras":{"radius":"large","width":[]}}])"), triangle_positions()));
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(Emitter, Every_extent_survives_writing_and_reading) {
  Scene scene;
  scene.lights.resize(7);
  for (Light& light : scene.lights) light.shape = PointLight{};
  scene.lights[0].emitter = SphereEmitter{1.0 / 3};
  scene.lights[1].emitter = DiskEmitter{1e-9};
  scene.lights[2].emitter = RectangleEmitter{1.0 / 7, 1e12};
  scene.lights[3].shape = SpotLight{};
  scene.lights[3].emitter = DiskEmitter{0.1};
  scene.lights[4].shape = SpotLight{};
  scene.lights[4].emitter = SphereEmitter{0.1};
  scene.lights[5].shape = DirectionalLight{};
  scene.lights[5].emitter = DistantEmitter{0.53 * pi / 180.0};
  const TemporaryFolder folder;
  const Scene again = test::load(folder, to_glb(scene));
  ASSERT_EQ(again.lights.size(), scene.lights.size());
  EXPECT_EQ(std::get<SphereEmitter>(again.lights[0].emitter).radius, 1.0 / 3);
  EXPECT_EQ(std::get<DiskEmitter>(again.lights[1].emitter).radius, 1e-9);
  EXPECT_EQ(std::get<RectangleEmitter>(again.lights[2].emitter).width, 1.0 / 7);
  EXPECT_EQ(std::get<RectangleEmitter>(again.lights[2].emitter).height, 1e12);
  EXPECT_EQ(std::get<DiskEmitter>(again.lights[3].emitter).radius, 0.1);
  EXPECT_EQ(std::get<SphereEmitter>(again.lights[4].emitter).radius, 0.1);
  EXPECT_EQ(std::get<DistantEmitter>(again.lights[5].emitter).angular_diameter, 0.53 * pi / 180.0);
  EXPECT_EQ(again.lights[6].emitter.index(), 0u);
  EXPECT_TRUE(again.notes.empty());
}

Light of_kind(decltype(Light::shape) shape, Emitter emitter = {}) {
  Light light;
  light.shape = shape;
  light.emitter = emitter;
  return light;
}

TEST(LightParams, Every_field_is_described) {
  LightParams params;
  EXPECT_EQ(static_cast<int>(describe(params).size()), count_fields<LightParams>());
}

TEST(LightParams, A_given_size_replaces_the_one_of_the_scene_and_0_takes_it_away) {
  const Light bulb = of_kind(PointLight{}, SphereEmitter{1.0});
  const Light spot = of_kind(SpotLight{}, DiskEmitter{1.0});
  const Light sun = of_kind(DirectionalLight{}, DistantEmitter{0.1});
  LightParams none;
  EXPECT_EQ(std::get<SphereEmitter>(with_extent(bulb, none).emitter).radius, 1.0);
  LightParams radius;
  radius.radius = 0.25;
  EXPECT_EQ(std::get<SphereEmitter>(with_extent(bulb, radius).emitter).radius, 0.25);
  EXPECT_EQ(std::get<DiskEmitter>(with_extent(spot, radius).emitter).radius, 0.25);
  EXPECT_EQ(std::get<DistantEmitter>(with_extent(sun, radius).emitter).angular_diameter, 0.1);
  radius.shape = EmitterShape::disk;
  EXPECT_EQ(std::get<DiskEmitter>(with_extent(bulb, radius).emitter).radius, 0.25);
  radius.radius = 0.0;
  EXPECT_FALSE(is_area(with_extent(bulb, radius)));
  LightParams sides;
  sides.width = 2.0;
  sides.height = 3.0;
  EXPECT_EQ(std::get<RectangleEmitter>(with_extent(spot, sides).emitter).height, 3.0);
  LightParams angle;
  angle.angle = 90.0;
  EXPECT_DOUBLE_EQ(std::get<DistantEmitter>(with_extent(sun, angle).emitter).angular_diameter, pi / 2.0);
  EXPECT_EQ(std::get<SphereEmitter>(with_extent(bulb, angle).emitter).radius, 1.0);
  angle.angle = 0.0;
  EXPECT_FALSE(is_area(with_extent(sun, angle)));
}

TEST(LightParams, A_shape_alone_is_that_of_the_radius_in_the_scene) {
  const LightParams disk{.shape = EmitterShape::disk};
  const LightParams sphere{.shape = EmitterShape::sphere};
  const Light bulb = of_kind(PointLight{}, SphereEmitter{0.25});
  const Light spot = of_kind(SpotLight{}, DiskEmitter{0.5});
  EXPECT_EQ(std::get<DiskEmitter>(with_extent(bulb, disk).emitter).radius, 0.25);
  EXPECT_EQ(std::get<SphereEmitter>(with_extent(spot, sphere).emitter).radius, 0.5);
  // Nothing else has a radius.
  EXPECT_EQ(std::get<RectangleEmitter>(with_extent(of_kind(SpotLight{}, RectangleEmitter{1, 2}), disk).emitter).height,
            2.0);
  EXPECT_EQ(std::get<DistantEmitter>(with_extent(of_kind(DirectionalLight{}, DistantEmitter{0.1}), disk).emitter)
                .angular_diameter,
            0.1);
  EXPECT_FALSE(is_area(with_extent(of_kind(PointLight{}), disk)));
}

TEST(LightParams, Sizes_without_sense_are_errors_that_name_them) {
  const std::vector<Light> suns = {of_kind(DirectionalLight{})};
  const std::vector<Light> bulbs = {of_kind(PointLight{})};
  const auto expect_refused = [](const LightParams& params, const std::vector<Light>& lights, const char* word) {
    try {
      require_sense(params, lights);
      ADD_FAILURE() << "taken; wanted " << word;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  require_sense({}, suns);
  require_sense({.radius = 1.0}, bulbs);
  require_sense({.angle = 179.0}, suns);
  require_sense({.shape = EmitterShape::disk},
                std::vector{of_kind(PointLight{}), of_kind(PointLight{}, SphereEmitter{1})});
  require_sense({.radius = 1.0, .shape = EmitterShape::disk}, bulbs);
  expect_refused({.shape = EmitterShape::disk}, bulbs, "light.shape");
  expect_refused({.shape = EmitterShape::disk}, suns, "light.shape");
  expect_refused({.shape = EmitterShape::disk}, {of_kind(PointLight{}, RectangleEmitter{1, 1})}, "light.shape");
  expect_refused({.width = 1.0, .height = 1.0, .shape = EmitterShape::disk}, {of_kind(PointLight{}, SphereEmitter{1})},
                 "light.shape");
  expect_refused({.radius = 2e12}, bulbs, "above 1e+12 m");
  expect_refused({.angle = 180.0}, suns, "above 179 degrees");
  expect_refused({.radius = 1.0}, suns, "light.radius");
  expect_refused({.width = 1.0, .height = 1.0}, suns, "light.width");
  expect_refused({.angle = 1.0}, bulbs, "light.angle");
  expect_refused({.radius = 1.0, .width = 1.0, .height = 1.0}, bulbs, "radius and the sides");
  expect_refused({.width = 1.0}, bulbs, "one side");
  expect_refused({.width = 1.0, .height = 0.0}, bulbs, "one side");
}

}  // namespace
}  // namespace umbrameter
