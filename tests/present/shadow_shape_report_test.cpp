#include <gtest/gtest.h>

#include <algorithm>

#include "present/presentation_parts.h"

namespace umbrameter {
namespace {

std::string caption_of(bool is_hard) {
  SceneFacts scene;
  scene.titles = scene.layers = {"sun"};
  ShadowMeasurement shadow;
  shadow.light = 0;
  ShadowShape& shape = shadow.shape.emplace();
  EdgeDistances distances;
  distances.texels = distances.pixels = distances.metres = Spread{};
  shape.error.all = distances;
  shape.error.parts.assign(is_hard ? cause_count : 2, distances);
  if (is_hard) shape.error.components.emplace();
  Presentation presentation;
  present_shape(presentation, scene, shadow);
  return head_of(presentation.figures.at(0)).caption;
}

// Against a reference with a penumbra no cause is known.
TEST(ShadowShapeReport, The_caption_of_distances_speaks_of_causes_only_where_there_are_some) {
  EXPECT_NE(caption_of(true).find("each cause's error"), std::string::npos);
  const std::string soft = caption_of(false);
  for (const char* word : {"cause's", "acne", "Aliasing"}) EXPECT_EQ(soft.find(word), std::string::npos) << soft;
  EXPECT_NE(soft.find("too dark"), std::string::npos) << soft;
}

// A bias that removes the whole shadow leaves contacts without a gap to measure, and edges without a match.
TEST(ShadowShapeReport, The_table_of_casters_shows_lost_contacts_and_edges_without_a_match) {
  SceneFacts scene;
  scene.titles = scene.layers = {"sun"};
  scene.by_object.names = {"leaf"};
  ShadowMeasurement shadow;
  ShadowShape& shape = shadow.shape.emplace();
  CasterShape& leaf = shape.casters.emplace_back();
  leaf.contacts = leaf.lost = 6;
  leaf.unmatched = 28;
  Presentation presentation;
  present_shape(presentation, scene, shadow);
  const auto report =
      std::ranges::find(presentation.section.tables, "Contact gap and shadow inset by caster", &ReportTable::title);
  ASSERT_NE(report, presentation.section.tables.end());
  const auto cell = [&](const char* column) {
    return to_string(report->table.rows.at(0)[column_index(report->table, column)]);
  };
  EXPECT_EQ(cell("contacts"), "6");
  EXPECT_EQ(cell("without shadow"), "6");
  EXPECT_EQ(cell("matched edges"), "0");
  EXPECT_EQ(cell("without match"), "28");
}

// As the notes on engines and `convert` count them.
TEST(ShadowShapeReport, The_table_of_views_counts_cascades_from_1) {
  SceneFacts scene;
  scene.titles = scene.layers = {"sun"};
  ShadowMeasurement shadow;
  shadow.layout.views.resize(3);
  ShadowShape& shape = shadow.shape.emplace();
  for (std::uint64_t view = 0; view < 3; ++view) {
    ViewStatistics& of_view = shape.views.views.emplace_back();
    of_view.view = view;
    of_view.pixels = view == 1 ? 0u : 10u;
  }
  Presentation presentation;
  present_shape(presentation, scene, shadow);
  const auto report = std::ranges::find(presentation.section.tables, "Error by view of the map", &ReportTable::title);
  ASSERT_NE(report, presentation.section.tables.end());
  ASSERT_EQ(report->table.rows.size(), 2u) << "a view without pixels has no row";
  const std::size_t name = column_index(report->table, "view");
  EXPECT_EQ(to_string(report->table.rows[0][name]), "cascade 1");
  EXPECT_EQ(to_string(report->table.rows[1][name]), "cascade 3");
}

}  // namespace
}  // namespace umbrameter
