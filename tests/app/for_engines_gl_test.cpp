// A recommended bias in the numbers of engines: what they have is what their own numbers, set by hand, have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct ForEngines : GlRun {
  Json compare(const std::vector<std::string>& more, const std::string& scene = "contact-box",
               const std::string& light = "sun") {
    const ProgramResult result =
        run_program(words({"compare", scene, "-o", folder_ / "out", "--force", "--light", light, "--size", "160x90",
                           "--measure", "visibility", "--no-figures", "--quiet", "--json"},
                          more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out).at("shadows").at(0);
  }
  static double error_of(const Json& shadow) { return shadow.at("statistics").at("mae"); }
};

TEST_F(ForEngines, Rounded_numbers_are_measured_again) {
  // Three digits of the depth are other biases than three digits of metres.
  // A second flag adds to the list.
  const Json engines =
      compare({"--for", "metres", "--for", "three:near=1,far=51"}).at("recommended_bias").at("engines");
  ASSERT_EQ(engines.size(), 2u);
  // three.js draws back faces into its map.
  for (const auto& [engine, unit, faces] : {std::tuple{0, 1.0, "all"}, std::tuple{1, -50.0, "back"}}) {
    const Json& advice = engines.at(static_cast<std::size_t>(engine));
    const double set = advice.at("numbers").at(0).at("set").at(0);
    const Json by_hand = compare({"--shadow.constant-bias", fmt::format("{}", set * unit), "--shadow.faces", faces});
    EXPECT_NEAR(advice.at("mae").get<double>(), error_of(by_hand), 1e-12) << advice;
  }
  EXPECT_EQ(engines.at(1).at("code").at(1), "light.shadow.normalBias = 0.0;");
  EXPECT_NEAR(engines.at(1).at("mae_of_defaults").get<double>(),
              error_of(compare({"--shadow.constant-bias", "0", "--shadow.faces", "back"})), 1e-12);
}

TEST_F(ForEngines, A_sweep_converts_the_bias_of_its_own_answer) {
  const std::string out =
      run_program({"sweep", "courtyard", "--light", "sun", "--size", "160x90", "--no-figures", "--vary",
                   "shadow.constant-bias=1texels,1.5texels,3texels", "--for", "texels", "-o", folder_ / "sweep"})
          .out;
  const auto text_after = [&](const std::string& words, char end) {
    const std::size_t start = out.find(words);
    EXPECT_NE(start, std::string::npos) << out;
    if (start == std::string::npos) return std::string();
    return out.substr(start + words.size(), out.find(end, start) - start - words.size());
  };
  const double converted = std::stod(text_after("    bias = ", '\n'));
  EXPECT_EQ(std::stod(text_after("use bias ", 't')), converted);
  EXPECT_EQ(std::stod(text_after("the bias to use, ", 't')), converted);
}

// A sweep that does not vary the bias recommends none itself.
TEST_F(ForEngines, A_sweep_of_other_axes_names_the_bias_that_it_converts) {
  const std::string out =
      run_program({"sweep", "courtyard", "--light", "sun", "--size", "160x90", "--no-figures", "--vary",
                   "shadow.resolution=512,1024", "--for", "texels", "-o", folder_ / "resolutions"})
          .out;
  EXPECT_NE(out.find("cell of least error, with the bias that compare recommends there, "), std::string::npos) << out;
}

TEST_F(ForEngines, One_number_for_all_cascades_is_measured_in_each) {
  const std::vector<std::string> cascades = {"--shadow.cascades", "3"};
  const Json shadow =
      compare(words({"--for", "godot:pancake=5", "--shadow.normal-offset", "1", "--shadow.normal-offset-profile",
                     "constant", "--shadow.normal-offset-direction", "across"},
                    cascades));
  const Json& godot = shadow.at("recommended_bias").at("engines").at(0);
  const double bias = godot.at("numbers").at(0).at("set").at(0);
  EXPECT_EQ(godot.at("numbers").at(1).at("set"), (Json{1.0, 1.0, 1.0}));
  ASSERT_EQ(godot.at("places").size(), 3u);
  // (t · resolution + pancake) · blur · quality / 100, and steps of 0.001.
  EXPECT_NEAR(bias, std::round(1000 * bias) / 1000, 1e-12);
  std::vector<double> metres;
  for (const Json& place : godot.at("places")) {
    metres.push_back(bias * 2.0 / 100.0 * (place.at("texel_m").get<double>() * 1024 + 5.0));
  }
  EXPECT_GT(metres[2] / metres[0], 1.05);
  const Json by_hand =
      compare(words({"--shadow.constant-bias", fmt::format("{}", metres[0]), "--shadow.cascade-bias",
                     fmt::format("1,{},{}", metres[1] / metres[0], metres[2] / metres[0]), "--shadow.normal-offset",
                     "1", "--shadow.normal-offset-profile", "constant", "--shadow.normal-offset-direction", "across"},
                    cascades));
  EXPECT_NEAR(godot.at("mae").get<double>(), error_of(by_hand), 1e-9);
}

