// glTF 2.0 in and out. The only door to the glTF parser.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/load_options.h"
#include "scenes/scene.h"

namespace umbrameter {

/// The files that a .gltf or .glb file refers to, relative to its folder. Throws Error (unreadable_input) if one of
/// them is missing or outside that folder.
std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& path);

/// Reads a .gltf or .glb file; `part` selects one of several scenes in it by name or index, else its default scene.
/// Throws Error (unreadable_input) naming the file, the object and the way out.
/// What was assumed or left out stands in Scene::notes.
Scene load_gltf(const std::filesystem::path& path, const std::string& part = {}, const LoadOptions& options = {});

/// The same for a file in memory. `path` names it in errors; files that it refers to are looked for beside that path.
Scene read_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& path, const std::string& part = {},
                const LoadOptions& options = {});

/// Serialises as one binary glTF that load_gltf() with LoadOptions::materials reads back the same, bit for bit, notes
/// aside. Deterministic.
/// Not kept: objects without instances, textures of materials that no mesh has, the alpha cutoff of materials without
/// a mask; an object whose instances stand at different places becomes one object a place.
std::vector<unsigned char> to_glb(const Scene& scene);

}  // namespace umbrameter
