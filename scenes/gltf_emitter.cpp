#include "scenes/gltf_emitter.h"

#include <tiny_gltf.h>

#include <algorithm>

#include "scenes/emitter.h"

namespace umbrameter::gltf {
namespace {

std::optional<double> number(const tinygltf::Value& extras, const char* key) {
  if (!extras.Has(key)) return std::nullopt;
  return extras.Get(key).GetNumberAsDouble();
}

}  // namespace

bool tells_emitter(const tinygltf::Value& extras) {
  return extras.IsObject() && std::any_of(emitter_keys.begin(), emitter_keys.end(),
                                          [&](const EmitterKey& key) { return extras.Has(key.name); });
}

Emitter read_emitter(const tinygltf::Value& extras, const Light& light, const Document& document,
                     const std::string& object, std::vector<std::string>& notes) {
  if (!tells_emitter(extras)) return {};
  EmitterSizes sizes{number(extras, "radius"), number(extras, "width"), number(extras, "height"),
                     number(extras, "angularDiameter")};
  const std::string remedy = "mend the extras of the light or of its node";
  if (extras.Has("shape")) {
    const std::string& shape = extras.Get("shape").Get<std::string>();
    if (shape != "sphere" && shape != "disk") {
      fail(document.path, object, "its shape '" + shape.substr(0, 60) + "' is neither sphere nor disk", remedy);
    }
    sizes.shape = shape == "disk" ? EmitterShape::disk : EmitterShape::sphere;
  }
  const std::string why = objection(sizes);
  if (!why.empty()) fail(document.path, object, why, remedy);
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  if (is_directional && sizes.has_lengths()) {
    notes.push_back(object + ": a directional light has no radius or sides; only its angularDiameter counts");
  }
  if (!is_directional && sizes.angular_diameter) {
    notes.push_back(object + ": only a directional light has an angularDiameter; it was left out");
  }
  return make_emitter(light, sizes);
}

Members emitter_extras(const Light& light) {
  if (const auto* sphere = std::get_if<SphereEmitter>(&light.emitter)) {
    return {{"radius", to_json(sphere->radius)}, {"shape", to_json(std::string_view("sphere"))}};
  }
  if (const auto* disk = std::get_if<DiskEmitter>(&light.emitter)) {
    return {{"radius", to_json(disk->radius)}, {"shape", to_json(std::string_view("disk"))}};
  }
  if (const auto* rectangle = std::get_if<RectangleEmitter>(&light.emitter)) {
    return {{"width", to_json(rectangle->width)}, {"height", to_json(rectangle->height)}};
  }
  if (const auto* distant = std::get_if<DistantEmitter>(&light.emitter)) {
    return {{"angularDiameter", to_json(distant->angular_diameter)}};
  }
  return {};
}

}  // namespace umbrameter::gltf
