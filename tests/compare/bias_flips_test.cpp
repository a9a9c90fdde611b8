#include "compare/bias_flips.h"

#include <gtest/gtest.h>

#include <vector>

namespace umbrameter {
namespace {

constexpr std::uint32_t whole = 1u << 24;

// A row of pixels: acne that is lit from a critical bias on, then pixels that stay lit.
struct Row {
  std::vector<double> critical;
  int lit = 0;

  int width() const { return static_cast<int>(critical.size()) + lit; }
  Image<float> frame(double bias) const {
    Image<float> drawn(width(), 1, 1.0f);
    for (std::size_t i = 0; i < critical.size(); ++i) drawn[i] = bias >= critical[i] ? 1.0f : 0.0f;
    return drawn;
  }
  OwnSurfaceFlips flips(const std::vector<double>& biases, int* frames = nullptr) const {
    WrongTaps least{Image<uvec4>(width(), 1, uvec4(0)), whole};
    for (std::size_t i = 0; i < critical.size(); ++i) {
      if (biases.front() < critical[i]) least.weights[i].x = whole;
    }
    return find_own_surface_flips(least, Image<PixelExclusion>(width(), 1, PixelExclusion::none),
                                  Image<float>(width(), 1, 1.0f), biases.size(), [&](std::size_t i) {
                                    if (frames != nullptr) ++*frames;
                                    return frame(biases[i]);
                                  });
  }
};

TEST(BiasFlips, The_bias_of_the_own_surface_lights_two_thirds_of_the_acne_and_is_found_by_bisection) {
  Row row;
  for (int i = 1; i <= 30; ++i) row.critical.push_back(0.1 * i - 0.01);
  std::vector<double> biases;
  for (int i = 0; i <= 64; ++i) biases.push_back(0.1 * i);
  int frames = 0;
  const OwnSurfaceFlips flips = row.flips(biases, &frames);
  ASSERT_EQ(flips.problem, FlipProblem::none);
  EXPECT_EQ(flips.bias, 20u);  // 20 of 30 pixels are lit at 2.0
  EXPECT_EQ(flips.visibility.pixels, row.frame(2.0).pixels);
  EXPECT_LE(frames, 2 + 6);  // both ends, and log2 of 64
}

TEST(BiasFlips, A_sweep_that_cannot_show_the_own_surface_is_refused_with_the_reason) {
  const Row row{{0.4, 0.5, 0.9, 1.4}, 6};
  EXPECT_EQ(row.flips({0.0, 0.45, 1.0, 2.0}).problem, FlipProblem::none);
  EXPECT_EQ(row.flips({0.0, 0.45, 0.6}).problem, FlipProblem::too_short);
  EXPECT_EQ(row.flips({0.0}).problem, FlipProblem::too_short);
  EXPECT_EQ(row.flips({0.0, 2.0}).problem, FlipProblem::too_coarse);
  // One pixel of ten is not more than the least share.
  EXPECT_EQ(row.flips({1.0, 1.2, 1.6}).problem, FlipProblem::little_acne);
}

TEST(BiasFlips, What_is_lit_at_the_bias_of_the_own_surface_leaks_and_a_filtered_pixel_is_split) {
  WrongTaps wrong{Image<uvec4>(4, 1, uvec4(0)), whole};
  wrong.weights[0] = uvec4(0, 0, 0, whole);      // rays: light leak
  wrong.weights[1] = uvec4(0, 0, whole, 0);      // rays: peter-panning
  wrong.weights[2] = uvec4(0, 0, whole / 2, 0);  // a filter
  wrong.weights[3] = uvec4(3, 5, 0, 0);          // too dark
  Image<float> own_surface(4, 1, 0.0f);
  own_surface[1] = 1.0f;
  own_surface[2] = 0.125f;
  own_surface[3] = 1.0f;
  separate_too_bright(wrong, own_surface);
  EXPECT_EQ(wrong.weights[0], uvec4(0, 0, whole, 0));
  EXPECT_EQ(wrong.weights[1], uvec4(0, 0, 0, whole));
  EXPECT_EQ(wrong.weights[2], uvec4(0, 0, whole / 8 * 3, whole / 8));
  EXPECT_EQ(wrong.weights[3], uvec4(3, 5, 0, 0));
}

}  // namespace
}  // namespace umbrameter
