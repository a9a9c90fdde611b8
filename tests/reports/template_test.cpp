#include "reports/page/template.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <vector>

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json cell(const char* kind, const char* text) { return {{kind, {{"text", text}, {"below", Json::array()}}}}; }

const Json one_table = {{"caption", "Bias"},
                        {"has_units", true},
                        {"column_count", 2},
                        {"columns",
                         {{{"name", "filter"}, {"unit", ""}, {"meaning", "how"}, {"numeric", false}},
                          {{"name", "bias"}, {"unit", "m"}, {"meaning", ""}, {"numeric", true}}}},
                        {"rows", Json::array({Json::array({cell("header", "box"), cell("number", "0.3")}),
                                              Json::array({cell("header", ""), cell("number", "")})})}};

TEST(Template, Lists_are_repeated_and_lines_of_tags_leave_no_line) {
  EXPECT_EQ(fill_template("table.html", one_table),
            "<div class=\"table\" role=\"region\" aria-label=\"Bias\">\n"
            "<div class=\"caption\">Bias</div>\n"
            "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Bias\">\n"
            "<table aria-label=\"Bias\">\n"
            "<thead>\n"
            "<tr><th scope=\"col\" title=\"how\">filter</th><th scope=\"col\" class=\"number\">bias</th></tr>\n"
            "<tr><td class=\"unit\"></td><td class=\"unit number\">m</td></tr>\n"
            "</thead>\n"
            "<tbody>\n"
            "<tr><th scope=\"row\">box</th><td class=\"number\">0.3</td></tr>\n"
            "<tr><th scope=\"row\"></th><td class=\"number\"></td></tr>\n"
            "</tbody>\n"
            "</table>\n"
            "</div>\n"
            "</div>\n");
}

TEST(Template, What_is_false_or_empty_is_left_out_and_its_opposite_is_shown) {
  Json table = one_table;
  table["rows"] = Json::array();
  table["has_units"] = false;
  const std::string markup = fill_template("table.html", table);
  EXPECT_NE(markup.find("<tbody>\n<tr><td class=\"empty\" colspan=\"2\">no rows</td></tr>\n</tbody>"),
            std::string::npos)
      << markup;
  EXPECT_EQ(markup.find("class=\"unit"), std::string::npos) << markup;
}

TEST(Template, Numbers_stay_in_one_line_with_their_per_cent_and_their_half_width) {
  const Json page = {
      {"title", ""}, {"style_hash", ""}, {"style", ""}, {"data", ""}, {"answers", {"<2.18 ± 0.73 %; 5 % of"}}};
  EXPECT_NE(fill_template("page.html", page).find("<li>&lt;2.18 ±\u00a00.73\u00a0%; 5\u00a0% of</li>"),
            std::string::npos);
}

TEST(Template, Values_are_escaped_and_are_no_templates) {
  Json table = one_table;
  table["caption"] = "<b>\"&' {{column_count}}";
  const std::string markup = fill_template("table.html", table);
  EXPECT_NE(markup.find("<div class=\"caption\">&lt;b&gt;&quot;&amp;&#39; {{column_count}}</div>"), std::string::npos)
      << markup;
}

TEST(Template, A_figure_says_one_thing_about_its_picture) {
  const Json figure = {{"number", 3}, {"stem", "a"}, {"title", "T"}, {"caption", "C"}, {"files", Json::array()}};
  const auto filled = [&](const char* key, const Json& value) {
    Json with_picture = figure;
    with_picture[key] = value;
    return fill_template("figure.html", with_picture);
  };
  const std::string caption = "<figcaption><strong>Figure 3.</strong> T. C\n</figcaption>\n</figure>\n";
  EXPECT_EQ(filled("drawing", "<svg></svg>"),
            "<figure data-stem=\"a\">\n<div class=\"picture\" role=\"img\" aria-label=\"T. C\"><svg></svg></div>\n" +
                caption);
  EXPECT_EQ(filled("pixels", "data:x"),
            "<figure data-stem=\"a\">\n<div class=\"picture\"><img alt=\"T. C\" src=\"data:x\"></div>\n" + caption);
  EXPECT_EQ(filled("missing", true),
            "<figure data-stem=\"a\">\n<div class=\"picture\"><p class=\"missing\">This figure could not be drawn; see "
            "the notes.</p>"
            "</div>\n<figcaption><strong>Figure 3.</strong> T. C\n</figcaption>\n</figure>\n");
}

TEST(Template, Each_template_closes_its_sections_in_order) {
  static const std::regex tag("\\{\\{([#?^/])([a-z_.]+)\\}\\}");
  for (const char* name : {"templates/page.html", "templates/figure.html", "templates/table.html"}) {
    const std::string text(embedded_page_file(name));
    ASSERT_FALSE(text.empty()) << name;
    std::vector<std::string> open;
    for (std::sregex_iterator m(text.begin(), text.end(), tag), end; m != end; ++m) {
      if ((*m)[1] != "/") {
        open.push_back((*m)[2]);
        continue;
      }
      ASSERT_FALSE(open.empty()) << name << ": " << m->str();
      EXPECT_EQ(open.back(), (*m)[2]) << name;
      open.pop_back();
    }
    EXPECT_TRUE(open.empty()) << name << ": " << open.back();
  }
}

}  // namespace
}  // namespace umbrameter
