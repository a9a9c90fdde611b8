// The views of one light's map in a run: tables of the page, and for summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "reports/page/page.h"
#include "results/shadow_shape.h"

namespace umbrameter {

/// Adds the tables that apply to a light's section.
void present_map_views(ReportSection& section, const MapViews& views);

/// Adds "views", "seams" and "fit_shimmer" where they apply.
void add_map_views(nlohmann::ordered_json& object, const MapViews& views);

}  // namespace umbrameter
