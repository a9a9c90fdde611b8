// Ambient occlusion at half resolution: which surfels the technique sees, and how the others get their values.
#include <cmath>
#include <limits>

#include "ao_fixture.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// Joint bilateral upsampling on the processor; `half` has the value of the surfel (2x, 2y) at (x, y).
Image<double> upsampled(const Image<double>& half, const GBuffer& surfels, const AoParams& params) {
  Image<double> result(surfels.width, surfels.height, 1.0);
  const double plane_distance = params.resolution.plane_distance * params.sampling.radius.number;
  for (int y = 0; y < surfels.height; ++y) {
    for (int x = 0; x < surfels.width; ++x) {
      const std::size_t i = result.index(x, y);
      if (!surfels.is_surface(i)) continue;
      double sum = 0.0;
      double weights = 0.0;
      double nearest = std::numeric_limits<double>::infinity();
      for (int row = y / 2; row <= (y + 1) / 2 && row < half.height; ++row) {
        for (int column = x / 2; column <= (x + 1) / 2 && column < half.width; ++column) {
          const std::size_t j = result.index(2 * column, 2 * row);
          if (!surfels.is_surface(j)) continue;
          const dvec3 normal(surfels.geometric_normal[i]);
          const double apart = glm::dot(dvec3(surfels.position[j]) - dvec3(surfels.position[i]), normal);
          const double cosine = std::clamp(glm::dot(dvec3(surfels.geometric_normal[j]), normal), 0.0, 1.0);
          // Below the smallest float the shader's weight is 0.
          const double weight =
              std::exp(-std::pow(apart / plane_distance, 2)) * std::pow(cosine, params.resolution.normal_exponent);
          sum += weight * half.at(column, row);
          weights += weight;
          if (weights < 1e-37 && std::abs(apart) < nearest) {
            nearest = std::abs(apart);
            result[i] = half.at(column, row);
          }
        }
      }
      if (weights >= 1e-37) result[i] = sum / weights;
    }
  }
  return result;
}

class AoResolutionGl : public AoMethodsGl {
 protected:
  static Scene boxes() {
    Scene scene;
    add_mesh(scene, ground(20));
    add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
    add_mesh(scene, box({-0.2f, 1, -0.2f}, {0.1f, 2, 0.1f}));
    return scene;
  }
  Seen half(const Scene& scene, const View& view, AoParams params) const {
    params.resolution.kind = AoResolution::half;
    return see(scene, view, params);
  }
};

constexpr AoTechniques::Choice all_techniques[] = {AoTechniques::choice<Ssao>,   AoTechniques::choice<Gtao>,
                                                   AoTechniques::choice<Hbao>,   AoTechniques::choice<Alchemy>,
                                                   AoTechniques::choice<Crytek>, AoTechniques::choice<Bitmask>,
                                                   AoTechniques::choice<Marched>};

TEST_F(AoResolutionGl, Every_technique_gives_the_surfels_that_it_sees_their_value_at_full_resolution) {
  const Scene scene = boxes();
  for (const View& view :
       {perspective_view(63, 47, {2, 3, 4}, {0, 1.5, 0}), orthographic_view(64, 48, {2, 3, 4}, {0, 0.5, 0}, 2.0)}) {
    for (const AoTechniques::Choice name : all_techniques) {
      AoParams params = method(name);
      params.noise.size = 1;  // the noise of a surfel depends on its place in the AO image
      const Seen full = see(scene, view, params);
      const Seen seen = half(scene, view, params);
      double occlusion = 0.0;
      for (int y = 0; y < view.height; y += 2) {
        for (int x = 0; x < view.width; x += 2) {
          ASSERT_EQ(seen.ao.at(x, y), full.ao.at(x, y)) << static_cast<int>(name) << " at " << x << ", " << y;
          occlusion += static_cast<double>(1.0f - full.ao.at(x, y));
        }
      }
      EXPECT_GT(occlusion, 5.0) << static_cast<int>(name);
    }
  }
}

