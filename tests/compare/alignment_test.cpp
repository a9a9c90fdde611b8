// Shifts and flips between images are found, and nothing else is: noise, exposure, smooth shading, moved objects.
#include "compare/alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace umbrameter {
namespace {

constexpr int width = 160;
constexpr int height = 96;

float random_at(std::uint32_t seed, int x, int y) {
  return to_unit_float(
      hash(seed ^ hash(static_cast<std::uint32_t>(x + 1000) + 7919u * static_cast<std::uint32_t>(y + 1000))));
}

// Blocks of 7 × 5 pixels with random values, seen at an offset: a picture with edges everywhere and no symmetry.
vec3 blocks_at(int x, int y) { return vec3(random_at(1, (x + 700) / 7, (y + 500) / 5)); }

Image<vec3> picture(const std::function<vec3(int, int)>& color_at) {
  Image<vec3> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = color_at(x, y);
  }
  return image;
}

Image<vec3> blocks() { return picture(blocks_at); }

// Uniform noise from −amplitude to amplitude.
Image<vec3> with_noise(Image<vec3> image, float amplitude, std::uint32_t seed) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) += vec3(amplitude * (2.0f * random_at(seed, x, y) - 1.0f));
  }
  return image;
}

std::optional<Misalignment> find(const Image<vec3>& test, const Image<vec3>& reference) {
  return find_misalignment(test, reference, [](std::size_t) { return true; });
}

TEST(Alignment, Finds_every_shift_exactly) {
  for (const ivec2 shift : {ivec2(1, 0), ivec2(0, -1), ivec2(2, 3), ivec2(-4, 1), ivec2(-8, 8)}) {
    const auto found = find(picture([&](int x, int y) { return blocks_at(x - shift.x, y - shift.y); }), blocks());
    ASSERT_TRUE(found) << shift.x << " " << shift.y;
    EXPECT_EQ(found->shift, shift);
    EXPECT_FALSE(found->flips_x || found->flips_y);
    EXPECT_NEAR(found->remaining, 0.0, 1e-6) << "the pixels that are read come from inside both images";
  }
}

TEST(Alignment, Finds_flips) {
  for (const bool flips_x : {false, true}) {
    for (const bool flips_y : {false, true}) {
      const auto found = find(
          picture([&](int x, int y) { return blocks_at(flips_x ? width - 1 - x : x, flips_y ? height - 1 - y : y); }),
          blocks());
      ASSERT_EQ(found.has_value(), flips_x || flips_y);
      if (!found) continue;
      EXPECT_EQ(found->flips_x, flips_x);
      EXPECT_EQ(found->flips_y, flips_y);
      EXPECT_EQ(found->shift, ivec2(0));
    }
  }
}

TEST(Alignment, Finds_a_shift_under_noise_and_another_exposure) {
  const Image<vec3> shifted = picture([](int x, int y) { return 0.8f * blocks_at(x - 3, y); });
  const auto found = find(with_noise(shifted, 0.1f, 5), blocks());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->shift, ivec2(3, 0));
  EXPECT_GT(found->remaining, 0.0);
}

TEST(Alignment, Equal_images_are_aligned) { EXPECT_FALSE(find(blocks(), blocks())); }

TEST(Alignment, Noise_is_no_shift) {
  const Image<vec3> flat(width, height, vec3(0.5f));
  for (std::uint32_t seed = 10; seed < 15; ++seed) {
    // Noise against noise, against a flat image, and on a picture, which is far stronger than the picture's edges at
    // last.
    EXPECT_FALSE(find(with_noise(flat, 0.3f, seed), with_noise(flat, 0.3f, seed + 100))) << seed;
    EXPECT_FALSE(find(with_noise(flat, 0.3f, seed), flat)) << seed;
    for (const float amplitude : {0.01f, 0.1f, 0.5f, 2.0f}) {
      EXPECT_FALSE(find(with_noise(blocks(), amplitude, seed), blocks())) << seed << " " << amplitude;
    }
  }
}

TEST(Alignment, A_few_bright_pixels_are_no_shift) {
  // Three that a shift to the left would move out of the pixels that are read.
  const Image<vec3> ramp = picture([](int x, int) { return vec3(0.002f * static_cast<float>(x)); });
  Image<vec3> test = ramp;
  for (const int y : {20, 50, 70}) test.at(max_alignment_shift, y) = vec3(1000.0f);
  EXPECT_FALSE(find(test, ramp));
}

TEST(Alignment, Exposure_and_offset_of_a_ramp_are_no_shift) {
  // A ramp that is brighter by its change over three pixels equals a shifted one.
  const auto ramp = [](float offset) {
    return picture([offset](int x, int y) { return vec3(0.3f + 0.002f * (static_cast<float>(x + y) + offset)); });
  };
  EXPECT_FALSE(find(ramp(3.0f), ramp(0.0f)));
  EXPECT_FALSE(find(picture([](int x, int y) { return 0.7f * blocks_at(x, y); }), blocks()));
}

TEST(Alignment, One_object_that_moved_is_no_shift_of_the_image) {
  // A square of 24 pixels moved by 3 in a picture that stays: the edges that stay get worse.
  const auto with_square = [](int left) {
    return picture([left](int x, int y) {
      return x >= left && x < left + 24 && y >= 30 && y < 54 ? vec3(1.0f) : 0.3f * blocks_at(x, y);
    });
  };
  EXPECT_FALSE(find(with_square(63), with_square(60)));
}

TEST(Alignment, Only_counted_pixels_matter_and_1024_are_needed) {
  const Image<vec3> shifted = picture([](int x, int y) { return blocks_at(x - 2, y); });
  const auto counting = [&](int columns) {
    return find_misalignment(shifted, blocks(), [columns](std::size_t i) {
      return static_cast<int>(i % static_cast<std::size_t>(width)) < max_alignment_shift + columns;
    });
  };
  // 80 of the 96 rows are read.
  EXPECT_TRUE(counting(13));
  EXPECT_FALSE(counting(12));
  // Half of the image that is aligned hides the shift of the other half, unless a mask leaves it out.
  const Image<vec3> half = picture([](int x, int y) { return blocks_at(x < width / 2 ? x - 2 : x, y); });
  EXPECT_FALSE(find(half, blocks()));
  EXPECT_TRUE(find_misalignment(half, blocks(), [](std::size_t i) {
    return static_cast<int>(i % static_cast<std::size_t>(width)) < width / 2 - max_alignment_shift;
  }));
}

TEST(Alignment, Small_images_are_not_checked) {
  const Image<vec3> small(47, 200, vec3(1.0f));
  EXPECT_FALSE(find(small, small));
  EXPECT_FALSE(find(Image<vec3>(1, 1, vec3(1.0f)), Image<vec3>(1, 1)));
}

}  // namespace
}  // namespace umbrameter
