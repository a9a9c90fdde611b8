#include "present/map_views_report.h"

#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "reports/files/value_json.h"

namespace umbrameter {
namespace {

Table view_table(const std::vector<ViewStatistics>& views) {
  Table table{columns_of(ViewStatistics{}), {}};
  for (const ViewStatistics& view : views) {
    if (view.pixels > 0) table.rows.push_back(row_of(view));
  }
  return in_percent(table);
}

}  // namespace

void present_map_views(ReportSection& section, const MapViews& views) {
  if (!views.views.empty()) section.tables.push_back({"Error by view of the map", view_table(views.views)});
  if (views.seams) section.tables.push_back(statistics_table("Seams between the views", *views.seams));
  if (views.shimmer) section.tables.push_back(statistics_table("Shimmer of the fit", *views.shimmer));
}

void add_map_views(nlohmann::ordered_json& object, const MapViews& views) {
  for (const ViewStatistics& view : views.views) object["views"].push_back(statistics_json(view));
  if (views.seams) object["seams"] = statistics_json(*views.seams);
  if (views.shimmer) object["fit_shimmer"] = statistics_json(*views.shimmer);
}

}  // namespace umbrameter
