// The outputs of one sweep say the same about its cell of least error: sweep.csv, results.sqlite, summary.json, page.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <span>
#include <sstream>

#include "core/table.h"
#include "results/number_text.h"
#include "store/results_store.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using TextRow = std::map<std::string, std::string>;

struct SweepOutputs : GlRun {
  // Runs the sweep and returns its summary.
  Json sweep(const std::string& scene, const std::vector<std::string>& axes,
             const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {"sweep", scene, "-o", out()};
    for (const std::string& axis : axes) command.insert(command.end(), {"--vary", axis});
    const ProgramResult result = run_program(words(words(command, more), small));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(text_of(folder_ / "out/summary.json"));
  }
  fs::path out() const { return folder_ / "out"; }
};

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    cells.push_back(cell);
  }
  return cells;
}

std::vector<TextRow> csv_rows(const fs::path& path) {
  std::istringstream lines(text_of(path));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<TextRow> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    TextRow row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells.at(i);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<TextRow> stored_rows(const fs::path& folder) {
  const ResultsStore store = ResultsStore::load(folder);
  std::vector<TextRow> rows;
  store.read({}, [&](std::span<const Value> values) {
    TextRow row;
    for (std::size_t i = 0; i < values.size(); ++i) {
      row[store.description().columns[i].column.name] = to_string(values[i]);
    }
    rows.push_back(std::move(row));
  });
  return rows;
}

// The row of the least error, the first of equals.
TextRow least_of(const std::vector<TextRow>& rows) {
  return *std::min_element(rows.begin(), rows.end(), [](const TextRow& a, const TextRow& b) {
    return std::stod(a.at("mae")) < std::stod(b.at("mae"));
  });
}

std::string text_in(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// What stands in the cell after the row's name in the table of that caption.
std::string table_text(const std::string& page, const std::string& caption, const std::string& row) {
  const std::regex pattern("<div class=\"caption\">(Table [0-9]+\\. )?" + caption);
  std::smatch found;
  if (!std::regex_search(page, found, pattern)) return "no table " + caption;
  const auto table = static_cast<std::size_t>(found.position());
  const std::size_t name = page.find("<th scope=\"row\">" + row, table);
  if (name == std::string::npos || name > page.find("</table>", table)) return "no row " + row;
  const std::size_t begin = page.find('>', page.find("<td", name)) + 1;
  return page.substr(begin, page.find('<', begin) - begin);
}

// All columns of the row of least error in all four outputs; `statistics` is what summary.json measured.
void expect_one_cell(const fs::path& out, const Json& summary, const Json& statistics, const std::string& caption) {
  const TextRow row = least_of(csv_rows(out / "sweep.csv"));
  EXPECT_EQ(least_of(stored_rows(out)), row);
  const std::string page = text_of(out / "index.html");
  ASSERT_TRUE(summary.contains("cell"));
  std::size_t measured = 0;
  for (const auto& [name, text] : row) {
    if (summary.at("cell").contains(name)) {
      for (const Json& value : {summary["cell"][name], summary.at("parameters").at(name)}) {
        if (value.is_number()) {
          EXPECT_EQ(value.get<double>(), std::stod(text)) << name;
        } else {
          EXPECT_EQ(text_in(value), text) << name;
        }
      }
      continue;
    }
    ++measured;
    ASSERT_TRUE(statistics.contains(name)) << name;
    EXPECT_EQ(statistics[name].get<double>(), std::stod(text)) << name;
  }
  EXPECT_GT(measured, 5u);
  EXPECT_EQ(summary["cell"].size(), summary.at("sweep").at("axes").size());
  // The page has per cent, with its interval and the digits that this or three significant ones leave.
  const auto number = [&](const std::string& name) { return std::stod(row.at(name)); };
  for (const char* share : {"mae", "rmse"}) {
    const bool has_interval = row.contains(lower_name(share));
    const std::string shown =
        has_interval ? share_text(Estimate{number(share), number(lower_name(share)), number(upper_name(share))})
                     : share_text(number(share));
    EXPECT_EQ(table_text(page, caption, share), shown) << share;
  }
}

TEST_F(SweepOutputs, A_slip_in_an_axis_shows_before_anything_is_measured) {
  for (const auto& [axis, message] : {std::pair{"view.camera=0,nope", "--camera nope: the scene has no such camera"},
                                      {"view.light=sun,moon", "--light moon: the scene has no such light"},
                                      {"light.angle=0.5,-0.5", "its angular diameter is below 0"}}) {
    const ProgramResult result =
        run_program(words({"sweep", "corner", "-o", out(), "--light", "sun", "--vary", axis}, small));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out())) << "no cell is stored";
  }
}

