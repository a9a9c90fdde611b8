#include "tests/agreement/labelled_sheet.h"

#include <fmt/format.h>

#include "reports/files/markup.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr int gap = 6;       // px
constexpr int letters = 13;  // px

}  // namespace

std::string labelled_sheet(const std::vector<SheetCell>& cells, int columns) {
  const int width = cells.front().picture.width;
  const int height = cells.front().picture.height;
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  const int row_height = height + letters + 2 * gap;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans\" font-size=\"{2}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      columns * (width + gap) + gap, rows * row_height + gap, letters);
  int at = 0;
  for (const SheetCell& cell : cells) {
    const int x = gap + (at % columns) * (width + gap);
    const int y = gap + (at / columns) * row_height;
    ++at;
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y + letters, escape_markup(cell.label));
    svg += fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" xlink:href=\"{}\"/>\n", x,
                       y + letters + gap, width, height, data_uri("image/png", to_png(cell.picture)));
  }
  return svg + "</svg>\n";
}

}  // namespace umbrameter
