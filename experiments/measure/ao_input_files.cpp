#include "experiments/measure/ao_input_files.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// Row by row.
Json to_json(const dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
  }
  return rows;
}

Json to_json(const Parameters& parameters) {
  Json object = Json::object();
  for (const Parameter& parameter : parameters) {
    object[parameter.key] = std::visit([](const auto& value) { return Json(value); }, parameter.value());
  }
  return object;
}

// The first components of each.
Json to_json(std::span<const vec4> values, int components) {
  Json list = Json::array();
  for (const vec4& value : values) {
    Json& numbers = list.emplace_back(Json::array());
    for (int i = 0; i < components; ++i) numbers.push_back(value[i]);
  }
  return list;
}

}  // namespace

LayeredImage ao_input_layers(Stages& stages, const Experiment& experiment) {
  const auto surfels = stages.surfels(experiment);
  const GBuffer& gbuffer = surfels->gbuffer;
  const AoSurfelImages read = stages.read_ao_surfels(experiment);
  const dmat4 view_from_world = umbrameter::view_from_world(surfels->view);
  Image<vec3> positions(gbuffer.width, gbuffer.height, vec3(std::numeric_limits<float>::quiet_NaN()));
  Image<vec3> normals(gbuffer.width, gbuffer.height, vec3(0.0f));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    // As the shaders do: products in double precision, results in single precision.
    positions[i] = vec3(view_from_world * dvec4(dvec3(gbuffer.position[i]), 1.0));
    normals[i] = glm::normalize(vec3(dmat3(view_from_world) * dvec3(read.normals[i])));
  }
  LayeredImage file;
  add_layer(file, "depth", read.depth);
  add_layer(file, "position", positions);
  add_layer(file, "normal", normals);
  return file;
}

std::string ao_input_values(Stages& stages, const Experiment& experiment) {
  const auto surfels = stages.surfels(experiment);
  const View& view = surfels->view;
  AoParams params = experiment.ao;
  AoTechnique technique = make_technique(params);
  const auto seed = static_cast<std::uint32_t>(experiment.run.seed);
  Json read = Json::array();
  for (const Parameter& parameter : describe(technique)) read.push_back(parameter.key);
  const Json object = {
      {"image", ao_input_image_file},
      {"size", {view.width, view.height}},
      {"is_orthographic", std::holds_alternative<OrthographicProjection>(view.camera.projection)},
      {"view_from_world", to_json(view_from_world(view))},
      {"clip_from_view", to_json(clip_from_view(view))},
      {"seed", seed},
      {"parameters", to_json(describe(params))},
      {"read_by_technique", read},
      {"kernel", to_json(kernel_of(technique, seed), 3)},
      {"noise_size", params.noise.size},
      {"noise", to_json(noise_of(technique, seed), 2)},
  };
  return object.dump(2) + "\n";
}

}  // namespace umbrameter
