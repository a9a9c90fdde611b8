#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "core/error.h"
#include "techniques/engine_bias/conversion.h"
#include "techniques/shadow/cascades.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

// A courtyard: texels of 2 cm, 50 m of depth; and 2 km of ground: texels of 1.25 m, 3 km of depth.
MapPlace courtyard() { return {"map", LightKind::directional, 0.02, 50.0, 2048}; }
MapPlace plain() { return {"map", LightKind::directional, 1.25, 3000.0, 2048}; }
MapPlace lamp(LightKind kind) { return {"nearest receiver", kind, 0.01, 40.0, 1024, 4.0}; }

BiasTerms terms(const std::string& text, const MapPlace& place) {
  const BiasSpec spec = at_light(parse_bias_source(text), place);
  return terms_of(spec, places_for(spec, {place}).front());
}

BiasConversion converted(const std::string& from, const std::string& to, const MapPlace& place) {
  const BiasSpec target = at_light(parse_bias_targets(to).front(), place);
  return convert(terms(from, place), target, places_for(target, {place}).front());
}

std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(EngineBias, Constant_biases_are_those_of_the_engines_sources) {
  struct Case {
    const char* source;
    double courtyard;  // metres
    double plain;
  };
  // Expected: the formula of the engine's own source with t, R and resolution of the two maps.
  const Case cases[] = {
      {"metres:0.05", 0.05, 0.05},
      {"texels:1.5", 0.03, 1.875},
      {"map-depth:0.005", 0.25, 15.0},
      // R = t · 2048 + 20: 60.96 and 2580 m; b/100 · R · blur 1 · quality low 2.
      {"godot:bias=0.1", 0.001 * 60.96 * 2, 0.001 * 2580 * 2},
      {"godot:bias=0.1,quality=hard,blur=0.5,pancake=0", 0.001 * 50 * 0.5, 0.001 * 3000 * 0.5},
      {"godot:bias=0.1,range=200", 0.001 * 200 * 2, 0.001 * 200 * 2},
      // z += bias with 0 to 1 over far − near, whatever the map.
      {"three:-0.0005", 0.0005 * 499.5, 0.0005 * 499.5},
      {"three:bias=-0.0005,near=1,far=81", 0.04, 0.04},
      {"babylon", 5e-5 * 9999, 5e-5 * 9999},
      {"babylon:bias=0.001,filter=pcf,minZ=0,maxZ=100", 0.05, 0.05},
      {"unity-urp:bias=1", 0.02, 1.25},
      {"unity-urp:bias=1,soft=medium", 0.05, 3.125},
      {"unreal:ShadowBias=0.5", 10 * 0.01 * 0.5, 10 * 0.625 * 0.5},  // CSMDepthBias · radius / resolution · user's
      {"bevy", 0.02, 0.02},
      {"filament:constantBias=0.004", 0.004, 0.004},
      {"stride:DepthBias=0.01,NormalOffsetScale=0", 0.5, 30.0},
      {"playcanvas", 0.0, 0.0},
      {"unity-hdrp", 0.0, 0.0},
  };
  for (const Case& each : cases) {
    EXPECT_NEAR(terms(each.source, courtyard()).constant, each.courtyard, 1e-12) << each.source;
    EXPECT_NEAR(terms(each.source, plain()).constant, each.plain, 1e-12) << each.source;
  }
}

