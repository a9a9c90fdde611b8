#include "raytrace/alpha_mask.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "scenes/texel_place.h"

namespace umbrameter {

AlphaMask::AlphaMask(const Scene& scene, const Material& material)
    : scene_(scene), material_(material), texture_(texture_of(scene, material)) {
  if (texture_ == nullptr) return;
  const auto width = static_cast<std::size_t>(texture_->texels.width);
  const auto height = static_cast<std::size_t>(texture_->texels.height);
  row_size_ = (width + answers_in_byte - 1) / answers_in_byte;
  answers_.resize(row_size_ * height);
  parallel_for(height, [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      const auto answer = static_cast<unsigned>(answer_near(column, row));
      std::uint8_t& byte = answers_[row * row_size_ + column / answers_in_byte];
      byte = static_cast<std::uint8_t>(byte | answer << shift_of(column));
    }
  });
}

// A footprint that begins at a texel goes on to the next, or, where the texture is mirrored, to the one before.
AlphaMask::Answer AlphaMask::answer_near(std::size_t column, std::size_t row) const {
  const auto x = static_cast<std::int64_t>(column);
  const auto y = static_cast<std::int64_t>(row);
  std::uint8_t least = std::numeric_limits<std::uint8_t>::max();
  std::uint8_t most = 0;
  for (std::int64_t v = texture_->wrap_v == Wrap::mirrored_repeat ? y - 1 : y; v <= y + 1; ++v) {
    const std::size_t first = row_of(*texture_, v) * static_cast<std::size_t>(texture_->texels.width);
    for (std::int64_t u = texture_->wrap_u == Wrap::mirrored_repeat ? x - 1 : x; u <= x + 1; ++u) {
      const std::uint8_t alpha = texture_->texels[first + column_of(*texture_, u)].w;
      least = std::min(least, alpha);
      most = std::max(most, alpha);
    }
  }
  return answer(static_cast<float>(least) / 255.0f, static_cast<float>(most) / 255.0f);
}

// Interpolation in floats may leave the range of the four values by as much as it rounds: less than 8 units of 2^-24,
// each of its six operations by one at most. Where all are alike it does not round.
AlphaMask::Answer AlphaMask::answer(float least, float most) const {
  const float factor = material_.base_color.w;
  const float cutoff = material_.alpha_cutoff;
  if (least == most) return factor * least >= cutoff ? Answer::there : Answer::open;
  constexpr double rounding = 0x1p-20;  // that of the product with the factor included
  if (static_cast<double>(factor) * (static_cast<double>(least) - rounding) >= cutoff) return Answer::there;
  if (static_cast<double>(factor) * (static_cast<double>(most) + rounding) < cutoff) return Answer::open;
  return Answer::mixed;
}

bool AlphaMask::is_there(vec2 texcoord) const {
  if (texture_ != nullptr) {
    const TexelPlace place = texel_place(*texture_, texcoord);
    const std::size_t column = column_of(*texture_, place.left);
    const unsigned byte = answers_[row_of(*texture_, place.top) * row_size_ + column / answers_in_byte];
    const auto answer = static_cast<Answer>(byte >> shift_of(column) & 3u);
    if (answer != Answer::mixed) return answer == Answer::there;
  }
  return alpha_at(scene_, material_, texcoord) >= material_.alpha_cutoff;
}

MeshMask::MeshMask(const Mesh& mesh, const AlphaMask& mask)
    : texcoords_(mesh.triangles.size(), {vec2(0), vec2(0), vec2(0)}), mask_(mask) {
  if (mesh.texcoords.empty()) return;
  for (std::size_t t = 0; t < texcoords_.size(); ++t) {
    const uvec3 v = mesh.triangles[t];
    texcoords_[t] = {mesh.texcoords[v.x], mesh.texcoords[v.y], mesh.texcoords[v.z]};
  }
}

}  // namespace umbrameter
