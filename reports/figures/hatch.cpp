#include "reports/figures/hatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbrameter {
namespace {

constexpr double light_ground = 60.0;  // CIE L*

// Of a line or of a dot, for this distance of the lines.
int line_width(int period) { return std::max(1, (period + 2) / 5); }

}  // namespace

double lightness(const glm::u8vec3& color) {
  const auto linear = [](int byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(color.x) + 0.7152 * linear(color.y) + 0.0722 * linear(color.z);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

glm::u8vec3 hatch_ink(const glm::u8vec3& ground) {
  return lightness(ground) > light_ground ? glm::u8vec3(30, 30, 30) : glm::u8vec3(255, 255, 255);
}

bool is_hatched(Hatch hatch, int x, int y, int period) {
  const int width = line_width(period);
  switch (hatch) {
    case Hatch::none:
      return false;
    case Hatch::rising:
      return (x + y) % period < width;
    case Hatch::falling:
      return (x + period - y % period) % period < width;
    case Hatch::horizontal:
      return y % period < width;
    case Hatch::dots: {
      const int shift = y / period % 2 * (period / 2);  // rows of dots stand in the gaps of their neighbours
      const int size = width + std::max(1, width / 2);
      return y % period < size && (x + shift) % period < size;
    }
  }
  return false;
}

Image<std::uint8_t> hatchable(const Image<std::uint8_t>& category, int side) {
  const auto [width, height] = std::pair(category.width, category.height);
  Image<int> square(width, height, 1);  // side of the largest square of one category that ends at the pixel
  for (int y = 1; y < height; ++y) {
    for (int x = 1; x < width; ++x) {
      const std::uint8_t own = category.at(x, y);
      if (category.at(x - 1, y) != own || category.at(x, y - 1) != own || category.at(x - 1, y - 1) != own) continue;
      square.at(x, y) = 1 + std::min({square.at(x - 1, y), square.at(x, y - 1), square.at(x - 1, y - 1)});
    }
  }
  // From their last corner the squares reach back along rows, and these along columns.
  Image<int> reach(width, height);
  for (int y = height; y-- > 0;) {
    for (int x = width; x-- > 0;) {
      reach.at(x, y) = square.at(x, y) >= side ? side : x + 1 < width ? std::max(0, reach.at(x + 1, y) - 1) : 0;
    }
  }
  Image<std::uint8_t> result(width, height);
  for (int x = 0; x < width; ++x) {
    int rows = 0;
    for (int y = height; y-- > 0;) {
      rows = reach.at(x, y) > 0 ? side : std::max(0, rows - 1);
      result.at(x, y) = rows > 0;
    }
  }
  return result;
}

std::string hatch_pattern(const std::string& id, Hatch hatch, const glm::u8vec3& ground, int period) {
  const auto hex = [](const glm::u8vec3& c) { return fmt::format("#{:02x}{:02x}{:02x}", c.x, c.y, c.z); };
  const double p = period;
  const double width = line_width(period);
  std::string path;
  switch (hatch) {
    case Hatch::none:
      break;
    case Hatch::rising:  // with the corners, so that lines join across tiles
      path = fmt::format("M0,{0:g}L{0:g},0M{1:g},{2:g}L{2:g},{1:g}M{3:g},{4:g}L{4:g},{3:g}", p, -0.25 * p, 0.25 * p,
                         0.75 * p, 1.25 * p);
      break;
    case Hatch::falling:
      path = fmt::format("M0,0L{0:g},{0:g}M{1:g},{2:g}L{3:g},{4:g}M{2:g},{1:g}L{4:g},{3:g}", p, -0.25 * p, 0.75 * p,
                         0.25 * p, 1.25 * p);
      break;
    case Hatch::horizontal:
      path = fmt::format("M0,{0:g}H{1:g}", 0.5 * p, p);
      break;
    case Hatch::dots:
      path = fmt::format("M{0:g},{1:g}h{2:g}", 0.5 * (p - width), 0.5 * p, width);
      break;
  }
  const std::string lines = path.empty() ? ""
                                         : fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:g}\"/>", path,
                                                       hex(hatch_ink(ground)), width);
  return fmt::format(
      "<pattern id=\"{0}\" patternUnits=\"userSpaceOnUse\" width=\"{1}\" height=\"{1}\"><rect width=\"{1}\" "
      "height=\"{1}\" fill=\"{2}\"/>{3}</pattern>",
      id, period, hex(ground), lines);
}

}  // namespace umbrameter
