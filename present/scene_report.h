// The text of `umbrameter info SCENE`: everything that a file holds, and what it costs in memory.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "results/scene_report.h"
#include "scenes/emitter.h"

namespace umbrameter {

/// docs/info.md has the keys.
nlohmann::ordered_json to_json(const SceneReport& report);

/// Kind and sizes of a light's extent; null without one.
nlohmann::ordered_json to_json(const Emitter& emitter);
/// "disk of 0.5 m radius"; empty without extent.
std::string extent_text(const Emitter& emitter);

/// Lines of at most 100 characters where names allow it; long lists are cut, and say so.
std::vector<std::string> to_lines(const SceneReport& report);

const char* kind_of(const Camera& camera);  ///< "perspective" or "orthographic"

}  // namespace umbrameter
