#include "experiments/serve/own_adapter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "experiments/engine/engine_protocol.h"
#include "experiments/settings/sweep_plan.h"
#include "experiments/stages/stages.h"
#include "reports/files/exr.h"
#include "reports/files/value_json.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const Parameter& parameter) {
  std::string name = parameter.key;
  std::ranges::replace(name, '.', '-');
  return name;
}

// What an engine with an adapter could set: those of the techniques, but for texts and sizes.
Parameters offered(Experiment& experiment) {
  Parameters all = concatenate({describe(experiment.shadow), describe(experiment.ao)});
  std::erase_if(all, [](const Parameter& parameter) {
    const auto* const* length = std::get_if<Length*>(&parameter.field);
    return std::holds_alternative<std::string*>(parameter.field) || std::holds_alternative<Size*>(parameter.field) ||
           (length != nullptr && (*length)->unit == LengthUnit::automatic);
  });
  return all;
}

Json parameter_json(const Parameter& parameter) {
  const FieldDescription& description = parameter.description;
  Json json = {{"name", name_of(parameter)}, {"meaning", description.meaning}};
  json["unit"] = description.unit;
  json["for"] = parameter.key.starts_with("ao.") ? "ao" : "shadow";
  if (parameter.key == constant_bias_key || parameter.key == slope_bias_key) json["bias"] = "up";
  if (const auto* const* length = std::get_if<Length*>(&parameter.field)) {
    json["type"] = "number";
    json["default"] = (*length)->number;
    json["unit"] = std::string(unit_name((*length)->unit));
  } else if (const auto* choice = std::get_if<ChoiceRef>(&parameter.field)) {
    json["type"] = "choice";
    json["default"] = to_string(parameter.value());
    json["choices"] = choice->names;
  } else if (std::holds_alternative<bool*>(parameter.field)) {
    json["type"] = "boolean";
    json["default"] = to_json(parameter.value());
  } else {
    json["type"] = std::holds_alternative<int*>(parameter.field) ? "integer" : "number";
    json["default"] = to_json(parameter.value());
  }
  if (!std::holds_alternative<Length*>(parameter.field)) {
    if (std::isfinite(description.min)) json["min"] = description.min;
    if (std::isfinite(description.max)) json["max"] = description.max;
  }
  return json;
}

void set(const Parameter& parameter, const Json& value) {
  if (Length* const* length = std::get_if<Length*>(&parameter.field)) {
    (*length)->number = value.get<double>();
    parameter.set_text(to_string(**length));  // holds it against its limits
  } else if (value.is_string()) {
    parameter.set(value.get<std::string>());
  } else if (value.is_boolean()) {
    parameter.set(value.get<bool>());
  } else if (std::holds_alternative<int*>(parameter.field)) {
    parameter.set(static_cast<std::int64_t>(value.get<double>()));
  } else {
    parameter.set(value.get<double>());
  }
}

Json describe_reply(Experiment defaults) {
  Json reply = {{"protocol", engine_protocol}, {"name", "umbrameter"}, {"version", UMBRAMETER_VERSION}};
  reply["outputs"] = {"visibility", "ao", "position", "depth", "normal"};
  reply["depth"] = "axis";
  reply["lights"] = {"directional", "spot", "point"};
  reply["cameras"] = {"perspective", "orthographic"};
  reply["parameters"] = Json::array();
  for (const Parameter& parameter : offered(defaults)) reply["parameters"].push_back(parameter_json(parameter));
  return reply;
}

template <class Pixel>
Image<Pixel> without_background(Image<Pixel> image, const GBuffer& gbuffer) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!gbuffer.is_surface(i)) image[i] = Pixel(std::numeric_limits<float>::quiet_NaN());
  }
  return image;
}

LayeredImage drawn(Stages& stages, const Experiment& experiment, const std::string& output) {
  const auto surfels = stages.surfels(experiment);
  const GBuffer& gbuffer = surfels->gbuffer;
  LayeredImage image;
  const auto add = [&](const Image<float>& values) { image.channels.push_back({"Y", values}); };
  const auto add_vectors = [&](const Image<vec3>& vectors) {
    for (int c = 0; c < 3; ++c) {
      Image<float> values(vectors.width, vectors.height, 0.0f);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = vectors[i][c];
      image.channels.push_back({std::string(1, "RGB"[c]), std::move(values)});
    }
  };
  if (output == "visibility") {
    add(stages.draw(experiment, 0, false).visibility);
  } else if (output == "ao") {
    add(stages.draw_ao(experiment));
  } else if (output == "depth") {
    add(without_background(gbuffer.depth, gbuffer));
  } else if (output == "position") {
    add_vectors(without_background(gbuffer.position, gbuffer));
  } else if (output == "normal") {
    add_vectors(without_background(gbuffer.shading_normal, gbuffer));
  } else {
    throw std::runtime_error("there is no output '" + output + "'");
  }
  return image;
}

}  // namespace

OwnAdapter::OwnAdapter(std::string gl_device, int threads) : gl_device_(std::move(gl_device)), threads_(threads) {
  use_engine({});
  defaults_ = Experiment();
  defaults_.view.surfels = SurfelSource::traced;
}

OwnAdapter::~OwnAdapter() = default;

std::string OwnAdapter::reply(const std::string& request) {
  Json reply = Json::object();
  try {
    const Json asked = Json::parse(request);
    reply["id"] = asked.at("id");
    const std::string kind = asked.at("request");
    if (kind == "describe") {
      reply.update(describe_reply(defaults_));
    } else if (kind == "load") {
      stages_.reset();
      Scene scene = load_scene(asked.at("scene").get<std::string>());
      if (scene.cameras.size() != 1 || scene.lights.size() != 1) {
        throw std::runtime_error("the scene needs one camera and one light");
      }
      folder_ = asked.at("folder").get<std::string>();
      defaults_.view.size = {asked.at("width"), asked.at("height")};
      stages_ =
          std::make_unique<Stages>(std::move(scene), StageOptions{gl_device_, threads_}, Console{true, true, false});
    } else if (kind == "render") {
      if (!stages_) throw std::runtime_error("nothing is loaded");
      const std::vector<std::string> outputs = asked.at("outputs");
      reply["frames"] = Json::array();
      for (std::size_t number = 0; number < asked.at("frames").size(); ++number) {
        const Json& values = asked.at("frames")[number];
        Experiment experiment = defaults_;
        for (const Parameter& parameter : offered(experiment)) {
          if (values.contains(name_of(parameter))) set(parameter, values.at(name_of(parameter)));
        }
        experiment = stages_->in_metres(experiment);
        Json files = Json::object();
        for (const std::string& output : outputs) {
          const std::string name = fmt::format("{}-{}.exr", number, output);
          write_exr(folder_ / name, drawn(*stages_, experiment, output));
          files[output] = name;
        }
        reply["frames"].push_back({{"files", files}});
      }
    } else {
      throw std::runtime_error("there is no request '" + kind + "'");
    }
  } catch (const std::exception& error) {
    Json refusal = {{"error", error.what()}};
    if (reply.contains("id")) refusal["id"] = reply["id"];
    reply = refusal;
  }
  return json_text(reply);
}

}  // namespace umbrameter