TEST_F(AoResolutionGl, Upsampling_is_that_of_the_processor_also_where_a_side_is_odd) {
  const Scene scene = boxes();
  for (const View& view :
       {perspective_view(65, 49, {2, 3, 4}, {0, 1.5, 0}), perspective_view(64, 48, {2, 3, 4}, {0, 1.5, 0})}) {
    for (const double exponent : {8.0, 0.0}) {
      AoParams params = method(AoTechniques::choice<Ssao>);
      params.resolution.normal_exponent = exponent;
      const Seen seen = half(scene, view, params);
      Image<double> values((view.width + 1) / 2, (view.height + 1) / 2, 1.0);
      for (int y = 0; y < values.height; ++y) {
        for (int x = 0; x < values.width; ++x) values.at(x, y) = static_cast<double>(seen.ao.at(2 * x, 2 * y));
      }
      const Image<double> expected = upsampled(values, seen.surfels, params);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(static_cast<double>(seen.ao[i]), expected[i], 2e-5) << i;
      }
    }
  }
}

TEST_F(AoResolutionGl, A_constant_image_is_reproduced_exactly) {
  // Every sample of full-sphere SSAO on a plane seen head-on has the same result at every surfel.
  Scene scene;
  add_mesh(scene, ground(100));
  const View view = orthographic_view(65, 49, {0, 10, 0}, {0, 0, 0}, 4.0, {0, 0, -1});
  AoParams params = method(AoTechniques::choice<Crytek>);
  params.noise.size = 1;
  const Seen seen = half(scene, view, params);
  const float constant = seen.ao.at(32, 24);
  EXPECT_GT(constant, 0.3f);
  EXPECT_LT(constant, 0.7f);
  for (int y = 12; y < 36; ++y) {
    for (int x = 12; x < 52; ++x) ASSERT_EQ(seen.ao.at(x, y), constant);
  }
}

TEST_F(AoResolutionGl, A_plane_stays_what_it_was) {
  Scene scene;
  add_mesh(scene, ground(1000));
  for (const double angle : {10.0, 60.0}) {
    const dvec3 eye(0, 3 * std::cos(angle * degree), 3 * std::sin(angle * degree));
    const View view = perspective_view(96, 64, eye, {0, 0, 0}, 0.3);
    for (const AoTechniques::Choice name : {AoTechniques::choice<Ssao>, AoTechniques::choice<Gtao>,
                                            AoTechniques::choice<Hbao>, AoTechniques::choice<Bitmask>}) {
      AoParams params = method(name);
      params.blur.kind = AoBlur::box;
      const double full = mean_near(see(scene, view, params), 48, 32);
      EXPECT_NEAR(mean_near(half(scene, view, params), 48, 32), full, 2e-3) << static_cast<int>(name) << " " << angle;
    }
  }
}

TEST_F(AoResolutionGl, An_edge_between_two_depths_does_not_bleed) {
  // A step of height 1 from above: its top is open, and the floor beside it is not.
  Scene scene;
  add_mesh(scene, ground(100));
  add_mesh(scene, box({-50, 0, -50}, {50, 1, 0}));
  AoParams params = method(AoTechniques::choice<Marched>);
  params.sampling.radius = 2.0;
  params.sampling.samples = 32;
  for (const double shift : {0.0, 0.02, 0.035}) {  // the edge in other columns of the blocks
    const View view = orthographic_view(128, 128, {0, 10, 1 + shift}, {0, 0, 1 + shift}, 4.0, {0, 0, -1});
    const Seen full = see(scene, view, params);
    const auto beside = [&](const Seen& seen, bool on_top) {
      double worst = on_top ? 1.0 : 0.0;
      for (int y = 1; y < 127; ++y) {
        for (int x = 32; x < 96; ++x) {
          const std::size_t i = seen.ao.index(x, y);
          const vec3& position = seen.surfels.position[i];
          if ((position.y > 0.5f) != on_top || std::abs(position.z) > 0.13f) continue;
          const auto ao = static_cast<double>(seen.ao[i]);
          worst = on_top ? std::min(worst, ao) : std::max(worst, ao);
        }
      }
      return worst;
    };
    EXPECT_EQ(beside(full, true), 1.0);
    EXPECT_LT(beside(full, false), 0.85);
    const Seen edges = half(scene, view, params);
    EXPECT_EQ(beside(edges, true), 1.0) << shift;
    EXPECT_LT(beside(edges, false), 0.85) << shift;
    // Without its weights the upsampling bleeds to the side of the edge whose row lies between two blocks' surfels.
    AoParams plain = params;
    plain.resolution.plane_distance = 0.0;
    plain.resolution.normal_exponent = 0.0;
    const Seen bleeding = half(scene, view, plain);
    EXPECT_TRUE(beside(bleeding, true) < 0.9 || beside(bleeding, false) > beside(full, false) + 0.1) << shift;
  }
}

}  // namespace
}  // namespace umbrameter
