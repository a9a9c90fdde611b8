#include "present/scene_report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees = 180.0 / pi;

Json vector(const dvec3& v) { return {v.x, v.y, v.z}; }
Json range(double metres) { return metres > 0.0 ? Json(metres) : Json(nullptr); }

Json camera_json(const Camera& camera) {
  Json json;
  json["name"] = camera.name;
  json["kind"] = kind_of(camera);
  json["position_m"] = vector(dvec3(camera.world_from_camera[3]));
  json["direction"] = vector(-glm::normalize(dvec3(camera.world_from_camera[2])));
  if (const auto* lens = std::get_if<PerspectiveProjection>(&camera.projection)) {
    json["vertical_fov_deg"] = lens->vertical_fov * degrees;
    json["near_m"] = lens->near_plane;
    json["far_m"] = lens->far_plane;  // null where it is infinite
  } else {
    const auto& parallel = std::get<OrthographicProjection>(camera.projection);
    json["half_width_m"] = parallel.half_width;
    json["half_height_m"] = parallel.half_height;
    json["near_m"] = parallel.near_plane;
    json["far_m"] = parallel.far_plane;
  }
  return json;
}

Json light_json(const Light& light) {
  Json json;
  json["name"] = light.name;
  json["kind"] = kind_of(light);
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  json["intensity"] = light.intensity;
  json["intensity_unit"] = is_directional ? "lx" : "cd";
  json["color"] = {light.color.x, light.color.y, light.color.z};
  if (!is_directional) json["position_m"] = vector(light.position());
  if (!std::holds_alternative<PointLight>(light.shape)) json["direction"] = vector(light.axis());
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    json["range_m"] = range(spot->range);
    json["inner_cone_deg"] = spot->inner_cone_angle * degrees;
    json["outer_cone_deg"] = spot->outer_cone_angle * degrees;
  }
  if (const auto* point = std::get_if<PointLight>(&light.shape)) json["range_m"] = range(point->range);
  json["extent"] = to_json(light.emitter);
  return json;
}

Json material_json(const Material& material) {
  static constexpr const char* modes[] = {"opaque", "mask", "blend"};
  Json json;
  json["name"] = material.name;
  json["alpha_mode"] = modes[static_cast<int>(material.alpha_mode)];
  if (material.alpha_mode == AlphaMode::mask) json["alpha_cutoff"] = material.alpha_cutoff;
  json["double_sided"] = material.double_sided;
  json["base_color"] = {material.base_color.x, material.base_color.y, material.base_color.z, material.base_color.w};
  json["base_color_texture"] = material.base_color_texture ? Json(*material.base_color_texture) : Json(nullptr);
  json["metallic"] = material.metallic;
  json["roughness"] = material.roughness;
  json["specular"] = material.specular;
  json["specular_color"] = {material.specular_color.x, material.specular_color.y, material.specular_color.z};
  return json;
}

Json texture_json(const Texture& texture) {
  return {{"name", texture.name},
          {"width", texture.texels.width},
          {"height", texture.texels.height},
          {"bytes", texture.texels.size() * sizeof(glm::u8vec4)}};
}

Json units_json(const UnitGuess& guess, const std::string& unit) {
  static constexpr const char* verdicts[] = {"credible", "doubtful", "implausible"};
  Json json;
  json["assumed"] = unit;
  json["verdict"] = verdicts[static_cast<int>(guess.verdict)];
  json["longest_side_m"] = guess.longest_side;
  if (guess.verdict == SizeVerdict::credible) return json;
  json["reason"] = guess.reason;
  json["likely"] = guess.candidates.empty() ? Json(nullptr) : Json(guess.candidates.front().unit);
  json["candidates"] = Json::array();
  for (const UnitCandidate& candidate : guess.candidates) {
    json["candidates"].push_back(
        {{"unit", candidate.unit}, {"scale_to_m", candidate.metres}, {"longest_side_m", candidate.longest_side}});
  }
  return json;
}

Json bytes_json(const SceneBytes& bytes) {
  return {{"known", "computed"},          {"vertices", bytes.vertices}, {"indices", bytes.indices},
          {"instances", bytes.instances}, {"textures", bytes.textures}, {"total", bytes.total()}};
}

template <class T>
Json list(const std::vector<T>& items, Json (*to_json)(const T&)) {
  Json json = Json::array();
  for (const T& item : items) json.push_back(to_json(item));
  return json;
}

}  // namespace

const char* kind_of(const Camera& camera) {
  return std::holds_alternative<PerspectiveProjection>(camera.projection) ? "perspective" : "orthographic";
}

Json to_json(const Emitter& emitter) {
  if (std::holds_alternative<std::monostate>(emitter)) return nullptr;
  Json json;
  json["kind"] = kind_of(emitter);
  if (const auto* sphere = std::get_if<SphereEmitter>(&emitter)) json["radius_m"] = sphere->radius;
  if (const auto* disk = std::get_if<DiskEmitter>(&emitter)) json["radius_m"] = disk->radius;
  if (const auto* rectangle = std::get_if<RectangleEmitter>(&emitter)) {
    json["width_m"] = rectangle->width;
    json["height_m"] = rectangle->height;
  }
  if (const auto* distant = std::get_if<DistantEmitter>(&emitter)) {
    json["angular_diameter_deg"] = distant->angular_diameter * degrees;
  }
  return json;
}

Json to_json(const SceneReport& report) {
  Json json;
  json["name"] = report.source;
  json["scene"] = report.scene.name;
  json["triangles"] = report.counts.triangles;
  json["stored_triangles"] = report.counts.stored_triangles;
  json["vertices"] = report.counts.vertices;
  json["meshes"] = report.scene.meshes.size();
  json["instances"] = report.scene.instances.size();
  json["objects"] = report.scene.objects.size();
  if (!report.bounds.empty()) {
    json["bounds_m"] = {vector(report.bounds.min), vector(report.bounds.max)};
    json["extent_m"] = vector(report.bounds.extent());
    json["origin_m"] = vector(report.scene.origin);
  }
  json["units"] = units_json(report.units, report.unit);
  json["cameras"] = list(report.scene.cameras, camera_json);
  json["lights"] = list(report.scene.lights, light_json);
  json["materials"] = list(report.scene.materials, material_json);
  json["textures"] = list(report.scene.textures, texture_json);
  json["memory"] = {
      {"scene", bytes_json(report.memory)},
      {"gpu", bytes_json(report.gpu)},
      {"tracer",
       {{"known", report.tracer_bytes ? Json("measured") : Json(nullptr)},
        {"total", report.tracer_bytes ? Json(*report.tracer_bytes) : Json(nullptr)}}},
      {"load", {{"known", "measured"}, {"seconds", report.load_seconds}, {"peak_resident", report.peak_resident}}}};
  json["notes"] = report.scene.notes;
  return json;
}

}  // namespace umbrameter
