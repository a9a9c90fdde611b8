#include "raytrace/alpha_mask.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

constexpr std::uint32_t seed = 20261122u;

float number(std::uint32_t i, std::uint32_t purpose) { return to_unit_float(hash(i, purpose, seed)); }

// Blocks of 4² texels that are all open, all there, or of any value, so that footprints of every kind occur.
Scene masked(int width, int height, Wrap wrap_u, Wrap wrap_v) {
  Scene scene;
  Texture texture;
  texture.texels = Image<glm::u8vec4>(width, height, glm::u8vec4(0));
  texture.wrap_u = wrap_u;
  texture.wrap_v = wrap_v;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint32_t block = hash(static_cast<std::uint32_t>(y / 4 * 64 + x / 4), 1u, seed) % 3u;
      const std::uint32_t any = hash(static_cast<std::uint32_t>(y * width + x), 2u, seed) % 256u;
      texture.texels[texture.texels.index(x, y)].w = static_cast<std::uint8_t>(std::array{0u, 255u, any}[block]);
    }
  }
  scene.textures.push_back(texture);
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture = 0;
  scene.materials.push_back(material);
  return scene;
}

void expect_the_same(const Scene& scene, const AlphaMask& mask, vec2 texcoord) {
  const Material& material = scene.materials[0];
  EXPECT_EQ(mask.is_opaque(texcoord), alpha_at(scene, material, texcoord) >= material.alpha_cutoff)
      << "at " << texcoord.x << ", " << texcoord.y << " with cutoff " << material.alpha_cutoff << " and factor "
      << material.base_color.w;
}

TEST(AlphaMask, It_says_what_the_interpolated_alpha_says_everywhere) {
  constexpr std::array wraps{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {5, 4}, {19, 33}}) {
    for (const Wrap wrap_u : wraps) {
      for (const Wrap wrap_v : wraps) {
        Scene scene = masked(width, height, wrap_u, wrap_v);
        for (const auto& [cutoff, factor] : {std::pair{0.5f, 1.0f},
                                             {0.0f, 1.0f},
                                             {1.0f, 1.0f},
                                             {0.3f, 0.7f},
                                             {128.0f / 255.0f, 1.0f},
                                             {0.7f, 0.7f},
                                             {1.5f, 1.0f}}) {
          scene.materials[0].alpha_cutoff = cutoff;
          scene.materials[0].base_color.w = factor;
          const AlphaMask mask(scene, scene.materials[0]);
          for (std::uint32_t i = 0; i < 400; ++i) {
            expect_the_same(scene, mask, 5.0f * vec2(number(i, 3u), number(i, 4u)) - 2.0f);
          }
          // Texel centres, where the weights are zero, and the middles between them.
          for (int y = -2; y < 2 * height + 2; ++y) {
            for (int x = -2; x < 2 * width + 2; ++x) {
              expect_the_same(scene, mask,
                              {0.5f * static_cast<float>(x) / static_cast<float>(width),
                               0.5f * static_cast<float>(y) / static_cast<float>(height)});
            }
          }
        }
      }
    }
  }
}

TEST(AlphaMask, Coordinates_that_are_no_numbers_are_answered_alike) {
  const Scene scene = masked(19, 33, Wrap::repeat, Wrap::mirrored_repeat);
  const AlphaMask mask(scene, scene.materials[0]);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()}) {
    expect_the_same(scene, mask, {bad, bad});
    expect_the_same(scene, mask, {bad, 0.4f});
  }
}

TEST(AlphaMask, Without_a_texture_the_factor_decides) {
  Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].base_color.w = 0.25f;
  EXPECT_FALSE(AlphaMask(scene, scene.materials[0]).is_opaque({0.3f, 0.4f}));
  scene.materials[0].alpha_cutoff = 0.25f;
  EXPECT_TRUE(AlphaMask(scene, scene.materials[0]).is_opaque({0.3f, 0.4f}));
}

}  // namespace
}  // namespace umbrameter
