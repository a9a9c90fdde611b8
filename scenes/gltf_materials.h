// glTF materials to Scene materials. Internal to scenes/gltf*.cpp.
#pragma once

#include <array>
#include <vector>

#include "core/math.h"
#include "scenes/gltf_document.h"
#include "scenes/load_options.h"
#include "scenes/material.h"
#include "scenes/scene.h"

namespace umbrameter::gltf {

/// Which texture coordinates a material reads, and how they are moved first (KHR_texture_transform).
struct TexcoordUse {
  int set = 0;
  bool is_moved = false;
  vec2 offset{0.0f};
  float rotation = 0.0f;  ///< radians, counter-clockwise
  vec2 scale{1.0f};

  friend bool operator==(const TexcoordUse&, const TexcoordUse&) = default;
};
vec2 moved(const TexcoordUse& use, const vec2& texcoord);

/// A texture of a material. −1: none.
struct TextureReference {
  int texture = -1;
  TexcoordUse use;
};

/// In the order of texture_members.
using TextureReferences = std::array<TextureReference, texture_members.size()>;

/// The texture coordinates of a material, which all its textures share: those of its first texture.
TexcoordUse texcoords_of(const TextureReferences& references);

/// Appends the materials of the file, without their textures; one entry a material. References other than those of
/// base colours are there only with LoadOptions::materials.
std::vector<TextureReferences> read_materials(const Document& document, const LoadOptions& options, Scene& scene);

/// Decodes the textures of the materials that meshes of the scene have, and sets them. A texture whose image is of a
/// format that is not read, or is not there, is left out with a note, but an error where its alpha makes holes. A
/// texture whose coordinates are not those of the material's first one is left out with a note.
void read_textures(BufferStore& store, const std::vector<TextureReferences>& references, bool blend_makes_holes,
                   Scene& scene);

}  // namespace umbrameter::gltf
