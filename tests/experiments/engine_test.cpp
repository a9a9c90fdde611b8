#include "experiments/engine/engine.h"

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "experiments/engine/frame_source.h"
#include "experiments/settings/engine_bias.h"
#include "scenes/builtin.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

constexpr EngineLimits short_limits{10.0, 10.0, 1.0, 0.1};

std::string hostile(const std::string& fault, const std::string& state = {}) {
  return "python3 '" UMBRAMETER_SOURCE_DIR "/tests/support/hostile_adapter.py' " + fault +
         (state.empty() ? "" : " '" + state + "'");
}

struct Loaded {
  Scene scene = load_scene("corner");
  View view{8, 6, scene.cameras.front()};
  Light light = scene.lights.front();

  Loaded() { light.shape = DirectionalLight{}; }
  void into(Engine& engine) const { engine.load(scene, "corner", view, light); }
};

std::vector<EngineFrame> render(Engine& engine, const std::vector<double>& biases = {0.0}) {
  std::vector<EngineParams> frames;
  for (const double bias : biases) {
    frames.push_back(engine.parameters());
    frames.back().parameters.front().number = bias;
  }
  return engine.render({"visibility"}, frames);
}

// What the user reads of a fault, and its exit code.
std::pair<std::string, ExitCode> failure_of(const std::string& fault) {
  try {
    Engine engine(hostile(fault), short_limits);
    Loaded().into(engine);
    render(engine);
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    return {text, error.code()};
  }
  ADD_FAILURE() << fault << " was accepted";
  return {};
}

void expect_failure(const std::string& fault, const std::string& reason) {
  const auto [text, code] = failure_of(fault);
  EXPECT_NE(text.find(reason), std::string::npos) << fault << ": " << text;
  EXPECT_EQ(code, ExitCode::partial) << fault;
}

TEST(Engine, Frames_come_back_in_order_with_their_time) {
  Engine engine(hostile("none"));
  EXPECT_EQ(engine.description().title(), "hostile 1");
  Loaded().into(engine);
  const std::vector<EngineFrame> frames = render(engine, {-0.4, 0.0, 0.4});
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_FLOAT_EQ(frames[i].images.front()[17].x, 0.4f + 0.1f * static_cast<float>(i));
    EXPECT_DOUBLE_EQ(frames[i].milliseconds, 1.5);
  }
}

TEST(Engine, Each_fault_is_one_line_with_its_reason) {
  expect_failure("crash", "it was ended by signal 9 (out of texture memory)");
  expect_failure("silent", "it did not reply within 1 s");
  expect_failure("refuse", "the driver lost the device");
  expect_failure("endless", "it wrote a line of more than 1048576 bytes");
  expect_failure("garbage", "it wrote 'Loading shaders...', which is no JSON object");
  expect_failure("id", "has not the id");
  expect_failure("protocol", "it speaks protocol 2, not 1");
  expect_failure("twins", "two parameters are named bias");
  expect_failure("few", "it rendered 0 frames of 1");
}

TEST(Engine, Files_outside_its_folder_and_of_other_kinds_are_not_opened) {
  expect_failure("traversal", "'../scene.glb' is no plain file name");
  expect_failure("absolute", "'/etc/passwd' is no plain file name");
  expect_failure("link", "0-visibility.pfm is no regular file");
  expect_failure("fifo", "0-visibility.pfm is no regular file");
  expect_failure("missing", "it wrote no file 0-visibility.pfm");
  expect_failure("no-image", "0-visibility.pfm");
  expect_failure("size", "0-visibility.pfm has 9x6 pixels, not 8x6");
}

TEST(Engine, Values_that_are_no_share_of_light_are_refused) {
  Engine engine(hostile("range"));
  const Loaded loaded;
  loaded.into(engine);
  EXPECT_THROW(share_of(render(engine).front().images.front(), "visibility"), Error);
}

TEST(Engine, A_crash_is_survived_once_and_the_scene_is_loaded_again) {
  const TemporaryFolder folder;
  Engine engine(hostile("crash-once", (folder / "state").string()));
  Loaded().into(engine);
  EXPECT_EQ(render(engine).size(), 1u);
  EXPECT_EQ(engine.restarts(), 1);
  EXPECT_EQ(render(engine).size(), 1u);
  const std::vector<std::string> warnings = engine.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("was started again: it was ended by signal 9"), std::string::npos)
      << warnings.front();
}