TEST_F(ForEngines, The_defaults_of_an_engine_have_the_error_of_its_preset) {
  // Shares of each cascade's own depth range, and texels: what Godot's preset says is what its numbers mean.
  const Json shadow = compare({"--preset", "godot", "--shadow.resolution", "256", "--for", "godot"});
  const Json& godot = shadow.at("recommended_bias").at("engines").at(0);
  EXPECT_NEAR(godot.at("mae_of_defaults").get<double>(), error_of(shadow), 1e-9);
  EXPECT_GT(error_of(shadow), 0.0);
}

// Unity URP always draws with a polygon offset: numbers that are right without it are too large.
TEST_F(ForEngines, What_an_engine_always_adds_is_in_its_numbers_and_in_their_error) {
  const Json urp = compare({"--for", "unity-urp"}).at("recommended_bias").at("engines").at(0);
  const std::vector<std::string> always = {"--shadow.polygon-offset-factor", "2.5", "--shadow.polygon-offset-units",
                                           "1"};
  const double set = urp.at("numbers").at(0).at("set").at(0);
  const Json by_hand = compare(words({"--shadow.constant-bias", fmt::format("{}texels", set)}, always));
  EXPECT_NEAR(urp.at("mae").get<double>(), error_of(by_hand), 1e-9);
  const Json best = compare(always).at("recommended_bias").at("recommended");
  EXPECT_LE(urp.at("mae").get<double>(), 1.06 * best.at("mae").get<double>() + 1e-4);
}

TEST_F(ForEngines, The_depth_of_a_perspective_projection_is_that_of_the_map) {
  const std::vector<std::string> encoded = {"--shadow.depth-encoding", "perspective", "--shadow.depth-near", "0.5"};
  const Json shadow =
      compare(words({"--shadow.constant-bias", "0.001depth", "--for", "map-depth"}, encoded), "courtyard", "spot");
  const Json& advice = shadow.at("recommended_bias").at("engines").at(0);
  const Json& number = advice.at("numbers").at(0);
  // A share of the depth is one number at every distance.
  EXPECT_NEAR(number.at("values").at(0).get<double>(), number.at("values").at(1).get<double>(), 1e-12);
  const double set = number.at("set").at(0);
  const Json by_hand =
      compare(words({"--shadow.constant-bias", fmt::format("{}depth", set)}, encoded), "courtyard", "spot");
  EXPECT_NEAR(advice.at("mae").get<double>(), error_of(by_hand), 1e-12);
}

TEST_F(ForEngines, What_has_no_bias_to_convert_is_refused_or_noted) {
  const std::vector<std::string> small_run = {"--light", "sun", "--size", "96x54", "--no-figures", "--for", "metres"};
  const auto run = [&](const std::string& command, const std::vector<std::string>& more) {
    return run_program(words({command, "contact-box", "-o", folder_ / "out", "--force"}, words(small_run, more)));
  };
  for (const std::string command : {"compare", "sweep", "tune"}) {
    std::vector<std::string> axis;
    if (command != "compare") axis = {"--vary", "ao.radius=0.1:0.3:2"};
    const ProgramResult ao = run(command, words({"--measure", "ao"}, axis));
    EXPECT_EQ(ao.exit_code, 2) << command;
    EXPECT_NE(ao.err.find("--for"), std::string::npos) << ao.err;
  }
  const ProgramResult soft = run("compare", {"--measure", "visibility", "--light.angle", "2", "--truth.spp", "16"});
  EXPECT_EQ(soft.exit_code, 0) << soft.err;
  EXPECT_NE(soft.err.find("no bias in the numbers of engines"), std::string::npos) << soft.err;
}

