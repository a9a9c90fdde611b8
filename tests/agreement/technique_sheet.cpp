#include "tests/agreement/technique_sheet.h"

#include <algorithm>
#include <cmath>

#include "reports/figures/figures.h"

namespace umbrameter {

Image<glm::u8vec3> picture_of_errors(const Image<float>& truth, const Image<float>& visibility) {
  constexpr int shrink = 2;  // pixels of the image along a side of one of the picture
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

}  // namespace umbrameter
