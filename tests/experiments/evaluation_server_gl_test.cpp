#include <nlohmann/json.hpp>

#include "experiments/measure/measure.h"
#include "experiments/serve/evaluation_server.h"
#include "tests/experiments/stages_gl.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

class EvaluationServerGl : public ContactBoxGl {
 protected:
  static Json ask(EvaluationServer& server, const std::string& parameters = "{}",
                  const std::string& request = "evaluate") {
    return Json::parse(server.reply(R"({"id": 1, "request": ")" + request + R"(", "parameters": )" + parameters + "}"));
  }
  static Experiment of_sun(const std::vector<std::string>& settings = {}) {
    Experiment experiment = base(settings);
    experiment.view.light = "sun";
    return experiment;
  }
};

TEST_F(EvaluationServerGl, Another_bias_traces_and_draws_again_nothing_but_the_look_up) {
  const std::unique_ptr<Stages> stages = make_stages();
  const Experiment given = of_sun({"run.classes=fast"});
  EvaluationServer server(*stages, given, SweptQuantity::visibility);
  const Experiment experiment = stages->in_metres(given);
  // Whoever holds a result keeps its address from being used again.
  const auto surfels = stages->surfels(experiment);
  const auto gpu_surfels = stages->gpu_surfels(experiment);
  const auto layout = stages->layout(experiment, 0);
  const auto counted = stages->counted(experiment, 0);
  const auto map = stages->map(experiment, 0);
  const auto truth = stages->truth(experiment, 0);
  const std::uint64_t rays = stages->tracer().rays_traced();
  std::vector<Json> errors;
  for (const double bias : {0.0, 0.05, 0.5}) {
    const std::string values = std::to_string(bias);
    const Json reply =
        ask(server, R"({"shadow.constant-bias": )" + values + R"(, "shadow.slope-bias": )" + values + "}");
    errors.push_back(reply.at("statistics").at("mae"));
  }
  EXPECT_NE(errors[0], errors[1]);
  EXPECT_NE(errors[1], errors[2]);
  EXPECT_EQ(stages->tracer().rays_traced(), rays);
  EXPECT_EQ(stages->surfels(experiment), surfels);
  EXPECT_EQ(stages->gpu_surfels(experiment), gpu_surfels);
  EXPECT_EQ(stages->layout(experiment, 0), layout);
  EXPECT_EQ(stages->counted(experiment, 0), counted);
  EXPECT_EQ(stages->map(experiment, 0), map);
  EXPECT_EQ(stages->truth(experiment, 0), truth);
}

TEST_F(EvaluationServerGl, A_reply_has_the_statistics_of_a_measurement_of_that_kind) {
  const std::unique_ptr<Stages> stages = make_stages();
  for (const auto& settings : std::vector<std::vector<std::string>>{
           {"shadow.filter=box"}, {"shadow.technique=esm"}, {"light.angle=2"}, {"shadow.filter=nearest"}}) {
    EvaluationServer server(*stages, of_sun(settings), SweptQuantity::visibility);
    Experiment experiment = of_sun(settings);
    require(describe(experiment), "shadow.constant-bias").set_text("0.03");
    const ShadowMeasurement measured = measure_shadow(*stages, stages->in_metres(experiment), 0, {});
    const Json reply = ask(server, R"({"shadow.constant-bias": 0.03})");
    std::visit(
        [&](auto statistics) {
          const std::vector<Column> columns = columns_of(statistics);
          const std::vector<Value> row = row_of(statistics);
          ASSERT_EQ(reply.at("statistics").size(), columns.size()) << settings.front();
          for (std::size_t c = 0; c < columns.size(); ++c) {
            const Json& value = reply["statistics"].at(columns[c].name);
            EXPECT_NEAR(value.get<double>(), to_number(row[c]), 1e-9) << settings.front() << " " << columns[c].name;
          }
        },
        *measured.statistics);
    EXPECT_GT(reply.at("milliseconds").get<double>(), 0.0);
  }
}

TEST_F(EvaluationServerGl, A_request_leaves_nothing_behind_for_the_next_one) {
  const std::unique_ptr<Stages> stages = make_stages();
  EvaluationServer server(*stages, of_sun(), SweptQuantity::visibility);
  const Json first = ask(server);
  EXPECT_NE(ask(server, R"({"shadow.constant-bias": "9texels", "shadow.resolution": 32})")["statistics"],
            first["statistics"]);
  ask(server, R"({"shadow.filter": "box", "shadow.filter-size": 5})");
  EXPECT_EQ(ask(server)["statistics"], first["statistics"]);
}

TEST_F(EvaluationServerGl, The_reference_of_ambient_occlusion_does_not_follow_the_radius) {
  const std::unique_ptr<Stages> stages = make_stages();
  EvaluationServer server(*stages, base({"truth.ao-distance=auto"}), SweptQuantity::ao);
  const Json first = ask(server);
  const Json other = ask(server, R"({"ao.radius": 0.6})");
  EXPECT_NE(first["statistics"]["mae"], other["statistics"]["mae"]);
  EXPECT_LT(first["statistics"]["mae_lo"], first["statistics"]["mae"]);
  EXPECT_GT(first["statistics"]["mae_hi"], first["statistics"]["mae"]);
  const std::uint64_t rays = stages->tracer().rays_traced();
  ask(server, R"({"ao.radius": 0.7})");
  EXPECT_EQ(stages->tracer().rays_traced(), rays);
}