TEST(EngineBias, Normal_offsets_and_slopes_are_those_of_the_engines_sources) {
  struct Case {
    const char* source;
    double metres;  // courtyard
    OffsetKind kind;
  };
  using enum OffsetProfile;
  using enum OffsetSide;
  using enum OffsetDirection;
  const Case cases[] = {
      {"godot:normal_bias=2", 0.04, {constant, receiver, across}},
      {"three:bias=0,normalBias=0.03", 0.03, {constant, receiver, normal}},
      {"bevy:shadow_normal_bias=1.8", 1.8 * std::sqrt(2.0) * 0.02, {constant, receiver, normal}},
      {"unity-hdrp:normalBias=0.75", 0.75 * std::sqrt(2.0) * 0.02, {constant, receiver, normal}},
      {"filament:normalBias=1", 0.5 * 0.02, {sine, receiver, normal}},
      {"umbrameter:0,normal-offset=1", 0.02, {sine, receiver, normal}},
      {"babylon:normalBias=0.03", 0.03, {sine, caster, normal}},
      {"playcanvas:normalOffsetBias=0.03", 0.03, {constant, receiver, normal}},
      {"unity-urp:normalBias=1,soft=high", 0.07, {one_minus_cosine, caster, normal}},
      {"stride:normalOffsetScale=10,atlas=2000", 0.01, {one_minus_cosine, receiver, normal}},
  };
  for (const Case& each : cases) {
    EXPECT_NEAR(terms(each.source, courtyard()).normal, each.metres, 1e-12) << each.source;
    EXPECT_EQ(terms(each.source, courtyard()).offset, each.kind) << each.source;
  }
  EXPECT_NEAR(terms("playcanvas:0.05", courtyard()).slope, 0.5, 1e-12);           // −0.01 · −1000 · v
  EXPECT_NEAR(terms("unity-hdrp:slopeBias=0.5", courtyard()).slope, 2.5, 1e-12);  // baseBias 5 · 0.5
  EXPECT_NEAR(terms("filament", courtyard()).slope, 2.0, 1e-12);                  // ShadowOptions' default
}

TEST(EngineBias, Spot_and_point_lights_have_the_depth_of_a_perspective) {
  // dz/dd of the depth 0 to 1 is n f / ((f − n) d²): 1e-5 at d = 4 m, n = 0.5 m, f = 500 m.
  const double expected = 1e-5 * 16 * 499.5 / 250;
  EXPECT_NEAR(terms("three:-0.00001", lamp(LightKind::spot)).constant, expected, 1e-12);
  EXPECT_NEAR(terms("babylon:bias=0.001,minZ=1,maxZ=101", lamp(LightKind::spot)).constant, 0.1, 1e-12);
  EXPECT_NEAR(terms("babylon:bias=0.001,minZ=1,maxZ=101", lamp(LightKind::point)).constant, 0.102, 1e-12);
  EXPECT_NEAR(terms("godot:bias=0.1,normal_bias=0", lamp(LightKind::point)).constant, 0.1, 1e-12);
  EXPECT_NEAR(terms("bevy", lamp(LightKind::spot)).normal, 1.8 * std::sqrt(2.0) * 0.01, 1e-12);
  EXPECT_NEAR(terms("playcanvas:0,normalOffsetBias=0.1", lamp(LightKind::spot)).normal, 0.1, 1e-12);
  // Half of its map at the light's range of 10 m, in texels: tan · 10 m / resolution, with t = 2 tan · 4 m /
  // resolution.
  EXPECT_NEAR(terms("unity-urp:shadowNormalBias=0", lamp(LightKind::spot)).constant, 0.01 * 10 / 8, 1e-12);
  MapPlace far = lamp(LightKind::spot);
  far.light_range = 16.0;  // the file's, which a given one replaces
  EXPECT_NEAR(terms("unity-urp:shadowNormalBias=0", far).constant, 0.01 * 16 / 8, 1e-12);
  EXPECT_NEAR(terms("unity-urp:shadowNormalBias=0,lightRange=6", far).constant, 0.01 * 6 / 8, 1e-12);
  EXPECT_NEAR(terms("unity-urp:bias=2,soft=low,lightRange=6", lamp(LightKind::spot)).normal, 1.5 * 0.01 * 6 / 8, 1e-12);
  EXPECT_NEAR(terms("unity-hdrp:slopeBias=0.5", lamp(LightKind::point)).slope, 2.5, 1e-12);
  EXPECT_NEAR(terms("playcanvas:0.05", lamp(LightKind::spot)).slope, 0.5, 1e-12);
  expect_words(converted("metres:0.1", "three:near=5", lamp(LightKind::spot)).numbers[0].reason,
               {"m away, nearer than near = 5 m"});
  expect_words(error_of([] { terms("godot:bias=0.1", lamp(LightKind::spot)); }), {"godot shadow_bias", "spot light"});
  expect_words(converted("metres:0.1", "unity-urp", lamp(LightKind::point)).numbers[0].reason, {"point light"});
}

