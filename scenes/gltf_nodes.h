// The node tree of a glTF file: what stands where. Internal to scenes/gltf*.cpp.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/gltf_geometry.h"
#include "scenes/scene.h"

namespace tinygltf {
struct Camera;
struct Light;
}  // namespace tinygltf

namespace umbrameter::gltf {

/// Appends everything that the nodes of one scene of the file hold; `part` selects it by name or index.
/// Throws Error (usage) when the file has no such scene.
void read_nodes(GeometryReader& geometry, const std::string& part);

/// `object` names it in messages.
Camera read_camera(const tinygltf::Camera& source, const std::string& node_name, const dmat4& transform,
                   const Document& document, const std::string& object);
Light read_light(const tinygltf::Light& source, const dmat4& transform, const Document& document,
                 const std::string& object, std::vector<std::string>& notes);

}  // namespace umbrameter::gltf
