// What of a page is folded, and in which order its parts stand.
#include <gtest/gtest.h>

#include "reports/files/markup.h"
#include "reports/files/png.h"
#include "reports/page/page.h"
#include "reports/page/page_figure.h"
#include "reports/page/viewer_data.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace umbrameter {
namespace {

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

TEST(PageParts, Columns_of_intervals_are_set_right_and_heads_do_not_break_within_a_number) {
  const TemporaryFolder folder;
  const std::string page = page_of(folder, of_table({{{"run", "", ""}, {"95 %", "%", ""}, {"bias", "m", ""}},
                                                     {{std::string("a"), std::string("2.18 ± 0.73"), -0.5},
                                                      {std::string("b"), std::string("(−0.02 ± 0.03)*"), 0.0},
                                                      {std::string("c"), std::string("11.2 to 11.4"), 1.0}}}));
  for (const char* text : {"2.18 ± 0.73", "(−0.02 ± 0.03)*", "11.2 to 11.4", "−0.5"}) {
    EXPECT_TRUE(contains(page, "<td class=\"number\">" + std::string(text) + "</td>")) << text;
  }
  EXPECT_TRUE(contains(page, ">95\u00a0%</th>")) << page;
}

TEST(PageParts, Counts_of_pixels_are_grouped_as_in_the_text) {
  const TemporaryFolder folder;
  const std::string page =
      page_of(folder, of_table({{{"object", "", ""}, {"pixels", "px", ""}, {"resolution", "texels", ""}},
                                {{std::string("wall"), std::int64_t{47311}, std::int64_t{16384}}}}));
  EXPECT_TRUE(contains(page, "<td class=\"number\">47,311</td>")) << page;
  EXPECT_TRUE(contains(page, "<td class=\"number\">16384</td>")) << page;
  const std::string statistics =
      page_of(folder, of_table({{{"quantity", "", ""}, {"value", "", ""}, {"unit", "", ""}},
                                {{std::string("pixels"), std::int64_t{47311}, std::string("px")},
                                 {std::string("rays"), std::int64_t{20000}, std::string("1")}}}));
  EXPECT_TRUE(contains(statistics, "<td class=\"number\">47,311</td>")) << statistics;
  EXPECT_TRUE(contains(statistics, "<td class=\"number\">20000</td>")) << statistics;
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
  report.sections[0].figures = {{"layer"}, {"absent"}};
  ViewerPack pack;
  pack.sets = {"{}"};
  pack.layers = {"layer"};
  const std::string page = page_of(folder, report, &pack);
  const std::size_t fold = page.find("<details class=\"fold viewer-figures\" open>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_TRUE(contains(page.substr(fold), "data-stem=\"layer\""));
  EXPECT_TRUE(contains(page.substr(0, fold), "data-stem=\"absent\""));
  EXPECT_TRUE(contains(page.substr(0, fold), "Figure 1.")) << "numbers follow the order of the page";
  EXPECT_TRUE(contains(page.substr(fold), "Figure 2."));
  EXPECT_FALSE(contains(page_of(folder, report), "viewer-figures\" open"));
}

// 1281 columns become 640 means of 2 × 2: of 10, 20, 30 and 40 it is 25. The bar below is narrow enough.
TEST(PageParts, Embedded_images_are_reduced_to_what_a_page_can_show) {
  Image<glm::u8vec3> wide(1281, 2, glm::u8vec3(10));
  Image<glm::u8vec3> narrow(1279, 2, glm::u8vec3(9));
  for (int x = 1; x < wide.width; x += 2) wide.at(x, 0) = glm::u8vec3(20);
  for (int x = 0; x < wide.width; ++x) wide.at(x, 1) = glm::u8vec3(x % 2 == 0 ? 30 : 40);
  const auto element = [](const Image<glm::u8vec3>& image) {
    return "<image width=\"9\" xlink:href=\"" + data_uri("image/png", to_png(image)) + "\"/>";
  };
  const std::string drawing = "<svg>" + element(wide) + element(narrow) + "</svg>";
  const Image<glm::u8vec3> means(640, 1, glm::u8vec3(25));
  EXPECT_EQ(with_reduced_images(drawing), "<svg>" + element(means) + element(narrow) + "</svg>");
  EXPECT_EQ(with_reduced_images("<svg/>"), "<svg/>");
}

TEST(PageParts, Tables_stand_before_figures_where_the_section_wants_it) {
  const TemporaryFolder folder;
  Report report = of_table({{{"a", "", ""}}, {{std::string("x")}}});
  report.sections[0].figures = {{"absent"}};
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
