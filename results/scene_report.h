// Everything that a scene file holds, and what it costs in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/bounds.h"
#include "scenes/memory.h"
#include "scenes/scene.h"
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

}  // namespace umbrameter
