#include "tests/agreement/technique_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/figures.h"
#include "reports/files/markup.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr int columns = 4;
constexpr int gap = 6;       // px
constexpr int letters = 13;  // px
constexpr int shrink = 2;    // pixels of the image along a side of one of the picture

Image<glm::u8vec3> picture(const Image<float>& truth, const Image<float>& visibility) {
  const ColorScale scale{ColorMap::error, -1.0, 1.0, ""};
  Image<float> error(truth.width, truth.height);
  std::transform(visibility.pixels.begin(), visibility.pixels.end(), truth.pixels.begin(), error.pixels.begin(),
                 [](float drawn, float lit) { return lit < 0.0f ? 0.0f : drawn - lit; });
  const Image<glm::u8vec3> colors = colorize(error, scale);
  Image<glm::u8vec3> small(truth.width / shrink, truth.height / shrink);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      vec3 sum(0.0f);
      for (int s = 0; s < shrink * shrink; ++s) {
        const std::size_t i = truth.index(shrink * x + s % shrink, shrink * y + s / shrink);
        const float grey = truth[i] < 0.0f ? 255.0f : 150.0f + 70.0f * truth[i];
        sum += glm::mix(vec3(grey), vec3(colors[i]), std::min(1.0f, std::abs(error[i]) * 1.5f));
      }
      small.at(x, y) = glm::u8vec3(sum / static_cast<float>(shrink * shrink) + 0.5f);
    }
  }
  return small;
}

}  // namespace

std::string technique_sheet(const Image<float>& truth, const std::vector<TechniqueCell>& cells) {
  const int width = truth.width / shrink;
  const int height = truth.height / shrink;
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  const int row_height = height + letters + 2 * gap;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans\" font-size=\"{2}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      columns * (width + gap) + gap, rows * row_height + gap, letters);
  int at = 0;
  for (const TechniqueCell& cell : cells) {
    const int x = gap + (at % columns) * (width + gap);
    const int y = gap + (at / columns) * row_height;
    ++at;
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y + letters, escape_markup(cell.label));
    svg +=
        fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" xlink:href=\"{}\"/>\n", x, y + letters + gap,
                    width, height, data_uri("image/png", to_png(picture(truth, cell.visibility))));
  }
  return svg + "</svg>\n";
}

}  // namespace umbrameter
