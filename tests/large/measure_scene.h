// Seconds and memory of every step with one scene, for scaling.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace umbrameter {

/// Name and value, in the order in which they were measured.
using Measurements = std::vector<std::pair<std::string, double>>;

/// The names: seconds of each step, and MiB that the process has held at most by the end of a stage.
inline constexpr const char* step_names[] = {"load", "G-buffer", "shadow map", "build", "primary rays", "shadow rays"};
inline constexpr const char* stage_names[] = {"loaded", "drawn", "traced"};

/// Makes a built-in scene and writes it as a .glb file; its triangles, stored triangles, and the bytes of the file.
Measurements write_scene(const std::string& scene, const std::filesystem::path& file);

/// Loads the file and goes through all steps at 1280×720, with the first camera, the first light and a map of 2048².
/// Each step is done `repeats` times, of which the least time counts, but those that take long only twice.
Measurements measure_scene(const std::filesystem::path& file, int repeats);

}  // namespace umbrameter
