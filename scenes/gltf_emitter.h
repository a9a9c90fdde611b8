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
/// Lengths in metres, the angle in radians; `shape` is "sphere" or "disk".
inline constexpr std::array<EmitterKey, 5> emitter_keys = {
    {{"radius", true}, {"width", true}, {"height", true}, {"angularDiameter", true}, {"shape", false}}};

/// Whether the extras say anything of an extent.
bool tells_emitter(const tinygltf::Value& extras);

/// The emitter that the extras give a light; a note where they give one that lights of its kind cannot have.
/// Fails, naming the object, where the sizes cannot be.
Emitter read_emitter(const tinygltf::Value& extras, const Light& light, const Document& document,
                     const std::string& object, std::vector<std::string>& notes);

/// What reads back as the light's emitter.
Members emitter_extras(const Light& light);

}  // namespace umbrameter::gltf
