#include "raytrace/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/random.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {
namespace {

TEST(Sampler, Every_field_of_the_reference_is_described) {
  TruthParams params;
  EXPECT_EQ(static_cast<int>(describe(params).size()), count_fields<TruthParams>());
}

TEST(Sampler, Scrambled_points_fill_every_elementary_interval_once) {
  // A (0, m, 2)-net in base 2 stays one under Owen scrambling (Owen 1995): of 2^m points each box of area 2^−m with
  // sides that are powers of two holds exactly one.
  constexpr int m = 8;
  for (const std::uint32_t scramble : {1u, 77u, 123456789u}) {
    for (int rows = 0; rows <= m; ++rows) {
      std::set<std::pair<int, int>> boxes;
      for (std::uint32_t i = 0; i < 1u << m; ++i) {
        const vec2 p = owen_sobol(i, scramble);
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
        boxes.emplace(static_cast<int>(p.x * static_cast<float>(1 << rows)),
                      static_cast<int>(p.y * static_cast<float>(1 << (m - rows))));
      }
      EXPECT_EQ(boxes.size(), 1u << m) << "scramble " << scramble << ", " << rows << " digits of x";
    }
  }
}

TEST(Sampler, Scrambles_are_independent) {
  // Correlation of the first points of many scrambles: standard error 1/√20000 = 0.0071; five of them.
  double sum = 0.0;
  constexpr std::uint32_t count = 20000;
  for (std::uint32_t s = 0; s < count; ++s) {
    sum += (owen_sobol(0, hash(s, 0u)).x - 0.5) * (owen_sobol(0, hash(s + 1, 0u)).x - 0.5) * 12.0;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.036);
}

TEST(Sampler, Hemispheres_have_the_mean_height_of_their_density) {
  double cosine = 0.0;
  double uniform = 0.0;
  constexpr std::uint32_t count = 4096;
  for (std::uint32_t i = 0; i < count; ++i) {
    const vec2 p = owen_sobol(i, 9);
    EXPECT_GT(lift_cosine(concentric_disk(p)).z, 0.0f);
    EXPECT_NEAR(glm::length(lift_cosine(concentric_disk(p))), 1.0f, 1e-6f);
    EXPECT_GT(lift_uniform(concentric_disk(p)).z, 0.0f);
    EXPECT_NEAR(glm::length(lift_uniform(concentric_disk(p))), 1.0f, 1e-6f);
    cosine += lift_cosine(concentric_disk(p)).z;
    uniform += lift_uniform(concentric_disk(p)).z;
  }
  EXPECT_NEAR(cosine / count, 2.0 / 3.0, 1e-4);  // ∫ cos²θ / π dω
  EXPECT_NEAR(uniform / count, 0.5, 1e-4);       // ∫ cos θ / 2π dω
}

TEST(Sampler, Cosines_and_sines_are_off_by_less_than_their_header_says) {
  // All angles of up to 45 degrees, to a thousandth of a degree.
  double worst = 0.0;
  for (int i = -45000; i <= 45000; ++i) {
    const float angle = static_cast<float>(i * (pi / 180000.0));
    const vec2 direction = direction_near_x(angle);
    worst = std::max({worst, std::abs(static_cast<double>(direction.x) - std::cos(static_cast<double>(angle))),
                      std::abs(static_cast<double>(direction.y) - std::sin(static_cast<double>(angle)))});
  }
  EXPECT_LT(worst, 1e-7);
  // Once around: the angle is rounded, too, by up to a float's half unit at 45 degrees for each of two products.
  for (int i = 0; i < 3600; ++i) {
    const float turn = static_cast<float>(i) / 3600.0f;
    const vec2 direction = direction_at(turn);
    EXPECT_NEAR(direction.x, std::cos(2.0 * pi * static_cast<double>(turn)), 2.5e-7) << turn;
    EXPECT_NEAR(direction.y, std::sin(2.0 * pi * static_cast<double>(turn)), 2.5e-7) << turn;
  }
}

TEST(Sampler, Frames_are_right_handed_and_orthonormal_in_every_direction) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    vec3 n = lift_uniform(concentric_disk(owen_sobol(i, 3)));
    if (i % 2 == 1) n = -n;
    if (i == 0) n = vec3(0, 0, -1);
    const mat3 frame = frame_about(n);
    EXPECT_EQ(frame[2], n);
    EXPECT_NEAR(glm::determinant(frame), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(frame[0], frame[1]), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(frame[0], n), 0.0f, 1e-5f);
  }
}

TEST(Sampler, Randomisations_share_all_points_out) {
  for (const int spp : {1, 2, 3, 15, 16, 17, 256, 1000}) {
    const Randomisations s = split(spp);
    int points = 0;
    for (int r = 0; r < s.count; ++r) {
      EXPECT_GE(s.size(r), 1);
      points += s.size(r);
    }
    EXPECT_EQ(points, spp);
  }
  EXPECT_EQ(split(256).count, 8);
  EXPECT_EQ(split(1024).count, 16);
}

}  // namespace
}  // namespace umbrameter