TEST(Engine, Depths_come_with_the_planes_of_the_camera_that_it_was_given) {
  const auto engine = std::make_shared<Engine>(hostile("depth"));
  Loaded loaded;
  loaded.view.camera.projection = PerspectiveProjection{0.8, 0.05};
  const FrameSource frames = frames_of(engine);
  const auto surfaces = frames.surfaces({loaded.scene, "corner", loaded.view, loaded.light});
  ASSERT_TRUE(surfaces);
  EXPECT_EQ(surfaces->convention, DepthConvention::window);
  EXPECT_DOUBLE_EQ(surfaces->near_plane, 0.05);
  EXPECT_TRUE(std::isfinite(surfaces->far_plane));
  // ½ = f (z − n) / (z (f − n)): z is 2 f n / (f + n).
  const double z = 2.0 * surfaces->far_plane * 0.05 / (surfaces->far_plane + 0.05);
  const Image<vec3> positions = positions_of(*surfaces, loaded.view);
  EXPECT_NEAR(-(view_from_world(loaded.view) * dvec4(dvec3(positions[9]), 1.0)).z, z, 1e-5);
}

TEST(Engine, What_it_warns_of_is_passed_on_once) {
  Engine engine(hostile("warn"));
  Loaded().into(engine);
  EXPECT_EQ(engine.take_warnings(), std::vector<std::string>{"hostile: it has no cameras"});
  EXPECT_TRUE(engine.take_warnings().empty());
}

TEST(Engine, One_that_does_not_end_is_ended_and_said_to_have_stayed) {
  Engine good(hostile("none"));
  EXPECT_TRUE(good.end());
  const auto start = std::chrono::steady_clock::now();
  Engine engine(hostile("stays"));
  EXPECT_FALSE(engine.end());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_GE(taken.count(), 4.5);
  EXPECT_LT(taken.count(), 30.0);
}

TEST(Engine, A_command_that_is_not_there_says_so) {
  try {
    Engine engine("/nowhere/adapter");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "/nowhere/adapter: cannot start: No such file or directory; check the command; 'umbrameter engine list' "
        "shows the adapters that are installed");
  }
}

TEST(EngineCommand, Quotes_group_words_and_nothing_else_is_special) {
  EXPECT_EQ(engine_command("python3 'my adapter.py' --x=\"a b\" $HOME"),
            (std::vector<std::string>{"python3", "my adapter.py", "--x=a b", "$HOME"}));
  EXPECT_THROW(engine_command("python3 'adapter.py"), Error);
  EXPECT_THROW(engine_command("  "), Error);
}