TEST_F(ForEngines, A_bias_that_an_engine_cannot_say_has_no_numbers) {
  const ProgramResult result =
      run_program({"compare", "contact-box", "-o", folder_ / "out", "--light", "sun", "--size", "160x90", "--measure",
                   "visibility", "--no-figures", "--for", "unity-hdrp"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("in Unity HDRP: has no number for this bias"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("hdLight"), std::string::npos) << "zeros would look like a recommendation";
}

TEST_F(ForEngines, A_note_that_holds_for_several_lights_is_said_once) {
  const ProgramResult result = run_program({"compare", "courtyard", "-o", folder_ / "out", "--size", "160x90",
                                            "--measure", "visibility", "--no-figures", "--for", "unreal"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto count = [](const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(result.out, " in Unreal Engine, "), 3) << "one line for each light: " << result.out;
  EXPECT_EQ(count(result.out, "note: unreal, not verified: "), 1) << result.out;
  EXPECT_EQ(count(result.out, "there is no conversion here for a point light"), 1) << result.out;
  EXPECT_EQ(count(result.out, "there is no conversion here for a spot light"), 1) << result.out;
  EXPECT_EQ(count(text_of(folder_ / "out/index.html"), "<p class=\"remark\">unreal, not verified: "), 1);
}

// The bias is searched again without what the engine has no number for, so that it is that of a run without it.
TEST_F(ForEngines, A_part_that_an_engine_has_no_number_for_is_left_out_of_the_search) {
  const std::vector<std::string> faces = {"--shadow.faces", "back", "--for", "three:near=1,far=51"};
  const std::vector<std::string> offset = {"--shadow.normal-offset", "1"};  // of another kind than three.js's
  const auto three = [&](const std::vector<std::string>& more) {
    return compare(words(more, faces)).at("recommended_bias").at("engines").at(0);
  };
  const Json without = compare({"--shadow.faces", "back"}).at("recommended_bias");
  for (const std::vector<std::string>& part : {std::vector<std::string>{"--shadow.slope-bias", "1.5"}, offset}) {
    const Json of_part = three(part);
    EXPECT_NEAR(-50.0 * of_part.at("numbers").at(0).at("values").at(0).get<double>(),
                without.at("recommended").at("constant_bias").at("m").get<double>(), 1e-9)
        << part[0];
  }
  three({"--shadow.slope-bias", "1.5"});
  expect_words(text_of(folder_ / "out/index.html"),
               {"three: it has no number for shadow.slope-bias 1.5: the bias was searched again for this and is "});
}

TEST_F(ForEngines, The_bias_of_an_engine_that_draws_otherwise_does_not_depend_on_that_of_the_run) {
  const auto set = [&](const std::string& bias) {
    return compare({"--for", "unity-urp", "--shadow.constant-bias", bias})
        .at("recommended_bias")
        .at("engines")
        .at(0)
        .at("numbers");
  };
  EXPECT_EQ(set("1.5texels"), set("4texels"));
}

// The run's faces and polygon offset may be those of another engine's preset.
TEST_F(ForEngines, What_the_run_draws_does_not_enter_the_numbers_of_an_engine) {
  const Json filament = compare({"--shadow.faces", "back", "--shadow.polygon-offset-units", "4", "--for", "filament"})
                            .at("recommended_bias")
                            .at("engines")
                            .at(0);
  const std::vector<std::string> as_filament = {"--shadow.faces", "front", "--shadow.polygon-offset-units", "0.5"};
  const double set = filament.at("numbers").at(0).at("set").at(0);
  const Json by_hand = compare(words({"--shadow.constant-bias", fmt::format("{}", set)}, as_filament));
  EXPECT_NEAR(filament.at("mae").get<double>(), error_of(by_hand), 1e-9);
  const Json best = compare(as_filament).at("recommended_bias").at("recommended");
  EXPECT_LE(filament.at("mae").get<double>(), 1.06 * best.at("mae").get<double>() + 1e-4);
}

TEST_F(ForEngines, The_defaults_of_PlayCanvas_have_the_constant_that_it_always_adds) {
  const Json shadow = compare({"--preset", "playcanvas-pcf1", "--for", "playcanvas"});
  const Json& playcanvas = shadow.at("recommended_bias").at("engines").at(0);
  EXPECT_NEAR(playcanvas.at("mae_of_defaults").get<double>(), error_of(shadow), 1e-9);
}

// PlayCanvas has no number for a constant bias: what it always adds is none that it lacks.
TEST_F(ForEngines, The_polygon_offset_of_PlayCanvas_is_tuned) {
  const auto tune = [&](const std::vector<std::string>& more) {
    const ProgramResult result =
        run_program(words({"tune", "courtyard", "--light", "sun", "--size", "160x90", "--no-figures", "--evaluations",
                           "12", "--vary", "shadow.polygon-offset-factor=0:10", "--for", "playcanvas", "--preset",
                           "playcanvas-pcf1", "--json", "--force", "-o", folder_ / "out"},
                          more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out).at("tuning");
  };
  const Json tuning = tune({});
  const Json& engine = tuning.at("engines").at(0).at("engines").at(0);
  const double factor = tuning.at("best").at("values").at("shadow.polygon-offset-factor");
  EXPECT_NEAR(engine.at("numbers").at(0).at("values").at(0).get<double>(), factor / 10.0, 1e-6);
  EXPECT_LT(engine.at("mae").get<double>(), engine.at("mae_of_defaults").get<double>());
  const Json lost = tune({"--shadow.constant-bias", "0.01depth"});
  EXPECT_TRUE(lost.at("engines").at(0).at("engines").at(0).at("mae").is_null());
}

TEST_F(ForEngines, Numbers_of_cascades_that_differ_by_their_rounding_are_measured) {
  const Json three =
      compare({"--preset", "bevy", "--for", "three"}, "two-occluders").at("recommended_bias").at("engines").at(0);
  ASSERT_GT(three.at("places").size(), 1u);
  EXPECT_TRUE(three.at("mae").is_number());
}

TEST_F(ForEngines, A_map_that_has_no_bias_in_its_depth_leaves_the_error_open) {
  const Json three = compare({"--preset", "bevy-point", "--for", "three"}, "courtyard", "lantern")
                         .at("recommended_bias")
                         .at("engines");
  EXPECT_TRUE(three.at(0).at("mae").is_null());
}

TEST_F(ForEngines, A_tuning_of_other_axes_names_the_bias_that_it_converts) {
  const ProgramResult tune =
      run_program({"tune", "courtyard", "--light", "sun", "--size", "160x90", "--no-figures", "--vary",
                   "shadow.resolution=512,1024", "--for", "texels", "-o", folder_ / "out"});
  ASSERT_EQ(tune.exit_code, 0) << tune.err;
  expect_words(tune.out, {", the bias that compare recommends at this point, "});
}

// Godot's bias of a point light is in metres: the best in texels, converted for the farthest receiver, is too large.
TEST_F(ForEngines, A_number_in_metres_is_searched_in_metres) {
  const Json godot = compare({"--for", "godot"}, "courtyard", "lantern").at("recommended_bias").at("engines").at(0);
  const Json in_metres = compare({"--shadow.constant-bias", "0.1"}, "courtyard", "lantern").at("recommended_bias");
  EXPECT_NEAR(godot.at("numbers").at(0).at("values").at(0).get<double>(),
              in_metres.at("recommended").at("constant_bias").at("m").get<double>(), 1e-9);
}

// An engine with one number for all places gets the same number, whatever unit the bias of the run has.
TEST_F(ForEngines, One_number_for_all_places_is_searched_along_it_whatever_the_unit_of_the_run) {
  struct Case {
    const char* engine;
    const char* scene;
    const char* light;
    std::vector<std::string> map;
    std::vector<std::string> units;
  };
  for (const Case& each :
       {Case{"three", "courtyard", "spot", {"--preset", "threejs-basic-spot"}, {"0", "1texels", "0depth"}},
        Case{"babylon", "two-occluders", "sun", {"--shadow.cascades", "3"}, {"0.02", "1texels", "0.001depth"}},
        Case{"godot:pancake=5", "two-occluders", "sun", {"--shadow.cascades", "3"}, {"0.02", "1texels"}}}) {
    std::vector<Json> found;
    for (const std::string& unit : each.units) {
      const Json shadow =
          compare(words({"--for", each.engine, "--shadow.constant-bias", unit}, each.map), each.scene, each.light);
      found.push_back(shadow.at("recommended_bias").at("engines").at(0));
      ASSERT_GT(found.back().at("places").size(), 1u) << each.engine;
      const Json& number = found.back().at("numbers").at(0);
      EXPECT_EQ(number.at("set"), found.front().at("numbers").at(0).at("set")) << each.engine << ", " << unit;
      EXPECT_EQ(found.back().at("mae"), found.front().at("mae")) << each.engine << ", " << unit;
      for (const Json& value : number.at("values"))
        EXPECT_NEAR(value.get<double>() / number.at("values").at(0).get<double>(), 1.0, 1e-6) << each.engine;
    }
  }
}

// Of a light without a range Unity's default is assumed, which may end before what it lights here.
TEST_F(ForEngines, A_light_that_ends_before_its_receivers_has_no_number) {
  const auto urp = [&](const char* target) {
    return run_program({"compare", "two-occluders", "--light", "spot", "--measure", "visibility", "--no-figures",
                        "--size", "160x90", "-o", folder_ / "out", "--force", "--for", target})
        .out;
  };
  const std::string near = urp("unity-urp:lightRange=2");
  expect_words(near, {"has no number for this bias: the nearest receiver of this image is ",
                      " m away, beyond lightRange = 2 m; give the range of your light, unity-urp:lightRange="});
  EXPECT_EQ(near.find("light.shadowBias"), std::string::npos) << near;
  expect_words(urp("unity-urp:lightRange=500"), {"light.shadowBias = "});
}

// An engine has one number for a light, whichever camera looks.
TEST_F(ForEngines, Cases_of_one_light_have_the_same_numbers) {
  const ProgramResult tune = run_program({"tune", "courtyard", "--light", "spot", "--over", "view.camera=all", "--vary",
                                          "shadow.constant-bias=0:8texels", "--for", "unity-urp,godot", "--size",
                                          "160x90", "--no-figures", "--json", "-o", folder_ / "out"});
  ASSERT_EQ(tune.exit_code, 0) << tune.err;
  const Json cases = Json::parse(tune.out).at("tuning").at("engines");
  ASSERT_EQ(cases.size(), 2u);
  const auto set = [&](std::size_t c) { return cases.at(c).at("engines").at(0).at("numbers").at(0).at("set").at(0); };
  EXPECT_EQ(set(0), set(1));
  double needed = 0.0;
  for (const Json& of_case : cases) {
    for (const Json& value : of_case.at("engines").at(0).at("numbers").at(0).at("values"))
      needed = std::max(needed, value.get<double>());
  }
  EXPECT_GE(set(0).get<double>(), needed - 1e-9);
  EXPECT_LE(set(0).get<double>(), 1.01 * needed);
}

TEST_F(ForEngines, What_an_engine_draws_otherwise_than_the_run_is_said_with_the_bias_found_for_it) {
  const auto lines = [&](const std::vector<std::string>& more) {
    return run_program(words({"compare", "courtyard", "-o", folder_ / "out", "--force", "--light", "sun", "--size",
                              "160x90", "--measure", "shadows", "--no-figures"},
                             more))
        .out;
  };
  expect_words(
      lines({"--for", "three"}),
      {"note: three: it casts back faces of single-sided surfaces: the bias was searched again for this and is ",
       " of our map; the errors are those of the numbers shown, with a map drawn that way"});
  const std::string set = lines({"--for", "three", "--shadow.faces", "back"});
  EXPECT_EQ(set.find("it casts"), std::string::npos) << set;
  EXPECT_EQ(lines({"--for", "three:shadowSide=double"}).find("it casts"), std::string::npos);
  // Filament has both.
  const std::string filament = lines({"--for", "filament", "--shadow.faces", "back"});
  expect_words(filament,
               {"note: filament: it casts front faces of single-sided surfaces and adds polygon offset units 0.5: "});
}

TEST_F(ForEngines, A_sweep_and_a_tuning_state_their_best_bias) {
  const std::vector<std::string> common = {
      "--light", "sun",          "--size", "160x90",  "--no-figures",        "--quiet",
      "--json",  "--for",        "metres", "--force", "--shadow.resolution", "256",
      "-o",      folder_ / "out"};
  const ProgramResult sweep =
      run_program(words({"sweep", "contact-box", "--vary", "shadow.constant-bias=0.01,0.02,0.04"}, common));
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  const Json cell = Json::parse(sweep.out).at("sweep").at("engines_at_least_mae").at(0);
  EXPECT_EQ(cell.at("engine"), "metres");
  EXPECT_TRUE(cell.at("mae").is_number());
  const ProgramResult tune =
      run_program(words({"tune", "contact-box", "--vary", "shadow.constant-bias=0.001:0.1"}, common));
  ASSERT_EQ(tune.exit_code, 0) << tune.err;
  const Json tuning = Json::parse(tune.out).at("tuning");
  const Json& of_case = tuning.at("engines").at(0);
  EXPECT_NE(of_case.at("case").get<std::string>().find("sun"), std::string::npos);
  EXPECT_TRUE(of_case.at("engines").at(0).at("mae").is_number());
}

TEST_F(ForEngines, Wrong_names_are_refused_before_any_work) {
  for (const auto& [text, word] :
       {std::pair{"godott", "godot"}, std::pair{"three:nera=1", "near"}, std::pair{"eevee", "automatically"}}) {
    const ProgramResult result = run_program({"compare", "contact-box", "-o", folder_ / "out", "--for", text});
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

}  // namespace
}  // namespace umbrameter
