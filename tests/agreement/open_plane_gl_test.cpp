// What an open plane loses, as docs/ambient-occlusion/invariants.md gives it against the radius in pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "ao_invariants.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

class OpenPlaneGl : public test::GlFixture {
 protected:
  // Mean on the axis at 60 degrees, in thousandths.
  double loss(AoTechniques::Choice technique, int height) const {
    return 1000.0 * open_plane_darkening(context(), params_of(technique), {60.0, false, height, 8}).mean;
  }
  // The settings that the page states.
  static AoParams params_of(AoTechniques::Choice technique) {
    AoParams params;
    params.technique = technique;
    params.sampling.radius = 0.5;
    params.bias.depth = 0.025;
    params.blur.kind = AoBlur::box;
    return params;
  }
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream parts(line);
  for (std::string cell; std::getline(parts, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    if (first != std::string::npos) cells.push_back(cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

// The number in a table's row and column, below a heading.
std::optional<double> number_below(const std::string& page, const std::string& heading, const std::string& row,
                                   const std::string& column) {
  std::istringstream lines(page.substr(std::min(page.find(heading), page.size())));
  std::vector<std::string> head;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('|')) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (head.empty()) head = cells;
    for (std::size_t i = 1; i < cells.size() && cells[0] == row; ++i) {
      if (head.at(i) == column) return std::stod(cells[i]);
    }
  }
  return std::nullopt;
}

TEST_F(OpenPlaneGl, Loses_what_the_documentation_says_at_each_radius_in_pixels) {
  const std::string page = text_of(UMBRAMETER_DOCS "/ambient-occlusion/invariants.md");
  for (const auto& [technique, row] : {std::pair(AoTechniques::choice<Hbao>, "HBAO"),
                                       {AoTechniques::choice<Gtao>, "GTAO, slices even in the image"},
                                       {AoTechniques::choice<Bitmask>, "bitmask, rounded up"}}) {
    for (const int height : {40, 80}) {
      const std::string radius = std::to_string(std::lround(radius_in_pixels(params_of(technique), height)));
      const auto stated = number_below(page, "### Against the radius in pixels", row, "60°, r = " + radius);
      ASSERT_TRUE(stated) << row << ", r = " << radius;
      // One decimal; and what rounds sectors up covers a whole one more where a driver's arc cosine ends a bit higher.
      EXPECT_NEAR(loss(technique, height), *stated, row == std::string("bitmask, rounded up") ? 0.2 : 0.1)
          << row << ", r = " << radius;
    }
  }
  // Twice the radius in pixels halves the darkening of HBAO.
  EXPECT_NEAR(loss(AoTechniques::choice<Hbao>, 40) / loss(AoTechniques::choice<Hbao>, 80), 2.0, 0.2);
}

}  // namespace
}  // namespace umbrameter
