// glTF meshes to Scene meshes. Internal to scenes/gltf*.cpp.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace umbrameter::gltf {

/// Where the primitives of each glTF mesh stand in Scene::meshes.
struct Geometry {
  std::vector<std::vector<std::uint32_t>> meshes_of;  ///< per glTF mesh
  std::vector<std::string> names;                     ///< per glTF mesh
};

/// Appends every primitive of the file to scene.meshes, equal ones once, and notes to scene.notes.
/// scene.materials must be read; a primitive without one appends the default material.
Geometry read_geometry(BufferStore& store, Scene& scene);

/// Reads the materials, and the textures of their base colours.
void read_materials(BufferStore& store, Scene& scene);

}  // namespace umbrameter::gltf
