// A recommended bias in the numbers of engines, with the error that these have after rounding.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "present/presentation.h"
#include "results/engine_advice.h"

namespace umbrameter {

/// Adds lines for the console, a table and a paragraph of notes. `what` is that of which the bias is: "sun".
void add_engines(Presentation& presentation, const std::vector<EngineAdvice>& engines, const std::string& what);

/// "engines" of summary.json.
nlohmann::ordered_json to_json(const std::vector<EngineAdvice>& engines);

}  // namespace umbrameter
