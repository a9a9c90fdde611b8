#include "experiments/engine/engine_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "core/lists.h"
#include "reports/files/value_json.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_name = 40;
constexpr std::size_t max_text = 400;
constexpr std::size_t max_parameters = 500;
constexpr std::array<std::string_view, 4> type_names = {"number", "integer", "boolean", "choice"};

[[noreturn]] void reject(const std::string& what) { throw std::runtime_error(what); }

std::string shortened(std::string text) {
  if (text.size() > 60) text = text.substr(0, 60) + "...";
  return text;
}

Json reply_to(std::string_view line, int id) {
  const Json reply = Json::parse(line, nullptr, false);
  if (!reply.is_object()) reject("it wrote '" + shortened(std::string(line)) + "', which is no JSON object");
  const auto given = reply.find("id");
  if (given == reply.end() || *given != id) reject(fmt::format("its reply has not the id {} of the request", id));
  const auto error = reply.find("error");
  if (error == reply.end()) return reply;
  if (!error->is_string()) reject("its 'error' is no text");
  throw EngineRefusal{error->get<std::string>()};
}

std::string text_of(const Json& object, const char* key, bool is_required, std::size_t most = max_text) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (is_required) reject(fmt::format("'{}' is missing", key));
    return {};
  }
  if (!found->is_string()) reject(fmt::format("'{}' is no text", key));
  std::string text = found->get<std::string>();
  if (text.size() > most) reject(fmt::format("'{}' has more than {} bytes", key, most));
  if (is_required && text.empty()) reject(fmt::format("'{}' is empty", key));
  return text;
}

std::vector<std::string> texts_of(const Json& object, const char* key, bool is_required) {
  const auto found = object.find(key);
  if (found == object.end() && !is_required) return {};
  if (found == object.end() || !found->is_array()) reject(fmt::format("'{}' is no list", key));
  std::vector<std::string> texts;
  for (const Json& each : *found) {
    if (!each.is_string()) reject(fmt::format("'{}' holds what is no text", key));
    texts.push_back(each.get<std::string>().substr(0, max_text));
  }
  return texts;
}

double number_of(const Json& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  if (!found->is_number()) reject(fmt::format("'{}' is no number", key));
  return found->get<double>();
}

bool is_parameter_name(const std::string& name) {
  if (name.empty() || name.size() > max_name || name.front() < 'a' || name.front() > 'z') return false;
  if (name.back() == '-' || name.find("--") != std::string::npos) return false;
  return std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

std::size_t index_in(std::span<const std::string_view> names, const std::string& name, const std::string& what) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) reject(fmt::format("'{}' is no {}", shortened(name), what));
  return static_cast<std::size_t>(found - names.begin());
}

