#include "reports/page/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "core/error.h"
#include "reports/figures/figures.h"
#include "reports/files/markup.h"
#include "reports/page/page_figure.h"
#include "reports/page/template.h"
#include "reports/page/viewer_data.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// U+202E turns the direction of the text around, U+009B begins an escape sequence of a terminal.
const std::string hostile =
    "<script>alert(1)</script> \"'&\xFF </title></style> <img src=http://example.org/x onerror=x> <!-- ]]> {{&style}} "
    "\u202E\u009B31m\\" +
    std::string(300, 'x');

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// The page without the text of its script, which a build without Node does not have.
std::string written_page(const TemporaryFolder& folder, const Report& report, const ViewerPack* viewer = nullptr) {
  write_page(folder.path(), report, viewer);
  std::string page = text_of(folder / "index.html");
  const std::string script = "<script>" + std::string(page_script()) + "</script>\n";
  if (page_script().empty()) return page;
  const std::size_t at = page.find(script);
  EXPECT_NE(at, std::string::npos);
  return page.erase(at, script.size());
}

std::string sha256_of(const TemporaryFolder& folder, const std::string& text) {
  put_text(folder / "text", text);
  const std::unique_ptr<FILE, int (*)(FILE*)> tool(popen(("sha256sum < " + (folder / "text").string()).c_str(), "r"),
                                                   pclose);
  char digits[65] = {};
  if (tool == nullptr || fread(digits, 1, 64, tool.get()) != 64) return {};
  std::string bytes;
  for (int i = 0; i < 64; i += 2) bytes += static_cast<char>(std::stoi(std::string(digits + i, 2), nullptr, 16));
  return "'sha256-" + to_base64(bytes) + "'";
}

// The JSON that the page holds for programs, as text.
std::string data_text(const std::string& page) {
  static const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return page.substr(at, page.find("</script>", at) - at);
}

Report with_figure(const std::string& stem, const std::string& title, const std::string& caption) {
  Report report;
  ReportSection section;
  section.figures = {{stem, title, "", caption}};
  report.sections = {section};
  return report;
}

Report with_table(const Table& table) {
  Report report;
  ReportSection section;
  section.tables = {{"Bias", table}};
  report.sections = {section};
  return report;
}

Report sample(const std::string& text) {
  Report report;
  report.title = text;
  report.subtitle = text;
  report.command = text;
  report.notes = {text};
  report.settings = {{{text, text, text}}, {{text}}};
  ReportSection section;
  section.title = text;
  section.text = text + "\n\n" + text;
  section.headlines = {{text, text, text}, {text, "4.1 ± 0.1 %", ""}};
  section.figures = {{"drawn", text, "", text}, {"absent", "", "", text}, {"../secret"}, {text}};
  section.tables = {{text, {{{text, text, text}, {"mae", "1", ""}}, {{text, 0.125}}}}};
  report.sections = {section, section};
  return report;
}

void put_drawing(const TemporaryFolder& folder, const std::string& name) {
  fs::create_directories(folder / "figures");
  put_text(folder / "figures" / (name + ".svg"),
           "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"2\" "
           "viewBox=\"0 0 4 2\"><defs><clipPath id=\"c\"><rect width=\"4\" height=\"2\"/></clipPath></defs>"
           "<g clip-path=\"url(#c)\"><text>an id=\"c\" here</text></g></svg>\n");
}