TEST(EngineBias, Every_engine_converts_there_and_back) {
  for (const BiasEngine& engine : bias_engines()) {
    for (const MapPlace& place : {courtyard(), plain(), lamp(LightKind::spot), lamp(LightKind::point)}) {
      for (std::size_t i = 0; i < engine.numbers.size(); ++i) {
        BiasSpec spec = default_target(engine);
        for (double& setting : spec.settings.values) {
          if (std::isnan(setting)) setting = 4096.0;
        }
        spec.numbers.assign(engine.numbers.size(), 0.0);
        spec.numbers[i] = 0.375;
        if (!engine.numbers[i].per_unit(place, spec.settings)) continue;
        const BiasConversion back = convert(terms_of(spec, place), spec, place);
        for (std::size_t j = 0; j < engine.numbers.size(); ++j) {
          ASSERT_TRUE(back.numbers[j].value) << engine.name;
          EXPECT_NEAR(*back.numbers[j].value, spec.numbers[j], 1e-12) << engine.name;
        }
        EXPECT_TRUE(back.has_equivalent && back.missing.empty()) << engine.name;
      }
    }
  }
}

TEST(EngineBias, Every_engine_has_a_name_a_source_and_numbers_or_a_reason) {
  std::set<std::string_view> names;
  for (const BiasEngine& engine : bias_engines()) {
    EXPECT_TRUE(names.insert(engine.name).second) << engine.name;
    EXPECT_NE(engine.numbers.empty(), engine.no_numbers.empty()) << engine.name;
    EXPECT_TRUE(engine.is_unit || !engine.source.empty()) << engine.name;
    for (const BiasNumber& number : engine.numbers) {
      EXPECT_FALSE(number.formula.empty() || number.unit.empty()) << engine.name;
      EXPECT_TRUE(engine.is_unit || number.code.find("{}") != std::string_view::npos) << engine.name;
    }
  }
}

