// Bent normals of the AO methods: an open plane, and a step of known open directions.
#include <cmath>
#include <optional>

#include "ao_fixture.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// Open are the directions whose angle ψ about the step's edge is between α, the elevation of the edge, and 180 degrees.
// Weighted by the cosine, they sum up to ∫ (cos ψ, sin ψ) sin ψ dψ, times 4/3. Radians from the floor's normal.
double tilt_of_open_directions(double distance) {
  const double alpha = std::atan(1.0 / distance);
  const double away = 0.5 * std::sin(alpha) * std::sin(alpha);
  const double up = 0.5 * (pi - alpha) + 0.25 * std::sin(2.0 * alpha);
  return std::atan2(away, up);
}

class BentNormalsGl : public AoMethodsGl {
 protected:
  struct Bent {
    GBuffer surfels;
    Image<vec3> normals;
  };
  Bent bent(const Scene& scene, const View& view, const AoParams& params) const {
    const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), scene), view);
    return {read_back(context(), surfels), draw_bent_normals(context(), surfels, view, params, 1).value()};
  }

  // Expects bent normals of the lower floor near that distance from a step of height 1, within one degree in the mean.
  void expect_beside_step(const AoParams& params, double distance) const {
    Scene scene;
    add_mesh(scene, ground(100));
    add_mesh(scene, box({-50, 0, -50}, {50, 1, 0}));
    const Bent seen = bent(scene, orthographic_view(128, 128, {0, 10, 1}, {0, 0, 1}, 4.0, {0, 0, -1}), params);
    dvec3 sum(0);
    dvec3 expected(0);
    for (std::size_t i = 0; i < seen.normals.size(); ++i) {
      const vec3& position = seen.surfels.position[i];
      if (std::abs(static_cast<double>(position.z) - distance) > 0.081 || std::abs(position.x) > 0.321f) continue;
      const double tilt = tilt_of_open_directions(static_cast<double>(position.z));
      expected += dvec3(0, std::cos(tilt), std::sin(tilt));
      sum += dvec3(seen.normals[i]);
    }
    ASSERT_GT(glm::length(expected), 10.0);
    EXPECT_NEAR(sum.x / glm::length(sum), 0.0, 0.01);
    EXPECT_NEAR(std::atan2(sum.z, sum.y) / degree, std::atan2(expected.z, expected.y) / degree, 1.0) << distance;
  }
};

TEST_F(BentNormalsGl, Beside_a_step_they_are_the_mean_of_the_open_directions) {
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.sampling.radius = 4.0;
  params.gtao = {1.0, 1e-3, 2.0, 0.0, 1.0};
  params.slices.slices = 8;
  params.slices.steps = 32;
  params.bitmask.thickness = 100.0;
  params.bitmask.rounding = BitmaskRounding::nearest;
  for (const double distance : {0.25, 1.0}) {
    params.technique = AoTechniques::choice<Gtao>;
    expect_beside_step(params, distance);
    params.technique = AoTechniques::choice<Bitmask>;
    params.bitmask.weight = BitmaskWeight::angle;
    expect_beside_step(params, distance);
  }
  params.bitmask.weight = BitmaskWeight::cosine;
  expect_beside_step(params, 1.0);
}

TEST_F(BentNormalsGl, On_an_open_plane_they_are_the_normal) {
  Scene scene;
  add_mesh(scene, ground(1000));
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.slices.spacing = AoSliceSpacing::angle;
  params.slices.slices = 8;
  for (const double angle : {10.0, 45.0}) {
    const dvec3 eye(0, 3 * std::cos(angle * degree), 3 * std::sin(angle * degree));
    const Bent seen = bent(scene, perspective_view(96, 64, eye, {0, 0, 0}), params);
    double largest = 0.0;
    for (std::size_t i = 0; i < seen.normals.size(); ++i) {
      largest = std::max(largest, std::acos(std::min(1.0, static_cast<double>(seen.normals[i].y))) / degree);
    }
    // The mean over slices of finite number is not quite symmetric.
    EXPECT_LT(largest, 3.0) << angle;
  }
}

TEST_F(BentNormalsGl, Only_methods_with_slices_yield_them) {
  Scene scene;
  add_mesh(scene, ground(20));
  const View view = perspective_view(16, 16, {2, 3, 4}, {0, 0, 0});
  const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), scene), view);
  for (const auto technique : {AoTechniques::choice<Ssao>, AoTechniques::choice<Hbao>, AoTechniques::choice<Alchemy>}) {
    EXPECT_FALSE(draw_bent_normals(context(), surfels, view, method(technique), 1).has_value());
  }
}

}  // namespace
}  // namespace umbrameter
