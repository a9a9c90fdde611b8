// The shape of one light's shadow error as rows and a figure of the page, and for summary.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "present/presentation.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// The value of "shape".
nlohmann::ordered_json to_json(const SceneFacts& scene, const ShadowShape& shape);

/// Adds the tables and the figure to a light's section.
void present_shape(Presentation& presentation, const SceneFacts& scene, const ShadowMeasurement& shadow);

}  // namespace umbrameter
