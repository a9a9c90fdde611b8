#include "scenes/builtin/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace umbrameter::builtin {
namespace {

// Alpha is how much of each texel lies where `inside` holds, from 4×4 samples. x and y run from 0 to 1, y up.
Texture cut_out(const char* name, int width, int height, const std::function<bool(double, double)>& inside,
                const std::function<glm::u8vec4(double, double)>& color) {
  constexpr int samples = 4;
  Texture texture;
  texture.name = name;
  texture.texels = Image<glm::u8vec4>(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      int hits = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const double x = (column + (i % samples + 0.5) / samples) / width;
        const double y = 1.0 - (row + (std::floor(i / samples) + 0.5) / samples) / height;
        if (inside(x, y)) ++hits;
      }
      glm::u8vec4 texel = color((column + 0.5) / width, 1.0 - (row + 0.5) / height);
      texel.w = static_cast<glm::u8>(hits * 255 / (samples * samples));
      texture.texels.at(column, row) = texel;
    }
  }
  return texture;
}

bool near_circle(double x, double y, double radius, double half_width) {
  return std::abs(std::hypot(x, y) - radius) < half_width;
}

// A blade from the origin along +x, `length` long.
bool in_blade(double x, double y, double length, double half_width) {
  if (x <= 0.0 || x >= length) return false;
  const double t = x / length;
  return std::abs(y) < half_width * 3.1 * t * (1.0 - t) * (1.25 - 0.5 * t);
}

}  // namespace

Texture wrought_iron() {
  // The panel is 2 × 1.5; seven bars.
  const auto inside = [](double u, double v) {
    const double x = 2.0 * u;
    const double y = 1.5 * v;
    constexpr double pitch = 2.0 / 7.0;
    const double from_bar = x - (std::floor(x / pitch) + 0.5) * pitch;
    const double from_gap = x - std::round(x / pitch) * pitch;
    for (const double rail : {0.06, 0.36, 1.14}) {
      if (std::abs(y - rail) < 0.02) return true;
    }
    if (y > 0.04 && y < 1.33 && std::abs(from_bar) < 0.013) return true;
    // Spear heads.
    if (y >= 1.28 && y < 1.47 && std::abs(from_bar) < 0.045 * std::min((1.47 - y) / 0.12, (y - 1.26) / 0.06))
      return true;
    // Rings between the lower rails and lyres below the upper one.
    if (near_circle(from_gap, y - 0.21, 0.105, 0.012) || near_circle(from_gap, y - 0.21, 0.04, 0.012)) return true;
    return y > 0.9 && near_circle(from_gap, y - 1.01, 0.1, 0.011) && from_gap * from_gap < 0.012;
  };
  return cut_out("wrought iron", 256, 192, inside, [](double, double) { return glm::u8vec4(40, 48, 46, 255); });
}

Texture leaf_spray() {
  struct Leaf {
    double y, angle, length;
  };
  static constexpr std::array<Leaf, 9> leaves{{{0.12, 32, 0.40},
                                               {0.12, 148, 0.40},
                                               {0.27, 36, 0.44},
                                               {0.27, 144, 0.44},
                                               {0.44, 42, 0.40},
                                               {0.44, 138, 0.40},
                                               {0.58, 52, 0.33},
                                               {0.58, 128, 0.33},
                                               {0.62, 90, 0.36}}};
  const auto inside = [](double x, double y) {
    if (std::abs(x - 0.5) < 0.012 && y < 0.7) return true;
    return std::any_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
      const double c = std::cos(leaf.angle * pi / 180.0);
      const double s = std::sin(leaf.angle * pi / 180.0);
      const double dx = x - 0.5;
      const double dy = y - leaf.y;
      return in_blade(c * dx + s * dy, c * dy - s * dx, leaf.length, 0.085);
    });
  };
  const auto color = [](double x, double y) {
    const double shade = 0.85 + 0.25 * y - 0.25 * std::abs(x - 0.5);
    return glm::u8vec4(static_cast<glm::u8>(82 * shade), static_cast<glm::u8>(118 * shade),
                       static_cast<glm::u8>(52 * shade), 255);
  };
  return cut_out("leaf spray", 128, 128, inside, color);
}

Texture cloth_stripes(const glm::u8vec4& first, const glm::u8vec4& second) {
  Texture texture;
  texture.name = "stripes";
  texture.texels = Image<glm::u8vec4>(32, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 32; ++x) texture.texels.at(x, y) = x < 16 ? first : second;
  }
  return texture;
}

}  // namespace umbrameter::builtin