EngineParameter parameter_of(const Json& json) {
  if (!json.is_object()) reject("a parameter is no object");
  EngineParameter parameter;
  parameter.name = text_of(json, "name", true);
  if (!is_parameter_name(parameter.name) || parameter.name == "adapter") {
    reject(fmt::format("'{}' cannot be the name of a parameter", shortened(parameter.name)));
  }
  const auto reject_value = [&](const std::string& why) { reject("parameter " + parameter.name + ": " + why); };
  parameter.type = static_cast<EngineParameterType>(index_in(type_names, text_of(json, "type", true), "type"));
  parameter.meaning = text_of(json, "meaning", true);
  parameter.unit = text_of(json, "unit", false);
  parameter.min = number_of(json, "min", parameter.min);
  parameter.max = number_of(json, "max", parameter.max);
  parameter.choices = texts_of(json, "choices", parameter.type == EngineParameterType::choice);
  const std::string of = text_of(json, "for", false);
  if (!of.empty() && of != "shadow" && of != "ao") reject_value("'for' must be shadow or ao");
  parameter.is_of_ao = of == "ao";
  const std::string bias = text_of(json, "bias", false);
  if (!bias.empty() && bias != "up" && bias != "down") reject_value("'bias' must be up or down");
  const bool is_numeric =
      parameter.type == EngineParameterType::number || parameter.type == EngineParameterType::integer;
  if (!bias.empty() && (!is_numeric || parameter.is_of_ao)) reject_value("only a number of shadows can have 'bias'");
  parameter.bias = bias.empty() ? 0 : bias == "up" ? 1 : -1;
  if (parameter.type == EngineParameterType::choice) {
    const std::set<std::string> distinct(parameter.choices.begin(), parameter.choices.end());
    if (distinct.empty() || distinct.size() != parameter.choices.size()) reject_value("its choices are not distinct");
  }
  if (parameter.type == EngineParameterType::integer) {
    // Whole numbers of any size would be rounded on the way.
    parameter.min = std::max(parameter.min, static_cast<double>(std::numeric_limits<int>::min()));
    parameter.max = std::min(parameter.max, static_cast<double>(std::numeric_limits<int>::max()));
  }
  const auto found = json.find("default");
  if (found == json.end()) reject_value("'default' is missing");
  EngineParams one{{}, {}, {parameter}};
  try {
    Value value;
    if (found->is_boolean()) {
      value = found->get<bool>();
    } else if (found->is_string()) {
      value = found->get<std::string>();
    } else if (found->is_number() && parameter.type == EngineParameterType::integer) {
      const double number = found->get<double>();
      if (number != std::floor(number)) reject_value("its default is no whole number");
      value = static_cast<std::int64_t>(number);
    } else if (found->is_number()) {
      value = found->get<double>();
    } else {
      reject_value("its default is of no type that parameters have");
    }
    describe(one).back().set(value);
  } catch (const Error& error) {
    reject_value(std::string("its default does not fit: ") + error.what());
  }
  return one.parameters.front();
}

Json vector_json(const dvec3& v) { return {v.x, v.y, v.z}; }

Json matrix_json(const dmat4& matrix) {
  Json all = Json::array();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) all.push_back(matrix[column][row]);
  }
  return all;
}

Json camera_json(const Camera& camera) {
  Json json;
  if (const auto* parallel = std::get_if<OrthographicProjection>(&camera.projection)) {
    json = {{"kind", "orthographic"}, {"half_height", parallel->half_height}};
    json["near"] = parallel->near_plane;
    json["far"] = parallel->far_plane;
  } else {
    const auto& lens = std::get<PerspectiveProjection>(camera.projection);
    json = {{"kind", "perspective"}, {"vertical_fov", lens.vertical_fov}};
    json["near"] = lens.near_plane;
    json["far"] = lens.far_plane;
  }
  json["world_from_camera"] = matrix_json(camera.world_from_camera);
  return json;
}

Json light_json(const Light& light) {
  Json json = {{"kind", std::string(kind_of(light))},
               {"direction", vector_json(light.axis())},
               {"position", vector_json(light.position())},
               {"color", vector_json(dvec3(light.color))},
               {"intensity", light.intensity}};
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    json["range"] = spot->range;
    json["inner_cone"] = spot->inner_cone_angle;
    json["outer_cone"] = spot->outer_cone_angle;
  }
  if (const auto* point = std::get_if<PointLight>(&light.shape)) json["range"] = point->range;
  return json;
}

// What names nothing but a file in the folder.
bool is_plain_name(const std::string& name) {
  if (name.empty() || name.size() > 100 || name.front() == '.') return false;
  return std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  });
}

EngineFrameFiles frame_of(const Json& json, const std::vector<std::string>& outputs) {
  if (!json.is_object()) reject("a frame is no object");
  EngineFrameFiles frame;
  const auto files = json.find("files");
  if (files == json.end() || !files->is_object()) reject("a frame has no 'files'");
  for (const std::string& output : outputs) {
    const std::string name = text_of(*files, output.c_str(), true);
    if (!is_plain_name(name)) reject(fmt::format("'{}' is no plain file name", shortened(name)));
    frame.files.emplace(output, name);
  }
  frame.milliseconds = number_of(json, "milliseconds", 0.0);
  if (!(frame.milliseconds >= 0.0)) reject("'milliseconds' is below 0");
  frame.warnings = texts_of(json, "warnings", false);
  return frame;
}

}  // namespace