// The first element that is not closed where it should be, or nothing.
std::string unbalanced(const std::string& page) {
  static const std::set<std::string> without_end = {"meta", "img", "br", "link", "!doctype"};
  static const std::regex tag("<(/?)([A-Za-z!][A-Za-z0-9]*)((?:[^<>\"]|\"[^\"]*\")*)>");
  std::vector<std::string> open;
  for (std::sregex_iterator m(page.begin(), page.end(), tag), end; m != end; ++m) {
    std::string name = (*m)[2];
    for (char& c : name) c = static_cast<char>(tolower(c));
    const std::string rest = (*m)[3];
    if (without_end.count(name) > 0 || (!rest.empty() && rest.back() == '/')) continue;
    if ((*m)[1].length() == 0) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> in " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

TEST(Page, Its_elements_are_closed_in_order_whatever_the_names_are) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  EXPECT_EQ(unbalanced("<p><b></p>"), "</p> in b");
  EXPECT_EQ(unbalanced(written_page(folder, sample("plain"))), "");
  EXPECT_EQ(unbalanced(written_page(folder, sample(hostile))), "");
  EXPECT_EQ(unbalanced(written_page(folder, Report())), "");
}

TEST(Page, Hostile_names_stay_text) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  const std::string page = written_page(folder, sample(hostile));
  EXPECT_EQ(count(page, "<script"), 1u) << "the data";
  EXPECT_EQ(count(page, "</script"), 1u);
  EXPECT_EQ(count(page, "<!--"), 0u);
  EXPECT_EQ(count(page, "<img src=http"), 0u);
  EXPECT_EQ(count(page, "</title>"), 1u);
  EXPECT_EQ(count(page, "</style>"), 1u);
  EXPECT_EQ(count(page, "\xFF"), 0u);
  EXPECT_EQ(count(page, "\u009B"), 0u);
  EXPECT_GT(count(page, "{{&amp;style}}"), 10u) << "a name is no template";
  EXPECT_GT(count(page, "&lt;script&gt;alert(1)&lt;/script&gt;"), 10u);
}

TEST(Page, Its_data_are_the_texts_that_it_shows_in_ascii_and_without_tags) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  for (const std::string& text : {std::string("plain"), hostile}) {
    const std::string json = data_text(written_page(folder, sample(text)));
    EXPECT_TRUE(std::all_of(json.begin(), json.end(), [](char c) { return c >= ' ' && c <= '~' && c != '<'; })) << json;
    const nlohmann::json data = nlohmann::json::parse(json);
    const nlohmann::json& section = data.at("sections").at(1);
    const std::string shown = section["paragraphs"][0];
    EXPECT_EQ(shown.substr(0, 9), text.substr(0, 9));
    EXPECT_EQ(shown.substr(shown.size() - 5), text.substr(text.size() - 5));
    for (const nlohmann::json& other : {data["title"], data["notes"][0], section["headlines"][0]["note"],
                                        section["figures"][0]["title"], data["settings"]["columns"][0]["meaning"]}) {
      EXPECT_EQ(other, shown);
    }
    EXPECT_EQ(section["anchor"], "section-2");
    EXPECT_EQ(section["headlines"][1], (nlohmann::json{{"label", shown}, {"value", "4.1 ± 0.1 %"}, {"note", ""}}));
    EXPECT_EQ(section["figures"][0]["number"], 5);
    EXPECT_EQ(section["tables"][0]["rows"], nlohmann::json::array({nlohmann::json::array({shown, "0.125"})}));
    EXPECT_EQ(section["tables"][0]["caption"], "Table 2. " + shown);
  }
}

TEST(Page, It_loads_nothing) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  write_png(folder / "figures/absent.png", Image<glm::u8vec3>(2, 2));
  const std::string page = written_page(folder, sample("plain"));
  const std::regex reference("(?:src|href|action|data|poster)=\"([^\"]*)\"|url\\(([^)]*)\\)|@import");
  std::size_t references = 0;
  for (std::sregex_iterator m(page.begin(), page.end(), reference), end; m != end; ++m) {
    const std::string target = (*m)[1].matched ? (*m)[1].str() : (*m)[2].str();
    EXPECT_TRUE(target.rfind("data:image/png;base64,", 0) == 0 || target.rfind("#", 0) == 0 ||
                target.rfind("figures/", 0) == 0)
        << m->str();
    ++references;
  }
  EXPECT_GT(references, 5u);
  EXPECT_EQ(count(page, "<script"), 1u);
  EXPECT_EQ(count(page, "<script type=\"application/json\""), 1u) << "data, which no browser runs";
  EXPECT_EQ(count(page, "<link"), 0u);
  EXPECT_EQ(count(page, " style=\""), 0u);  // the policy would block it
  EXPECT_EQ(std::regex_search(page, std::regex("<[a-z]+ [^>]*\\bon[a-z]+=")), false);
}