TEST(EngineBias, Offsets_are_equivalent_only_if_profile_side_and_direction_agree) {
  // Both move the receiver along its normal at any angle: 2 √2 texels of 2 cm.
  EXPECT_NEAR(*converted("unity-hdrp:normalBias=2,slopeBias=0", "three", courtyard()).numbers[1].value,
              0.04 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(*converted("filament:normalBias=2", "umbrameter", courtyard()).numbers[1].value, 1.0, 1e-12);
  // Our own technique has every kind, by flags beside the number.
  const BiasConversion ours = converted("godot:normal_bias=2", "umbrameter", courtyard());
  EXPECT_NEAR(*ours.numbers[1].value, 2.0, 1e-12);
  EXPECT_EQ(
      ours.numbers[1].code,
      "--shadow.normal-offset {} --shadow.normal-offset-profile constant --shadow.normal-offset-direction across");
  EXPECT_EQ(converted("unity-urp:normalBias=1", "umbrameter", courtyard()).numbers[1].code,
            "--shadow.caster-offset {} --shadow.caster-offset-profile one-minus-cosine");
  // The same but for the backs of double-sided faces.
  EXPECT_NEAR(*converted("three:normalBias=0.1", "playcanvas", courtyard()).numbers[1].value, 0.1, 1e-12);
  EXPECT_EQ(converted("three:normalBias=0.1", "umbrameter", courtyard()).numbers[1].code,
            "--shadow.normal-offset {} --shadow.normal-offset-profile constant --shadow.normal-offset-facing front");
  for (const char* target : {"three", "unity-urp", "filament", "playcanvas", "babylon"}) {
    const BiasConversion none = converted("godot:normal_bias=2", target, courtyard());
    EXPECT_FALSE(none.numbers[1].value) << target;
    expect_words(none.numbers[1].reason,
                 {"it includes the component along the light's direction (the given offset leaves it out)"});
  }
  expect_words(converted("unity-urp", "playcanvas", courtyard()).numbers[1].reason,
               {"it moves the receiver (the given offset moves the caster)",
                "its length along the normal is the same at every angle (that of the given offset is proportional to 1 "
                "− cos θ)"});
  EXPECT_EQ(converted("godot:bias=0,normal_bias=2", "three", courtyard()).numbers[0].value, 0.0);
}

TEST(EngineBias, A_part_without_a_number_is_missing) {
  const BiasConversion none = converted("metres:0.05", "playcanvas", courtyard());
  EXPECT_FALSE(none.has_equivalent);
  ASSERT_EQ(none.missing.size(), 1u);
  expect_words(none.missing.front(), {"constant bias"});
  EXPECT_EQ(*none.numbers[0].value, 0.0);
  BiasTerms offset;
  offset.normal = 0.01;
  offset.offset = {OffsetProfile::one_minus_cosine};
  expect_words(convert(offset, parse_bias_targets("stride").front(), courtyard()).numbers[1].reason, {"atlas"});
}

TEST(EngineBias, All_engines_that_have_an_equivalent_are_the_targets_by_default) {
  const ConvertedBias bias = convert_bias(parse_bias_source("godot:bias=0.1"), {}, {courtyard()});
  std::set<std::string_view> names;
  for (const ConvertedTarget& target : bias.targets) names.insert(target.spec.engine->name);
  EXPECT_TRUE(names.contains("three") && names.contains("texels") && names.contains("unity-urp"));
  EXPECT_FALSE(names.contains("godot") || names.contains("playcanvas") || names.contains("unity-hdrp"));
}

TEST(EngineBias, One_number_for_all_cascades_reaches_the_source_in_each) {
  std::vector<MapPlace> places{courtyard(), courtyard()};
  places[1].texel = 0.08;
  // 0.4 m is 20 texels of the first cascade and 5 of the second: 20 reaches it in both, 4 × as much in the second.
  const ConvertedBias texels =
      convert_bias(parse_bias_source("metres:0.4"), parse_bias_targets("texels,three"), places);
  const std::optional<ChosenValue> chosen = choose_value(texels.targets[0], 0);
  ASSERT_TRUE(chosen);
  EXPECT_NEAR(chosen->value, 20.0, 1e-12);
  EXPECT_EQ(chosen->place, 0u);
  EXPECT_NEAR(chosen->excess, 4.0, 1e-12);
  // Signs: three.js's bias is negative where ours is positive. 2 texels are 4 cm and 16 cm.
  const ConvertedBias depth =
      convert_bias(parse_bias_source("texels:2"), parse_bias_targets("three:near=0,far=100"), places);
  EXPECT_NEAR(choose_value(depth.targets[0], 0)->value, -0.0016, 1e-12);
  EXPECT_EQ(choose_value(depth.targets[0], 0)->place, 1u);
}

TEST(EngineBias, Texel_and_range_of_an_engine_replace_those_of_our_map) {
  const std::vector<MapPlace> places{courtyard(), courtyard()};
  const BiasSpec spec = parse_bias_source("map-depth:0.005,range=400/2600,texel=0.5");
  const std::vector<MapPlace> own = places_for(spec, places);
  EXPECT_NEAR(terms_of(spec, own[0]).constant, 2.0, 1e-12);  // "0.005 of depth is 2 to 13 m"
  EXPECT_NEAR(terms_of(spec, own[1]).constant, 13.0, 1e-12);
  EXPECT_EQ(own[1].texel, 0.5);
  expect_words(error_of([&] { places_for(spec, {courtyard()}); }), {"map-depth range", "2 values", "1 place"});
}

TEST(EngineBias, A_mistake_is_one_line_that_names_it) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"godott:bias=1", {"'godott'", "did you mean 'godot'"}},
      {"", {"no engine named"}},
      {"godot:bais=1", {"godot bais", "known are shadow_bias"}},
      {"godot:normal_bia=1", {"did you mean 'normal_bias'"}},
      {"godot:bias=", {"godot bias", "no value given"}},
      {"godot:bias=nan", {"'nan' is not a number"}},
      {"godot:bias=1e999", {"is not a number"}},
      {"godot:bias=0.1x", {"'0.1x' is not a number"}},
      {"godot:quality=soft", {"godot quality", "very-low"}},
      {"godot:bias=1,range=-3", {"godot range", "above 0"}},
      {"three:far=-1", {"three far", "below 0"}},
      {"three:near", {"three near", "no value given"}},
      {"three:near=80,far=1,bias=1", {"three bias", "without effect"}},
      {"metres", {"no value given", "metres:bias=0.05"}},
      {"wicked:bias=1", {"Wicked", "fixed polygon offset"}},
      {"stride", {"stride NormalOffsetScale", "atlas="}},
      {"three:near=5,far=5,bias=1", {"three bias", "without effect"}},
  };
  for (const auto& [text, words] : cases) {
    const std::string message = error_of([&] { terms(text, courtyard()); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    expect_words(message, words);
  }
  expect_words(error_of([] { parse_bias_targets("three:bias=1"); }), {"three bias", "cannot be given"});
  expect_words(error_of([] { parse_bias_targets("three,,metres"); }), {"no engine named"});
  expect_words(error_of([] { parse_bias_targets("near=1"); }), {"near=1"});
}

TEST(EngineBias, Settings_of_a_target_follow_its_name) {
  const std::vector<BiasSpec> targets = parse_bias_targets("three:near=1,far=80,unity-urp,babylon:filter=pcf");
  ASSERT_EQ(targets.size(), 3u);
  EXPECT_EQ(targets[0].settings["far"], 80.0);
  EXPECT_EQ(targets[1].engine->name, "unity-urp");
  EXPECT_EQ(targets[2].settings["filter"], 1.0);
}

TEST(EngineBias, Places_are_the_cascades_of_the_map) {
  Light sun;
  sun.shape = DirectionalLight{};
  MapLayout layout;
  layout.resolution = 1000;
  layout.far_depth = 60.0;
  layout.views = {MapView{dvec2(0.0), 5.0}, MapView{dvec2(0.0), 20.0}};
  const std::vector<MapPlace> places = places_of(sun, layout, GBuffer(1, 1));
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[1].name, "cascade 2");
  EXPECT_NEAR(places[0].texel, 0.01, 1e-12);
  EXPECT_NEAR(places[1].texel, 0.04, 1e-12);
  EXPECT_NEAR(places[1].range, 60.0, 1e-12);
}

TEST(EngineBias, Places_of_a_spot_light_are_its_nearest_and_farthest_receiver) {
  Light light;
  light.shape = SpotLight{};
  MapLayout layout;
  layout.kind = MapKind::perspective;
  layout.resolution = 1000;
  layout.far_depth = 30.0;
  layout.views = {MapView{dvec2(0.0), 1.0}};
  GBuffer surfels(3, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    surfels.instance[i] = 0;
    surfels.position[i] = vec3(0, 0, -5.0f * static_cast<float>(i + 1));
    surfels.geometric_normal[i] = vec3(0, 0, 1);
  }
  surfels.geometric_normal[0] = vec3(0, 0, -1);  // faces away: no receiver
  const std::vector<MapPlace> places = places_of(light, layout, surfels);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR(places[0].depth, 10.0, 1e-12);
  EXPECT_NEAR(places[0].texel, 0.02, 1e-12);  // 2 · 10 m / 1000
  EXPECT_NEAR(places[1].depth, 15.0, 1e-12);
  expect_words(error_of([&] { places_of(light, layout, GBuffer(1, 1)); }), {"sees nothing"});
}

}  // namespace
}  // namespace umbrameter
