// What of a page is folded, and in which order its parts stand.
#include <gtest/gtest.h>

#include "reports/page/page.h"
#include "reports/page/viewer_data.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string page_of(const TemporaryFolder& folder, const Report& report, const ViewerPack* viewer = nullptr) {
  write_page(folder.path(), report, viewer);
  return text_of(folder / "index.html");
}

Report of_table(const Table& table) {
  Report report;
  report.sections.emplace_back();
  report.sections[0].tables = {{"Bias", table}};
  return report;
}

TEST(PageParts, Columns_that_stand_below_another_are_parts_of_its_cells) {
  const TemporaryFolder folder;
  Report report = of_table({{{"choice", "", ""}, {"bias", "m", ""}, {"in texels", "texels", ""}, {"mae", "%", ""}},
                            {{std::string("least error"), 0.25, 3.5, 1.0}}});
  report.sections[0].tables[0].below = {"in texels"};
  const std::string page = page_of(folder, report);
  const auto below = [](const std::string& text) {
    return "<span class=\"belows\"><span class=\"below\">" + text + "</span></span></td>";
  };
  EXPECT_TRUE(contains(page, std::string("m") + below("in texels"))) << page;
  EXPECT_TRUE(contains(page, "<td class=\"number\">0.25" + below("3.5") + "<td class=\"number\">1</td>")) << page;
}

TEST(PageParts, Settings_that_differ_from_their_defaults_come_first_and_all_are_folded) {
  const TemporaryFolder folder;
  Report report;
  report.sections.emplace_back();
  report.settings = {{{"parameter", "", ""}, {"value", "", ""}, {"default", "", ""}},
                     {{std::string("changed"), 1.0, 2.0}, {std::string("kept"), 2.0, 2.0}}};
  const std::string page = page_of(folder, report);
  const std::size_t all = page.find("<summary>All 2 settings</summary>");
  ASSERT_NE(all, std::string::npos);
  EXPECT_TRUE(contains(page.substr(0, all), "<th scope=\"row\">changed</th>"));
  EXPECT_FALSE(contains(page.substr(0, all), "<th scope=\"row\">kept</th>"));
  EXPECT_TRUE(contains(page.substr(all), "<th scope=\"row\">changed</th>"));
  EXPECT_TRUE(contains(page.substr(all), "<th scope=\"row\">kept</th>"));
}

TEST(PageParts, Figures_of_what_the_viewer_shows_are_folded_and_others_are_not) {
  const TemporaryFolder folder;
  Report report;
  report.sections.emplace_back();
  report.sections[0].figures = {"layer", "absent"};
  ViewerPack pack;
  pack.sets = {"{}"};
  pack.layers = {"layer"};
  const std::string page = page_of(folder, report, &pack);
  const std::size_t fold = page.find("<details class=\"fold viewer-figures\" open>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_TRUE(contains(page.substr(fold), "data-stem=\"layer\""));
  EXPECT_TRUE(contains(page.substr(0, fold), "data-stem=\"absent\""));
  EXPECT_FALSE(contains(page_of(folder, report), "viewer-figures\" open"));
}

TEST(PageParts, Tables_stand_before_figures_where_the_section_wants_it) {
  const TemporaryFolder folder;
  Report report = of_table({{{"a", "", ""}}, {{std::string("x")}}});
  report.sections[0].figures = {"absent"};
  const auto is_table_first = [&] {
    const std::string page = page_of(folder, report);
    return page.find("<div class=\"table\"") < page.find("<figure ");
  };
  EXPECT_FALSE(is_table_first());
  report.sections[0].tables_first = true;
  EXPECT_TRUE(is_table_first());
}

}  // namespace
}  // namespace umbrameter
