#include "raytrace/alpha_mask.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "scenes/material.h"
#include "scenes/texel_place.h"

namespace umbrameter {

AlphaMask::AlphaMask(const Scene& scene, const Material& material)
    : scene_(scene), material_(material), texture_(texture_of(scene, material)) {
  if (texture_ == nullptr) return;
  const auto width = static_cast<std::size_t>(texture_->texels.width);
  const auto height = static_cast<std::size_t>(texture_->texels.height);
  row_bytes_ = (width + texels_per_byte - 1) / texels_per_byte;
  coverage_.resize(row_bytes_ * height);
  parallel_for(height, [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      const auto coverage = static_cast<unsigned>(coverage_from(column, row));
      std::uint8_t& byte = coverage_[row * row_bytes_ + column / texels_per_byte];
      byte = static_cast<std::uint8_t>(byte | coverage << shift_of(column));
    }
  });
}

// A footprint that begins at a texel includes the next one or, in a mirrored copy of the texture, the one before.
AlphaMask::Coverage AlphaMask::coverage_from(std::size_t column, std::size_t row) const {
  const auto x = static_cast<std::int64_t>(column);
  const auto y = static_cast<std::int64_t>(row);
  std::uint8_t min_alpha = std::numeric_limits<std::uint8_t>::max();
  std::uint8_t max_alpha = 0;
  for (std::int64_t v = texture_->wrap_v == Wrap::mirrored_repeat ? y - 1 : y; v <= y + 1; ++v) {
    const std::size_t first = row_of(*texture_, v) * static_cast<std::size_t>(texture_->texels.width);
    for (std::int64_t u = texture_->wrap_u == Wrap::mirrored_repeat ? x - 1 : x; u <= x + 1; ++u) {
      const std::uint8_t alpha = texture_->texels[first + column_of(*texture_, u)].w;
      min_alpha = std::min(min_alpha, alpha);
      max_alpha = std::max(max_alpha, alpha);
    }
  }
  return coverage_between(static_cast<float>(min_alpha) / 255.0f, static_cast<float>(max_alpha) / 255.0f);
}

// Interpolation in floats may leave the range of the four values by its rounding: less than 8 units of 2^-24, since
// each of its six operations rounds by at most one. Equal values are interpolated without rounding.
AlphaMask::Coverage AlphaMask::coverage_between(float min_alpha, float max_alpha) const {
  const float factor = material_.base_color.w;
  const float cutoff = material_.alpha_cutoff;
  if (min_alpha == max_alpha) return factor * min_alpha >= cutoff ? Coverage::opaque : Coverage::transparent;
  constexpr double rounding = 0x1p-20;  // includes that of the product with the factor
  if (static_cast<double>(factor) * (static_cast<double>(min_alpha) - rounding) >= cutoff) return Coverage::opaque;
  if (static_cast<double>(factor) * (static_cast<double>(max_alpha) + rounding) < cutoff) return Coverage::transparent;
  return Coverage::mixed;
}

bool AlphaMask::is_opaque(vec2 texcoord) const {
  if (texture_ != nullptr) {
    const TexelPlace place = texel_place(*texture_, texcoord);
    const std::size_t column = column_of(*texture_, place.left);
    const unsigned byte = coverage_[row_of(*texture_, place.top) * row_bytes_ + column / texels_per_byte];
    const auto coverage = static_cast<Coverage>(byte >> shift_of(column) & 3u);
    if (coverage != Coverage::mixed) return coverage == Coverage::opaque;
  }
  return alpha_at(scene_, material_, texcoord) >= material_.alpha_cutoff;
}

}  // namespace umbrameter
