#include "experiments/serve/evaluation_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "experiments/sweep/axis_effects.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "experiments/sweep/sweep_table.h"
#include "reports/files/value_json.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr int protocol = 1;
constexpr std::array<std::string_view, 3> members = {"id", "request", "parameters"};

Error wrong(const std::string& what, const std::string& why, const std::string& remedy = {}) {
  return {ExitCode::usage, what, why, remedy};
}

// What a process is started with: the scene, what is measured, and who draws.
bool is_fixed(std::string_view key) {
  return key.starts_with("scene.") || key.starts_with("frame.") || key == "view.scene" || key == "run.measure" ||
         key == "run.metrics" || key == engine_key;
}

Value value_of(const std::string& key, const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  throw wrong(key, fmt::format("{} is no value of a parameter", json.dump()), "give a number, a text, true or false");
}

Experiment with_values(Experiment experiment, SweptQuantity quantity, const Json& values) {
  if (!values.is_object()) {
    throw wrong("parameters", "they are no object", R"(write {"shadow.constant-bias": 0.02})");
  }
  const Parameters parameters = describe(experiment);
  for (const auto& [key, value] : values.items()) {
    const Parameter& parameter = require(parameters, key);
    if (is_fixed(key)) {
      throw wrong(key, "it is fixed while the process runs", fmt::format("start 'umbrameter serve' with --{}", key));
    }
    parameter.set(value_of(key, value));
  }
  for (const auto& [key, value] : values.items()) require_read(quantity, experiment, key);
  return experiment;
}

// The one light whose shadow is measured.
std::uint32_t light_of(const Stages& stages, const Experiment& experiment) {
  const std::vector<std::uint32_t> lights = stages.lights(experiment.view.light);
  if (lights.size() == 1) return lights.front();
  throw wrong("view.light", fmt::format("the scene has {} lights, and a shadow of one is measured", lights.size()),
              fmt::format("select it by --light, such as --light '{}'", stages.title(lights.front())));
}

Json describe_point(Stages& stages, Experiment experiment, SweptQuantity quantity) {
  Json reply = {{"protocol", protocol},
                {"version", UMBRAMETER_VERSION},
                {"scene", scene_title(experiment)},
                {"renderer", stages.renderer()},
                {"measure", quantity_name(quantity)}};
  if (quantity == SweptQuantity::visibility) reply["light"] = stages.title(light_of(stages, experiment));
  reply["lights"] = Json::array();
  for (std::uint32_t light = 0; light < stages.scene().lights.size(); ++light) {
    reply["lights"].push_back(
        {{"name", stages.title(light)}, {"kind", kind_of(stages.scene().lights[light])}, {"index", light}});
  }
  const Experiment measured = stages.in_metres(experiment);
  reply["objective"] = error_statistic;
  reply["statistics"] = Json::array();
  for (const Column& column : measured_columns(measured, choose_statistics(stages, measured, {}, quantity))) {
    reply["statistics"].push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
  }
  reply["parameters"] = Json::array();
  for (const Parameter& parameter : describe(experiment)) {
    if (is_fixed(parameter.key) || !is_read(quantity, experiment, parameter.key)) continue;
    reply["parameters"].push_back(to_json(parameter, "value"));
  }
  return reply;
}

Json parse_request(const std::string& text) {
  if (text.size() > max_request) throw wrong("request", fmt::format("it has more than {} bytes", max_request));
  Json request = Json::parse(text, nullptr, false);
  if (!request.is_object()) throw wrong("request", "it is no JSON object", "write one object a line");
  return request;
}

void check_members(const Json& request) {
  for (const char* member : {"id", "request"}) {
    if (!request.contains(member)) throw wrong("request", fmt::format("it has no '{}'", member));
  }
  for (const auto& [name, value] : request.items()) {
    if (std::ranges::find(members, name) != members.end()) continue;
    throw wrong("request", fmt::format("unknown member '{}'", name), "use id, request and parameters");
  }
}

}  // namespace

EvaluationServer::EvaluationServer(Stages& stages, Experiment experiment, SweptQuantity quantity)
    : stages_(stages), given_(std::move(experiment)), quantity_(quantity) {
  given_.axes.clear();
  given_.run.measure = quantity == SweptQuantity::ao      ? SweepMeasure::ao
                       : quantity == SweptQuantity::image ? SweepMeasure::image
                                                          : SweepMeasure::visibility;
  if (given_.truth.ao_distance.unit == LengthUnit::automatic) given_.truth.ao_distance = given_.ao.sampling.radius;
  measure(given_);
  stages_.report_tracing([](double) {});  // requests show no bars
}

Table EvaluationServer::measure(const Experiment& experiment) {
  if (quantity_ == SweptQuantity::visibility) stages_.check_is_meaningful(experiment, {light_of(stages_, experiment)});
  if (quantity_ == SweptQuantity::image) {
    stages_.check_is_meaningful(experiment, stages_.lights(experiment.view.light));
  }
  return sweep_table(stages_, experiment, {});
}

std::string EvaluationServer::reply(const std::string& text) {
  Json reply = {{"id", nullptr}};
  try {
    const Json request = parse_request(text);
    if (request.contains("id")) reply["id"] = request["id"];
    check_members(request);
    const Experiment experiment =
        with_values(given_, quantity_, request.contains("parameters") ? request["parameters"] : Json::object());
    if (request["request"] == "describe") {
      reply.update(describe_point(stages_, experiment, quantity_));
    } else if (request["request"] == "evaluate") {
      const auto start = std::chrono::steady_clock::now();
      const Table measured = measure(experiment);
      const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
      reply["statistics"] = row_json(measured.columns, measured.rows.front());
      reply["milliseconds"] = time.count();
    } else {
      throw wrong("request", "unknown request", "use describe or evaluate");
    }
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
    reply = {{"id", reply["id"]}, {"error", error.what()}};
  } catch (const std::bad_alloc&) {
    reply = {{"id", reply["id"]}, {"error", "out of memory; use a smaller view.size or shadow.resolution"}};
  }
  return json_text(reply);
}

}  // namespace umbrameter
