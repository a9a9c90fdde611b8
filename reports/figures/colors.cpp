#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "reports/figures/color_table.h"
#include "reports/figures/figures.h"
#include "reports/files/output.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

constexpr glm::u8vec3 not_a_number_color{255, 0, 255};

// IEC 61966-2-1.
std::uint8_t to_srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

// Ottosson, A perceptual color space for image processing, 2020: Oklab to linear sRGB.
glm::u8vec3 from_oklab(const dvec3& lab) {
  const double l = std::pow(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z, 3.0);
  const double m = std::pow(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z, 3.0);
  const double s = std::pow(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z, 3.0);
  return {to_srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

dvec3 from_polar(double lightness, double chroma, double hue_degrees) {
  const double hue = hue_degrees * pi / 180.0;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

// Even steps of lightness from near black to near white; a tint that turns from blue to yellow keeps the middle greys
// apart from the greys of the page. Lightness alone carries the value, so it survives a grey print.
dvec3 sequential(double t) {
  const double tint = 0.045 * std::sin(pi * t);
  return from_polar(0.12 + 0.86 * t, tint, 265.0 - 170.0 * t);
}

// Hues 262° and 30° are told apart with every kind of colour blindness. Lightness falls evenly and alike from the
// middle.
dvec3 diverging(double t) {
  const double x = 2.0 * t - 1.0;
  return x < 0.0 ? from_polar(0.97 + 0.49 * x, -0.18 * x, 262.0) : from_polar(0.97 - 0.49 * x, 0.18 * x, 30.0);
}

}  // namespace

ColorTable color_table(ColorMap map) {
  ColorTable table;
  for (int i = 0; i < color_table_size; ++i) {
    const double t = static_cast<double>(i) / (color_table_size - 1);
    table[static_cast<std::size_t>(i)] = from_oklab(map == ColorMap::error ? diverging(t) : sequential(t));
  }
  return table;
}
Image<glm::u8vec3> colorize(const Image<float>& values, const ColorScale& scale) {
  const ColorTable table = color_table(scale.map);
  const double range = scale.last - scale.first;
  Image<glm::u8vec3> colors(values.width, values.height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (std::isnan(value)) {
      colors[i] = not_a_number_color;
      continue;
    }
    const double t = range != 0.0 ? std::clamp((value - scale.first) / range, 0.0, 1.0) : 0.5;
    colors[i] = table[static_cast<std::size_t>(std::lround(t * (color_table_size - 1)))];
  }
  return colors;
}

Image<glm::u8vec3> tone_map(const Image<vec3>& linear, float exposure) {
  Image<glm::u8vec3> colors(linear.width, linear.height);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const dvec3 color(linear[i] * exposure);
    const bool is_number = color.x == color.x && color.y == color.y && color.z == color.z;
    colors[i] = is_number ? glm::u8vec3(to_srgb_byte(color.x), to_srgb_byte(color.y), to_srgb_byte(color.z))
                          : not_a_number_color;
  }
  return colors;
}

void write_png(const std::filesystem::path& path, const Image<glm::u8vec3>& image) {
  if (image.empty()) throw Error(ExitCode::partial, "cannot write " + path.string(), "the image has no pixels");
  write_text(path, to_png(image));
}

}  // namespace umbrameter
