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

/// The base colour texture of a material. −1: none.
struct TextureReference {
  int texture = -1;
  TexcoordUse use;
};

/// Appends the materials of the file, without their textures; one entry a material.
std::vector<TextureReference> read_materials(const Document& document, Scene& scene);

/// Decodes the textures of the materials that meshes of the scene have, and sets them. A texture whose image is of a
/// format that is not read, or is not there, is left out with a note, but an error where its alpha makes holes.
void read_textures(BufferStore& store, const std::vector<TextureReference>& references, bool blend_makes_holes,
                   Scene& scene);

}  // namespace umbrameter::gltf
