// Prints the descriptions of all statistics and image metrics as JSON: the source of the generated parts of
// docs/ (see references.py).
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "compare/ao.h"
#include "compare/ao_stages.h"
#include "compare/edge_statistics.h"
#include "compare/image_error.h"
#include "compare/map_views.h"
#include "compare/metrics/color_metric.h"
#include "compare/soft_visibility.h"
#include "compare/visibility.h"
#include "experiments/measure/metric_scores.h"
#include "store/summary_version.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

template <class Struct>
Json group(const char* name, const char* title) {
  Struct object;
  Json statistics = Json::array();
  for (const Statistic& each : describe(object)) {
    statistics.push_back({{"name", each.name},
                          {"unit", each.unit},
                          {"meaning", each.meaning},
                          {"interval", each.has_interval()},
                          {"integer", std::holds_alternative<std::uint64_t*>(each.field)}});
  }
  return {{"name", name}, {"title", title}, {"statistics", std::move(statistics)}};
}

Json all_statistics() {
  return {group<VisibilityStatistics>("visibility", "Hard shadow, technique that sums depth comparisons"),
          group<EdgeStatistics>("edges", "Hard shadow, technique without taps"),
          group<SoftVisibilityStatistics>("soft_visibility", "Soft shadow of an area light"),
          group<AoStatistics>("ao", "Ambient occlusion"),
          group<AoStageStatistics>("ao_stages", "Ambient occlusion by stage"),
          group<ImageStatistics>("image", "Shaded image"),
          group<ViewStatistics>("view", "One view of the map: a cascade or a cube face"),
          group<SeamStatistics>("seams", "Seams between the views of the map"),
          group<FitShimmer>("fit_shimmer", "Shimmer of a map that follows the camera")};
}

// Metrics of scalar images and those of colour, a column for each of their units.
Json all_metrics() {
  Json list = Json::array();
  for (const Metric& metric : color_metrics()) {
    for (const MetricColumn& column : columns_of(metric, true)) {
      list.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning()}});
    }
  }
  return list;
}

}  // namespace
}  // namespace umbrameter

int main() {
  const nlohmann::ordered_json all = {{"schema_version", umbrameter::summary_schema_version},
                                      {"statistics", umbrameter::all_statistics()},
                                      {"metrics", umbrameter::all_metrics()}};
  std::puts(all.dump(1).c_str());
}