TEST(EngineProtocol, Wrong_descriptions_are_refused_with_the_reason) {
  const nlohmann::ordered_json good =
      nlohmann::ordered_json::parse(R"({"id": 1, "protocol": 1, "name": "e", "version": "",
      "outputs": ["ao"], "lights": [], "parameters": [{"name": "radius", "type": "number", "default": 1, "meaning": "m"}]})");
  EXPECT_NO_THROW(parse_description(good.dump(), 1));
  const auto reason = [&](const char* pointer, const nlohmann::ordered_json& value) -> std::string {
    nlohmann::ordered_json changed = good;
    changed[nlohmann::ordered_json::json_pointer(pointer)] = value;
    try {
      parse_description(changed.dump(), 1);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(reason("/name", 7), "'name' is no text");
  EXPECT_EQ(reason("/outputs", {"shadow"}), "'shadow' is no output");
  EXPECT_EQ(reason("/outputs", {"position"}), "its outputs hold neither visibility nor ao");
  EXPECT_EQ(reason("/outputs", {"lit"}), "of its outputs lit and unshadowed, or occluded and open, one is missing");
  EXPECT_EQ(reason("/outputs", {"ao", "depth"}), "'depth' is missing");
  EXPECT_EQ(reason("/parameters/0/name", "Radius"), "'Radius' cannot be the name of a parameter");
  EXPECT_EQ(reason("/parameters/0/name", "--force"), "'--force' cannot be the name of a parameter");
  EXPECT_EQ(reason("/parameters/0/type", "colour"), "'colour' is no type");
  EXPECT_EQ(reason("/parameters/0/type", "choice"), "'choices' is no list");
  EXPECT_NE(reason("/parameters/0/min", 2).find("its default does not fit"), std::string::npos);
  EXPECT_EQ(reason("/parameters/0/bias", "large"), "parameter radius: 'bias' must be up or down");
  EXPECT_EQ(reason("/parameters/0", {{"name", "soft"}, {"type", "boolean"}, {"meaning", "m"}, {"bias", "up"}}),
            "parameter soft: only a number of shadows can have 'bias'");
  EXPECT_NE(reason("/parameters/0/default", "big").find("its default does not fit"), std::string::npos);
}

TEST(EngineProtocol, A_parameter_becomes_one_of_ours) {
  const EngineDescription described = parse_description(
      R"({"id": 3, "protocol": 1, "name": "e", "version": "1", "outputs": ["visibility"], "lights": ["spot"],
          "parameters": [{"name": "type", "type": "choice", "default": "vsm", "choices": ["pcf", "vsm"], "meaning": "kind"},
                         {"name": "map-size", "type": "integer", "default": 512, "min": 16, "max": 8192, "meaning": "side"},
                         {"name": "radius", "type": "number", "default": 0.5, "unit": "m", "for": "ao", "meaning": "r"},
                         {"name": "soft", "type": "boolean", "default": true, "meaning": "blur"}]})",
      3);
  EngineParams params{"e", described.title(), described.parameters};
  const Parameters all = describe(params);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(to_string(require(all, "engine.type").value()), "vsm");
  EXPECT_EQ(map_size_of(params), 512);
  EXPECT_THROW(require(all, "engine.map-size").set_text("8"), Error);
  require(all, "engine.soft").set_text("false");
  require(all, "engine.radius").set_text("0.25");
  use_engine(params);
  EXPECT_TRUE(is_engine_ao("engine.radius"));
  EXPECT_FALSE(is_engine_ao("engine.type"));
  use_engine({});
  const auto request = nlohmann::json::parse(render_request(9, {"visibility"}, {&params, 1}));
  EXPECT_EQ(request["frames"][0],
            (nlohmann::json{{"type", "vsm"}, {"map-size", 512}, {"radius", 0.25}, {"soft", false}}));
}

TEST(EngineBias, Is_the_only_axis_that_an_adapter_calls_a_bias_in_the_order_in_which_it_lights_more) {
  const EngineDescription described = parse_description(
      R"({"id": 3, "protocol": 1, "name": "e", "outputs": ["visibility"], "lights": ["spot"],
          "parameters": [{"name": "offset", "type": "number", "default": 0, "bias": "down", "meaning": "b"},
                         {"name": "steps", "type": "integer", "default": 0, "bias": "up", "meaning": "c"},
                         {"name": "radius", "type": "number", "default": 0, "meaning": "r"}]})",
      3);
  Experiment experiment;
  experiment.engine = {"e", "e", described.parameters};
  EXPECT_FALSE(engine_bias_axis(experiment));
  experiment.axes = {{"engine.radius", "0,1"}, {"engine.offset", "-2:0:3"}};
  const std::optional<SweepAxis> axis = engine_bias_axis(experiment);
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->key, "engine.offset");
  EXPECT_EQ(axis->values, (std::vector<Value>{0.0, -1.0, -2.0}));
  experiment.axes.emplace_back("engine.steps", "0,1");
  EXPECT_FALSE(engine_bias_axis(experiment));
}

TEST(RatioOf, Frames_are_divided_by_luminance_where_there_is_light) {
  Image<vec3> with(4, 1, vec3(0.0f)), without(4, 1, vec3(0.0f));
  with[0] = vec3(0.25f), without[0] = vec3(1.0f);
  with[1] = vec3(1.0000001f), without[1] = vec3(1.0f);
  with[3] = without[3] = vec3(std::numeric_limits<float>::quiet_NaN());
  const Image<float> ratio = ratio_of(with, without);
  EXPECT_FLOAT_EQ(ratio[0], 0.25f);
  EXPECT_EQ(ratio[1], 1.0f);
  EXPECT_EQ(ratio[2], 1.0f);
  EXPECT_TRUE(std::isnan(ratio[3]));
  EXPECT_EQ(unlit_of(without).pixels, (std::vector<std::uint8_t>{0, 0, 1, 0}));
}

}  // namespace
}  // namespace umbrameter
