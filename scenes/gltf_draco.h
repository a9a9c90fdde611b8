// KHR_draco_mesh_compression. The only door to the Draco decoder. Internal to scenes/gltf*.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/math.h"
#include "scenes/gltf_document.h"

namespace umbrameter::gltf {

struct DracoAttribute {
  int unique_id = 0;           ///< in the compressed data
  std::size_t components = 0;  ///< wanted
};

struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<uvec3> triangles;
  std::map<std::string, std::vector<float>> attributes;  ///< `components` floats a vertex
};

/// Decodes one triangle mesh of bitstream version 2.2, and of its attributes those that are asked for by name.
/// Fails, naming the object, where the data is damaged or an attribute is not in it.
DracoMesh decode_draco(std::span<const unsigned char> bytes, const std::map<std::string, DracoAttribute>& wanted,
                       Allowance& allowance, const std::filesystem::path& path, const std::string& object);

}  // namespace umbrameter::gltf
