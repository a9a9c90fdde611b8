// The text of `umbrameter info SCENE`: everything that a file holds, and what it costs in memory.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "scenes/load_options.h"
#include "scenes/memory.h"
#include "scenes/scene.h"
#include "scenes/scene_params.h"
#include "scenes/units.h"

namespace umbrameter {

/// A scene and what was found out about it; text and JSON are made from this alone.
struct SceneReport {
  std::string source;  ///< as the user named it
  std::string part;    ///< as the user chose it with --scene; empty for the default
  std::string unit;    ///< scene.unit
  Scene scene;
  SceneCounts counts;
  Bounds bounds;
  UnitGuess units;
  SceneBytes memory;  ///< computed
  SceneBytes gpu;     ///< computed
  /// Measured: Embree's own count after building. Absent when it was not built.
  std::optional<std::uint64_t> tracer_bytes;
  double load_seconds = 0.0;        ///< measured
  std::uint64_t peak_resident = 0;  ///< measured: bytes, the most that the process held while loading
};

/// Scenes with more stored triangles than this are traced only on demand: building takes about a second here.
inline constexpr std::uint64_t max_triangles_built_unasked = 1'000'000;

struct SceneReportOptions {
  LoadOptions load;
  bool measure_memory = false;  ///< build the ray tracer's structure whatever the size
  SceneParams scene_params{};   ///< scene.*
};

/// Loads the scene and looks at all of it. Throws what load_scene() throws.
SceneReport make_scene_report(const std::string& source, const std::string& part, const SceneReportOptions& options);

/// docs/info.md has the keys.
nlohmann::ordered_json to_json(const SceneReport& report);

/// Kind and sizes of a light's extent; null without one.
nlohmann::ordered_json to_json(const Emitter& emitter);
/// "disk of 0.5 m radius"; empty without extent.
std::string extent_text(const Emitter& emitter);

/// Lines of at most 100 characters where names allow it; long lists are cut, and say so.
std::vector<std::string> to_lines(const SceneReport& report);

const char* kind_of(const Camera& camera);  ///< "perspective" or "orthographic"
const char* kind_of(const Light& light);    ///< "directional", "spot" or "point"

}  // namespace umbrameter
