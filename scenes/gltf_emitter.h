// The extent of a light in a glTF file: members of the extras of its node, or of the light itself.
// Internal to scenes/gltf*.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/gltf_json.h"
#include "scenes/scene.h"

namespace tinygltf {
class Value;
}

namespace umbrameter::gltf {

struct EmitterKey {
  const char* name;
  bool is_number;
};
/// Lengths in metres, the angle in radians; the shape is "sphere" or "disk".
inline constexpr EmitterKey radius_key{"radius", true};
inline constexpr EmitterKey width_key{"width", true};
inline constexpr EmitterKey height_key{"height", true};
inline constexpr EmitterKey angle_key{"angularDiameter", true};
inline constexpr EmitterKey shape_key{"shape", false};
inline constexpr std::array<EmitterKey, 5> emitter_keys = {radius_key, width_key, height_key, angle_key, shape_key};

/// The emitter that the extras of a light and of its node give it; a note where they give one that lights of its kind
/// cannot have. Members of the node win, and a radius there over sides of the light, or sides over a radius.
/// Fails, naming the object, where the sizes cannot be.
Emitter read_emitter(const tinygltf::Value& of_light, const tinygltf::Value& of_node, const Light& light,
                     const Document& document, const std::string& object, std::vector<std::string>& notes);

/// What reads back as the light's emitter.
Members emitter_extras(const Light& light);

}  // namespace umbrameter::gltf
