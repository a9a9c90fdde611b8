#include "scenes/gltf_emitter.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "scenes/emitter.h"

namespace umbrameter::gltf {
namespace {

// What the extras of a light and of its node say together.
struct Extras {
  const tinygltf::Value& of_light;
  const tinygltf::Value& of_node;

  // Null where neither has it, and where the node has another extent that rules out the light's.
  const tinygltf::Value* find(const EmitterKey& key, std::initializer_list<EmitterKey> rivals) const {
    if (of_node.Has(key.name)) return &of_node.Get(key.name);
    const bool is_ruled_out =
        std::ranges::any_of(rivals, [&](const EmitterKey& rival) { return of_node.Has(rival.name); });
    return of_light.Has(key.name) && !is_ruled_out ? &of_light.Get(key.name) : nullptr;
  }
  std::optional<double> number(const EmitterKey& key, std::initializer_list<EmitterKey> rivals) const {
    const tinygltf::Value* const found = find(key, rivals);
    return found == nullptr ? std::nullopt : std::optional(found->GetNumberAsDouble());
  }
};

}  // namespace

Emitter read_emitter(const tinygltf::Value& of_light, const tinygltf::Value& of_node, const Light& light,
                     const Document& document, const std::string& object, std::vector<std::string>& notes) {
  const Extras extras{of_light, of_node};
  const auto sides = {width_key, height_key};
  EmitterSizes sizes{extras.number(radius_key, sides), extras.number(width_key, {radius_key}),
                     extras.number(height_key, {radius_key}), extras.number(angle_key, {})};
  const std::string remedy = "correct the extras of the light or of its node";
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  const tinygltf::Value* const named = extras.find(shape_key, sides);
  if (named != nullptr) {
    const std::string& shape = named->Get<std::string>();
    if (shape != "sphere" && shape != "disk") {
      fail(document.path, object, "its shape '" + shape.substr(0, 60) + "' is neither sphere nor disk", remedy);
    }
    if (!sizes.radius && !is_directional) fail(document.path, object, "it has a shape and no radius", remedy);
    sizes.shape = shape == "disk" ? EmitterShape::disk : EmitterShape::sphere;
  }
  const std::string why = objection(sizes);
  if (!why.empty()) fail(document.path, object, why, remedy);
  if (is_directional && (sizes.has_lengths() || named != nullptr)) {
    notes.push_back(object + ": a directional light has no radius, shape or sides; only its " + angle_key.name +
                    " counts");
  }
  if (!is_directional && sizes.angular_diameter) {
    notes.push_back(object + ": only a directional light has an " + angle_key.name + "; it was left out");
  }
  return make_emitter(light, sizes);
}

Members emitter_extras(const Light& light) {
  if (const auto* sphere = std::get_if<SphereEmitter>(&light.emitter)) {
    return {{radius_key.name, to_json(sphere->radius)}, {shape_key.name, to_json(std::string_view("sphere"))}};
  }
  if (const auto* disk = std::get_if<DiskEmitter>(&light.emitter)) {
    return {{radius_key.name, to_json(disk->radius)}, {shape_key.name, to_json(std::string_view("disk"))}};
  }
  if (const auto* rectangle = std::get_if<RectangleEmitter>(&light.emitter)) {
    return {{width_key.name, to_json(rectangle->width)}, {height_key.name, to_json(rectangle->height)}};
  }
  if (const auto* distant = std::get_if<DistantEmitter>(&light.emitter)) {
    return {{angle_key.name, to_json(distant->angular_diameter)}};
  }
  return {};
}

}  // namespace umbrameter::gltf