bool EngineDescription::writes(std::string_view output) const {
  return std::ranges::find(outputs, output) != outputs.end();
}

std::string describe_request(int id) {
  return json_text({{"id", id}, {"request", "describe"}, {"protocol", engine_protocol}});
}

std::string load_request(int id, const EngineLoad& load) {
  Json json = {{"id", id},
               {"request", "load"},
               {"scene", load.scene},
               {"folder", load.folder},
               {"width", load.view.width},
               {"height", load.view.height}};
  json["camera"] = camera_json(load.view.camera);
  json["light"] = light_json(load.light);
  json["bounds"] = {{"min", vector_json(load.bounds.min)}, {"max", vector_json(load.bounds.max)}};
  return json_text(json);
}

std::string render_request(int id, const std::vector<std::string>& outputs, std::span<const EngineParams> frames) {
  Json json = {{"id", id}, {"request", "render"}, {"outputs", outputs}};
  json["frames"] = Json::array();
  for (EngineParams frame : frames) {
    Json values = Json::object();
    const Parameters all = describe(frame);
    for (std::size_t i = 0; i < frame.parameters.size(); ++i) {
      values[frame.parameters[i].name] = to_json(all[all.size() - frame.parameters.size() + i].value());
    }
    json["frames"].push_back(std::move(values));
  }
  return json_text(json);
}

EngineDescription parse_description(std::string_view line, int id) {
  const Json reply = reply_to(line, id);
  const double protocol = number_of(reply, "protocol", 0.0);
  if (protocol != engine_protocol) {
    reject(fmt::format("it speaks protocol {}, not {}", protocol, engine_protocol));
  }
  EngineDescription engine;
  engine.name = text_of(reply, "name", true, 80);
  engine.version = text_of(reply, "version", false, 80);
  engine.renderer = text_of(reply, "renderer", false);
  engine.outputs = texts_of(reply, "outputs", true);
  for (const std::string& output : engine.outputs) index_in(engine_outputs, output, "output");
  const auto has = [&](std::string_view output) { return engine.writes(output); };
  const bool has_pairs = has("lit") == has("unshadowed") && has("occluded") == has("open");
  if (!has_pairs) reject("of its outputs lit and unshadowed, or occluded and open, one is missing");
  if (!has("visibility") && !has("lit") && !has("ao") && !has("occluded")) {
    reject("its outputs hold neither visibility nor ao");
  }
  engine.lights = texts_of(reply, "lights", true);
  engine.cameras = texts_of(reply, "cameras", false);
  if (engine.cameras.empty()) engine.cameras = {"perspective"};
  const std::string depth = text_of(reply, "depth", has("depth"));
  if (!depth.empty()) {
    engine.depth = static_cast<DepthConvention>(index_in(depth_conventions, depth, "kind of depth"));
  }
  const auto parameters = reply.find("parameters");
  if (parameters == reply.end() || !parameters->is_array()) reject("'parameters' is no list");
  if (parameters->size() > max_parameters) reject(fmt::format("it has more than {} parameters", max_parameters));
  std::set<std::string> names;
  for (const Json& each : *parameters) {
    engine.parameters.push_back(parameter_of(each));
    const std::string& name = engine.parameters.back().name;
    if (!names.insert(name).second) reject("two parameters are named " + name);
  }
  return engine;
}

std::vector<std::string> parse_loaded(std::string_view line, int id) {
  return texts_of(reply_to(line, id), "warnings", false);
}

std::vector<EngineFrameFiles> parse_frames(std::string_view line, int id, const std::vector<std::string>& outputs,
                                           std::size_t frames) {
  const Json reply = reply_to(line, id);
  const auto given = reply.find("frames");
  if (given == reply.end() || !given->is_array()) reject("'frames' is no list");
  if (given->size() != frames) reject(fmt::format("it rendered {} frames of {}", given->size(), frames));
  return mapped(*given, [&](const Json& each) { return frame_of(each, outputs); });
}

}  // namespace umbrameter
