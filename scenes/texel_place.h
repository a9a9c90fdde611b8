// Where a texture coordinate lies between the texels of a texture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scenes/scene.h"

namespace umbrameter {

/// Index from 0 to size − 1 of a texel that may lie outside the texture (glTF 2.0, section 3.8.4.5).
inline std::size_t wrap_texel(std::int64_t texel, int size, Wrap wrap) {
  const std::int64_t n = size;
  if (texel >= 0 && texel < n) return static_cast<std::size_t>(texel);
  switch (wrap) {
    case Wrap::clamp_to_edge:
      return static_cast<std::size_t>(std::clamp<std::int64_t>(texel, 0, n - 1));
    case Wrap::mirrored_repeat: {
      const std::int64_t folded = ((texel % (2 * n)) + 2 * n) % (2 * n);
      return static_cast<std::size_t>(folded < n ? folded : 2 * n - 1 - folded);
    }
    case Wrap::repeat:
      break;
  }
  return static_cast<std::size_t>(((texel % n) + n) % n);
}

inline std::size_t column_of(const Texture& texture, std::int64_t texel) {
  return wrap_texel(texel, texture.texels.width, texture.wrap_u);
}
inline std::size_t row_of(const Texture& texture, std::int64_t texel) {
  return wrap_texel(texel, texture.texels.height, texture.wrap_v);
}

/// The first of the two columns and rows of texels about a texture coordinate, before wrapping, and the weight of the
/// second, 0 to 1.
struct TexelPlace {
  std::int64_t left = 0;
  std::int64_t top = 0;
  float right = 0.0f;
  float down = 0.0f;
};

/// Coordinates that are not finite are taken for the texture's corner.
inline TexelPlace texel_place(const Texture& texture, vec2 texcoord) {
  // Beyond this the coordinate has no fractional texels left, and the integer conversion would overflow.
  constexpr double limit = 1e9;
  const auto continuous = [&](float coordinate, int size) {
    const double texel = static_cast<double>(coordinate) * size - 0.5;
    return std::isfinite(texel) ? std::clamp(texel, -limit, limit) : 0.0;
  };
  const double x = continuous(texcoord.x, texture.texels.width);
  const double y = continuous(texcoord.y, texture.texels.height);
  const double left = std::floor(x);
  const double top = std::floor(y);
  return {static_cast<std::int64_t>(left), static_cast<std::int64_t>(top), static_cast<float>(x - left),
          static_cast<float>(y - top)};
}

}  // namespace umbrameter