TEST_F(EvaluationServerGl, A_wrong_request_says_what_is_wrong_and_the_next_one_is_measured) {
  const std::unique_ptr<Stages> stages = make_stages();
  EvaluationServer server(*stages, of_sun(), SweptQuantity::visibility);
  const auto error_of = [&](const std::string& request) {
    const std::string reply = server.reply(request);
    EXPECT_EQ(reply.find('\n'), std::string::npos);
    return Json::parse(reply).at("error").get<std::string>();
  };
  const auto error_at = [&](const std::string& parameters) {
    return error_of(R"({"id": "x", "request": "evaluate", "parameters": )" + parameters + "}");
  };
  const std::pair<std::string, std::string> cases[] = {
      {error_of("hello"), "no JSON object"},
      {error_of(""), "no JSON object"},
      {error_of("[1]"), "no JSON object"},
      {error_of(std::string(max_request + 1, '[')), "more than 1048576 bytes"},
      {error_of(std::string(200'000, '[')), "no JSON object"},
      {error_of(R"({"request": "describe"})"), "no 'id'"},
      {error_of(R"({"id": 1})"), "no 'request'"},
      {error_of(R"({"id": 1, "request": "measure"})"), "unknown request"},
      {error_of(R"({"id": 1, "request": ["evaluate"]})"), "unknown request"},
      {error_of(R"({"id": 1, "request": "evaluate", "parameter": {}})"), "unknown member 'parameter'"},
      {error_at("[]"), "no object"},
      {error_at(R"({"shadow.constant-bia": 1})"), "did you mean 'shadow.constant-bias'"},
      {error_at(R"({"shadow.constant-bias": null})"), "null is no value"},
      {error_at(R"({"shadow.constant-bias": "2 parsecs"})"), "'2 parsecs' is not allowed"},
      {error_at(R"({"shadow.constant-bias": 1e999})"), "no JSON object"},
      {error_at(R"({"shadow.resolution": 64.5})"), "an integer from 1 to 16384"},
      {error_at(R"({"shadow.filter": "boxx"})"), "expected nearest"},
      {error_at(R"({"shadow.filter-size": 3})"), "set shadow.filter to one of box"},
      {error_at(R"({"ao.radius": 1})"), "no effect on shadows"},
      {error_at(R"({"run.overlay": "bias"})"), "no effect on any measurement"},
      {error_at(R"({"scene.unit": "cm"})"), "start 'umbrameter serve' with --scene.unit"},
      {error_at(R"({"run.measure": "ao"})"), "start 'umbrameter serve' with --run.measure"},
      {error_at(R"({"view.light": "moon"})"), "moon"},
  };
  for (const auto& [error, part] : cases) EXPECT_NE(error.find(part), std::string::npos) << error;
  const Json refused = Json::parse(server.reply(R"({"id": "x", "request": "none"})"));
  EXPECT_EQ(refused["id"], "x");
  EXPECT_TRUE(Json::parse(server.reply("hello"))["id"].is_null());
  EXPECT_TRUE(ask(server).contains("statistics"));
}

TEST_F(EvaluationServerGl, Describe_says_what_is_measured_and_what_may_be_set) {
  const std::unique_ptr<Stages> stages = make_stages();
  Experiment given = of_sun({"run.metrics=psnr"});
  given.scene = "contact-box";
  EvaluationServer server(*stages, given, SweptQuantity::visibility);
  const auto has = [](const Json& list, const std::string& name) {
    return std::ranges::any_of(list, [&](const Json& each) { return each.at("name") == name; });
  };
  const Json described = ask(server, "{}", "describe");
  EXPECT_EQ(described["scene"], "contact-box");
  EXPECT_EQ(described["light"], "sun");
  EXPECT_EQ(described["measure"], "visibility");
  EXPECT_EQ(described["lights"].size(), 3u);
  EXPECT_EQ(described["lights"][0], Json::parse(R"({"name": "sun", "kind": "directional", "index": 0})"));
  EXPECT_EQ(described["objective"], "mae");
  // Its statistics are those of a reply.
  const Json measured = ask(server)["statistics"];
  ASSERT_EQ(described["statistics"].size(), measured.size());
  for (const Json& each : described["statistics"]) EXPECT_TRUE(measured.contains(each["name"].get<std::string>()));
  EXPECT_TRUE(has(described["statistics"], "psnr"));
  // Each of its parameters may be set to its value.
  EXPECT_TRUE(has(described["parameters"], "shadow.constant-bias"));
  EXPECT_FALSE(has(described["parameters"], "shadow.filter-size"));
  EXPECT_TRUE(has(ask(server, R"({"shadow.filter": "box"})", "describe")["parameters"], "shadow.filter-size"));
  Json values;
  for (const Json& each : described["parameters"]) values[each["name"].get<std::string>()] = each["value"];
  EXPECT_EQ(ask(server, values.dump())["statistics"], measured);
}

TEST_F(EvaluationServerGl, Shadows_of_several_lights_are_refused) {
  const std::unique_ptr<Stages> stages = make_stages();
  try {
    EvaluationServer server(*stages, base({}), SweptQuantity::visibility);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("3 lights"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace umbrameter
