// Loads a scene and measures what `umbrameter info SCENE` says about it.
#pragma once

#include <cstdint>
#include <string>

#include "results/scene_report.h"
#include "scenes/load_options.h"
#include "scenes/scene_params.h"

namespace umbrameter {

/// Scenes with more stored triangles than this are traced only on demand: building takes about a second here.
inline constexpr std::uint64_t max_triangles_built_unasked = 1'000'000;

struct SceneReportOptions {
  LoadOptions load;
  bool measure_memory = false;  ///< build the ray tracer's structure whatever the size
  SceneParams scene_params{};   ///< scene.*
};

/// Loads the scene and looks at all of it. Throws what load_scene() throws.
SceneReport make_scene_report(const std::string& source, const std::string& part, const SceneReportOptions& options);

}  // namespace umbrameter