TEST_F(SweepOutputs, Agree_on_the_cell_of_least_error_over_bias_and_resolution) {
  // No value of the axes is the parameter's default.
  const Json summary = sweep("contact-box", {"shadow.constant-bias=0.05:0.2:4", "shadow.resolution=128,256"},
                             {"--light", "0", "--shadow.filter", "box"});
  const Json& shadow = summary.at("shadows").at(0);
  expect_one_cell(out(), summary, shadow.at("statistics"), "Visibility error:");
  const double bias = summary.at("cell").at("shadow.constant-bias");
  const double texel = shadow.at("map").at("mean_texel_m");
  EXPECT_EQ(shadow.at("constant_bias").at("m"), bias);
  EXPECT_DOUBLE_EQ(shadow.at("constant_bias").at("texels"), bias / texel);
  EXPECT_DOUBLE_EQ(shadow.at("constant_bias").at("normalised_depth"),
                   bias / shadow.at("map").at("far_depth_m").get<double>());
  expect_same_page_in_report(out(), folder_ / "again", {"mae.svg", "causes.pdf", "pareto_front.png", "class_sun.svg"});
  EXPECT_EQ(shadow.at("map").at("resolution_texels"), summary["cell"].at("shadow.resolution"));
  const std::string page = text_of(out() / "index.html");
  EXPECT_NEAR(std::stod("0" + table_text(page, "Constant bias of these images", "along the light")), bias, 1e-6);
  EXPECT_EQ(table_text(page, "Every parameter of this run", "shadow.constant-bias"), "varied: 0.05:0.2:4");
  EXPECT_EQ(table_text(page, "Every parameter of this run", "shadow.filter"), "box");
}

TEST_F(SweepOutputs, Agree_on_the_cell_of_least_error_over_ambient_occlusion) {
  const Json summary = sweep("corner", {"ao.radius=0.25,1", "ao.samples=8,16"});
  expect_one_cell(out(), summary, summary.at("ao").at("statistics"), "Ambient occlusion error");
  EXPECT_EQ(summary.at("shadows").size(), 0u);
  expect_same_page_in_report(out(), folder_ / "again", {"mae.svg", "error_ao.png"});
  const std::string samples = summary.at("cell").at("ao.samples").dump();
  const std::string radius = summary["cell"].at("ao.radius") == 1.0 ? "1 m" : "25 cm";
  EXPECT_NE(text_of(out() / "index.html").find(samples + " samples, radius " + radius), std::string::npos);
}

TEST_F(SweepOutputs, Agree_on_the_cell_of_least_error_over_slope_bias_and_light) {
  const Json summary = sweep("courtyard", {"shadow.slope-bias=0.5,1.5", "view.light=spot,sun"});
  const Json& shadow = summary.at("shadows").at(0);
  expect_one_cell(out(), summary, shadow.at("statistics"),
                  "Visibility error: " + text_in(summary.at("cell").at("view.light")));
  EXPECT_EQ(shadow.at("light"), summary["cell"]["view.light"]);
  EXPECT_NE(text_of(out() / "index.html")
                .find("slope-scaled bias " + std::string(summary["cell"]["shadow.slope-bias"] == 0.5 ? "0.5" : "1.5") +
                      " texels"),
            std::string::npos);
}

}  // namespace
}  // namespace umbrameter
