// glTF materials to Scene materials. Internal to scenes/gltf*.cpp.
#pragma once

#include <vector>

#include "core/math.h"
#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace umbrameter::gltf {

/// Which texture coordinates a material reads, and how they are moved first (KHR_texture_transform).
struct TexcoordUse {
  int set = 0;
  bool is_moved = false;
  vec2 offset{0.0f};
  float rotation = 0.0f;  ///< radians, counter-clockwise
  vec2 scale{1.0f};
};
vec2 moved(const TexcoordUse& use, const vec2& texcoord);

/// Appends the materials of the file, and the textures of their base colours; one entry a material.
std::vector<TexcoordUse> read_materials(BufferStore& store, Scene& scene);

}  // namespace umbrameter::gltf
