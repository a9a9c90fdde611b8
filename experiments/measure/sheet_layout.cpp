#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/measure/contact_sheet.h"
#include "reports/files/markup.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr double a4_shape = 297.0 / 210.0;  // height by width

// Lengths in pixels of the pictures.
struct Grid {
  int columns = 1;
  double tile_width = 0.0;
  double tile_height = 0.0;
  double letter = 0.0;          // font size of the purpose
  std::vector<int> text_lines;  // of the longest purpose in each row

  // In three columns or more a letter is 1/22 of a picture's width: 7 points on A4.
  static double letter_of(double tile_width, int columns) {
    return tile_width * (0.02 + 0.0085 * std::min(columns, 3));
  }
  double margin() const { return 2.4 * letter; }
  double gap() const { return 1.6 * letter; }
  double header() const { return 3.2 * letter; }
  double line() const { return 1.35 * letter; }
  // From the top of a row of pictures to the top of the next.
  double row_height(std::size_t row) const { return tile_height + 3.4 * letter + line() * text_lines[row]; }
  double row_top(std::size_t row) const {
    double top = margin() + header();
    for (std::size_t above = 0; above < row; ++above) top += row_height(above);
    return top;
  }
  double width() const { return 2 * margin() + columns * tile_width + (columns - 1) * gap(); }
  double height() const { return row_top(text_lines.size()) - 1.4 * letter + margin(); }
};

std::vector<std::string> broken(const std::string& text, double widest) {
  std::vector<std::string> lines;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    start = end + 1;
    if (word.empty()) continue;
    if (lines.empty() || text_width(lines.back() + " " + word) > widest) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

Grid grid_of(const std::vector<SheetTile>& tiles, int columns) {
  Grid grid;
  grid.columns = columns;
  grid.tile_width = tiles.front().picture.width;
  grid.tile_height = tiles.front().picture.height;
  grid.letter = Grid::letter_of(grid.tile_width, columns);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) == 0) grid.text_lines.push_back(1);
    const auto lines = static_cast<int>(broken(tiles[i].purpose, grid.tile_width / grid.letter).size());
    grid.text_lines.back() = std::max(grid.text_lines.back(), lines);
  }
  return grid;
}

Grid best_grid(const std::vector<SheetTile>& tiles) {
  Grid best = grid_of(tiles, 1);
  const auto misfit = [](const Grid& grid) { return std::abs(std::log(grid.height() / grid.width() / a4_shape)); };
  for (int columns = 2; columns <= static_cast<int>(tiles.size()); ++columns) {
    const Grid grid = grid_of(tiles, columns);
    if (misfit(grid) < misfit(best)) best = grid;
  }
  return best;
}

std::string text(double x, double y, double size, const std::string& content, const char* more = "") {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\"{}>{}</text>\n", x, y, size, more,
                     escape_markup(content));
}

std::string tile_markup(const SheetTile& tile, const Grid& grid, double x, double y) {
  std::string svg =
      fmt::format("<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" xlink:href=\"{}\"/>\n", x, y,
                  grid.tile_width, grid.tile_height, data_uri("image/png", to_png(tile.picture)));
  const double name_line = y + grid.tile_height + 1.55 * grid.letter;
  svg += text(x, name_line, 1.15 * grid.letter, tile.name, " font-weight=\"bold\"");
  svg += text(x + grid.tile_width, name_line, 0.85 * grid.letter, tile.facts, " text-anchor=\"end\" fill=\"#555555\"");
  double line = name_line;
  for (const std::string& part : broken(tile.purpose, grid.tile_width / grid.letter)) {
    svg += text(x, line += grid.line(), grid.letter, part);
  }
  return svg;
}

}  // namespace

std::string draw_sheet(const std::string& title, const std::vector<SheetTile>& tiles) {
  const Grid grid = best_grid(tiles);
  const double width = std::ceil(grid.width());
  const double height = std::ceil(grid.height());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" "
      "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, sans-serif\" "
      "fill=\"#1a1a1a\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width, height);
  svg += text(grid.margin(), grid.margin() + 1.4 * grid.letter, 1.7 * grid.letter, title, " font-weight=\"bold\"");
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const std::size_t columns = static_cast<std::size_t>(grid.columns);
    const auto column = static_cast<double>(i % columns);
    // Whole pixels, so that a picture is not resampled.
    svg += tile_markup(tiles[i], grid, std::round(grid.margin() + column * (grid.tile_width + grid.gap())),
                       std::round(grid.row_top(i / columns)));
  }
  return svg + "</svg>\n";
}

}  // namespace umbrameter