TEST(Page, Its_policy_forbids_all_but_its_own_style_its_own_script_and_inlined_pictures) {
  const TemporaryFolder folder;
  const std::string page = written_page(folder, sample("plain"));
  const std::size_t begin = page.find("<style>") + 7;
  const std::string style = sha256_of(folder, page.substr(begin, page.find("</style>") - begin));
  if (style.empty()) GTEST_SKIP() << "sha256sum is missing";
  const std::string script =
      page_script().empty() ? "" : "script-src " + sha256_of(folder, std::string(page_script())) + "; ";
  EXPECT_TRUE(contains(page, "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src " + style +
                                 "; " + script + "img-src data:; base-uri 'none'; form-action 'none'\""));
}

TEST(Page, Its_script_cannot_end_its_element) {
  for (const char* text : {"</script", "<!--", "<script"})
    EXPECT_EQ(page_script().find(text), std::string::npos) << text;
}

ViewerData viewer_sample(const std::string& text) {
  ViewerData data;
  data.width = 2;
  data.height = 1;
  data.layers = {{text, text, text, ViewerRole::error, ViewerKind::error, 0.5, text}};
  data.layers[0].planes = {Image<float>(2, 1, 0.25f)};
  data.layers[0].categories = {{text, {1, 2, 3}}};
  data.objects = {Image<std::uint16_t>(2, 1, 1), {text}};
  data.cell = {7, text, text};
  return data;
}

nlohmann::json json_of(const std::string& page, const std::string& id) {
  const std::string begin = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(Page, The_viewer_has_its_data_as_json_whatever_the_names_are) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string("plain"), hostile}) {
    ViewerPack pack;
    pack.title = text;
    add_set(pack, viewer_sample(text));
    Report report = sample(text);
    report.cells = ReportCells{{{{text, text, text}}, {{text}}}, 1, {text}, {}, 1, text, {text}, text};
    report.sections[0].charts = {{report.sections[0].figures.at(0).stem, {{text, text}}, {{text, text}}}};
    const std::string page = written_page(folder, report, &pack);
    EXPECT_EQ(unbalanced(page), "");
    EXPECT_EQ(count(page, "<script"), 3u) << "three blocks of data";
    const nlohmann::json data = json_of(page, "viewer-data");
    const nlohmann::json& set = data.at("sets").at(0);
    const nlohmann::json& layer = set.at("layers").at(0);
    EXPECT_EQ(layer["role"], "error");
    EXPECT_EQ(layer["range"], (nlohmann::json{-0.5, 0.5}));
    const nlohmann::json& objects = data["items"][set["objects"].get<std::size_t>()];
    EXPECT_EQ(layer["name"], objects["names"][0]);
    EXPECT_EQ(objects["plane"]["type"], "u8");
    const nlohmann::json& plane = data["items"][layer["planes"][0].get<std::size_t>()];
    EXPECT_EQ(plane["type"], "pal");
    EXPECT_EQ(plane["palette"], nlohmann::json{0x3400}) << "0.25 as a half float";
    EXPECT_EQ(set["stride"], 1);
    EXPECT_EQ(set["cell"]["number"], 7);
    EXPECT_EQ(json_of(page, "cells-data")["rows"][0][0], layer["name"]);
    EXPECT_TRUE(contains(page, " data-cells=\"{&quot;columns&quot;:{&quot;"));
  }
}

TEST(Page, Ids_are_used_once_even_when_a_figure_is_shown_twice) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  const std::string page = written_page(folder, sample("plain"));
  std::set<std::string> ids;
  const std::regex id(" id=\"([^\"]*)\"");
  const std::string without_texts = std::regex_replace(page, std::regex("<text>[^<]*</text>"), "");
  for (std::sregex_iterator m(without_texts.begin(), without_texts.end(), id), end; m != end; ++m) {
    EXPECT_TRUE(ids.insert((*m)[1]).second) << m->str();
  }
  EXPECT_TRUE(contains(page, "<clipPath id=\"f1-c\">"));
  EXPECT_TRUE(contains(page, "url(#f1-c)"));
  EXPECT_TRUE(contains(page, "url(#f5-c)"));
  EXPECT_EQ(count(page, "<text>an id=\"c\" here</text>"), 2u);
  for (const std::string& target : {std::string("section-1"), std::string("section-2"), std::string("settings")}) {
    EXPECT_TRUE(contains(page, "href=\"#" + target + "\"") && ids.count(target) == 1) << target;
  }
}

TEST(Page, A_drawing_with_a_script_is_not_taken_in) {
  EXPECT_EQ(inline_svg("<svg><script>x</script></svg>", "a-"), "");
  EXPECT_EQ(inline_svg("no drawing", "a-"), "");
  EXPECT_EQ(inline_svg("</svg><svg", "a-"), "");
  EXPECT_EQ(inline_svg("<?xml?><svg id=\"i\"><use href=\"#i\"/></svg>", "a-"),
            "<svg id=\"a-i\"><use href=\"#a-i\"/></svg>");
}

TEST(Page, A_figure_is_drawn_or_shown_as_pixels_or_said_to_be_missing) {
  const TemporaryFolder folder;
  put_drawing(folder, "drawn");
  write_png(folder / "figures/pixels.png", Image<glm::u8vec3>(2, 2));
  put_text(folder / "secret.svg", "<svg>secret</svg>");
  const std::string drawn = written_page(folder, with_figure("drawn", "Title", "Caption."));
  EXPECT_TRUE(contains(drawn, "role=\"img\" aria-label=\"Title. Caption.\"")) << drawn;
  EXPECT_TRUE(contains(drawn, "<strong>Figure 1.</strong> Title. Caption.\n")) << drawn;
  EXPECT_TRUE(contains(drawn, "href=\"figures/drawn.svg\">SVG<"));
  EXPECT_FALSE(contains(drawn, "href=\"figures/drawn.pdf\""));
  const std::string untitled = written_page(folder, with_figure("drawn", "", "Caption."));
  EXPECT_TRUE(contains(untitled, "role=\"img\" aria-label=\"Caption.\"")) << untitled;
  const std::string pixels = written_page(folder, with_figure("pixels", "T", "C"));
  EXPECT_TRUE(contains(pixels, "<img alt=\"T. C\" src=\"data:image/png;base64,iVBORw0KGgo")) << pixels;
  for (const std::string& stem : {std::string("absent"), std::string("../secret"), std::string("../figures/drawn"),
                                  std::string(), std::string("."), std::string("dr\0awn", 6)}) {
    const std::string missing = written_page(folder, with_figure(stem, "Title", ""));
    EXPECT_TRUE(contains(missing, "could not be drawn")) << stem;
    EXPECT_FALSE(contains(missing, "<svg")) << stem;
    EXPECT_FALSE(contains(missing, "href=\"figures/")) << stem;
    EXPECT_TRUE(contains(missing, "<strong>Figure 1.</strong> Title\n")) << stem;
    EXPECT_TRUE(contains(written_page(folder, with_figure(stem, "Title", "Caption.")), "</strong> Title. Caption.\n"));
  }
}

TEST(Page, Files_of_the_run_are_linked_when_they_are_there) {
  const TemporaryFolder folder;
  for (const char* name : {"images.exr", "sweep.csv", "experiment.toml", "summary.json"}) {
    EXPECT_FALSE(contains(written_page(folder, sample("plain")), std::string("href=\"") + name));
    put_text(folder / name, "x");
    EXPECT_TRUE(contains(written_page(folder, sample("plain")), std::string("href=\"") + name + "\""));
  }
}

TEST(Page, Equal_reports_are_equal_pages) {
  const TemporaryFolder folder;
  EXPECT_EQ(written_page(folder, sample("plain")), written_page(folder, sample("plain")));
}

TEST(Page, Headings_descend_one_level_at_a_time) {
  const TemporaryFolder folder;
  const std::string page = written_page(folder, sample("plain"));
  EXPECT_EQ(count(page, "<h1>"), 1u);
  EXPECT_EQ(count(page, "<h2 id=\"section-"), 2u);
  EXPECT_EQ(count(page, "<h3"), 0u);
  EXPECT_TRUE(contains(page, "<html lang=\"en\">"));
  EXPECT_EQ(count(page, "<main>"), 1u);
}

TEST(Page, A_place_that_cannot_be_written_is_an_error) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_page(folder / "none", sample("plain")), Error);
}

TEST(PageTable, It_has_a_caption_headers_and_a_row_of_units) {
  const TemporaryFolder folder;
  const Table table{{{"filter", "", "how"}, {"bias", "m", "along the light"}, {"mae", "1", ""}},
                    {{std::string("box"), 0.1 + 0.2, std::int64_t{5}}}};
  const std::string page = written_page(folder, with_table(table));
  EXPECT_TRUE(contains(page, "<div class=\"caption\">Table 1. Bias</div>"));
  EXPECT_TRUE(contains(page, "<th scope=\"col\" title=\"how\">filter</th>")) << page;
  EXPECT_TRUE(contains(page, "<th scope=\"col\" class=\"number\" title=\"along the light\">bias</th>")) << page;
  EXPECT_TRUE(contains(page, "<td class=\"unit number\">m</td>"));
  EXPECT_TRUE(contains(page, "<th scope=\"row\">box</th><td class=\"number\">0.3</td><td class=\"number\">5</td>"));
}

TEST(PageTable, Tables_without_rows_columns_or_cells_are_no_trouble) {
  const TemporaryFolder folder;
  EXPECT_FALSE(contains(written_page(folder, with_table({})), "<table"));
  EXPECT_FALSE(contains(written_page(folder, with_table({})), "Table 1"));
  EXPECT_TRUE(
      contains(written_page(folder, with_table({{{"a", "", ""}, {"b", "", ""}}, {}})), "colspan=\"2\">no rows<"));
  EXPECT_TRUE(contains(written_page(folder, with_table({{{"a", "", ""}, {"b", "", ""}}, {{}}})),
                       "<tr><th scope=\"row\"></th><td></td></tr>"));
}

TEST(PageTable, Texts_of_up_to_24_characters_stay_on_one_line) {
  const TemporaryFolder folder;
  const std::string brief = "<" + std::string(23, 'x');
  const Table table{{{"a", "", ""}, {"b", "", ""}}, {{std::string("r"), brief}, {std::string("r"), brief + "x"}}};
  const std::string page = written_page(folder, with_table(table));
  EXPECT_TRUE(contains(page, "<td class=\"short\">&lt;" + brief.substr(1) + "</td>")) << page;
  EXPECT_TRUE(contains(page, "<td>&lt;" + brief.substr(1) + "x</td>")) << page;
}

TEST(PageTable, A_long_table_says_how_much_of_it_is_shown) {
  const TemporaryFolder folder;
  Table table{{{"a", "1", ""}}, {}};
  table.rows.assign(501, {Value(1.0)});
  const std::string page = written_page(folder, with_table(table));
  EXPECT_TRUE(contains(page, "<div class=\"caption\">Table 1. Bias, the first 500 of 501 rows</div>"));
  EXPECT_EQ(count(page, "<td class=\"number\">1</td>"), 500u);
}

}  // namespace
}  // namespace umbrameter
