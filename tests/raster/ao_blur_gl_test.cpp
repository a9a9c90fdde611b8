// The Gaussian and bilateral blurs and repeated passes against their sums on the processor.
#include <cmath>

#include "ao_fixture.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// One axis; `dx` and `dy` select it.
Image<double> blurred(const Image<double>& source, const GBuffer& surfels, const AoParams& params, int dx, int dy) {
  const AoBlurTaps taps = taps_of(params.blur);
  Image<double> result(source.width, source.height, 1.0);
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      const std::size_t i = source.index(x, y);
      if (!surfels.is_surface(i)) continue;
      double sum = 0.0;
      double weights = 0.0;
      for (int k = taps.first; k < taps.first + taps.count; ++k) {
        const std::size_t j =
            source.index(std::clamp(x + k * dx, 0, source.width - 1), std::clamp(y + k * dy, 0, source.height - 1));
        if (!surfels.is_surface(j)) continue;
        double weight = std::exp(-0.5 * std::pow(k / deviation_of(params.blur), 2));
        if (params.blur.kind == AoBlur::bilateral) {
          const double apart =
              glm::dot(dvec3(surfels.position[j]) - dvec3(surfels.position[i]), dvec3(surfels.geometric_normal[i]));
          const double cosine = glm::dot(dvec3(surfels.geometric_normal[j]), dvec3(surfels.geometric_normal[i]));
          weight *= std::exp(-std::pow(apart / (params.blur.plane_distance * params.sampling.radius.number), 2)) *
                    std::pow(std::clamp(cosine, 0.0, 1.0), params.blur.normal_exponent);
        }
        sum += weight * source[j];
        weights += weight;
      }
      result[i] = sum / weights;
    }
  }
  return result;
}

TEST_F(AoMethodsGl, Gaussian_and_bilateral_blurs_are_those_of_the_processor_in_any_number_of_passes) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  add_mesh(scene, box({-0.2f, 1, -0.2f}, {0.1f, 2, 0.1f}));
  const View view = perspective_view(64, 48, {2, 3, 4}, {0, 1.5, 0});
  AoParams params = method(AoTechniqueName::ssao);
  params.sampling.samples = 8;
  const Seen raw = see(scene, view, params);
  double of_kind[2] = {};
  for (const AoBlur kind : {AoBlur::gaussian, AoBlur::bilateral}) {
    for (const int passes : {1, 3}) {
      params.blur.kind = kind;
      params.blur.size = 5;
      params.blur.passes = passes;
      Image<double> expected(view.width, view.height, 1.0);
      for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<double>(raw.ao[i]);
      for (int pass = 0; pass < passes; ++pass) {
        expected = blurred(blurred(expected, raw.surfels, params, 1, 0), raw.surfels, params, 0, 1);
      }
      const Seen seen = see(scene, view, params);
      double change = 0.0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(static_cast<double>(seen.ao[i]), expected[i], 1e-5) << i;
        change += std::abs(expected[i] - static_cast<double>(raw.ao[i]));
      }
      of_kind[kind == AoBlur::bilateral ? 1 : 0] = change;
    }
  }
  EXPECT_GT(of_kind[0], 10.0);
  EXPECT_GT(of_kind[1], 10.0);
  EXPECT_GT(std::abs(of_kind[0] - of_kind[1]), 1.0) << "depth and normal change the weights";
}

TEST_F(AoMethodsGl, Two_passes_of_a_box_are_a_box_of_a_box) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  const View view = orthographic_view(48, 48, {2, 3, 4}, {0, 0.5, 0}, 2.0);
  AoParams params = method(AoTechniqueName::ssao);
  params.blur.kind = AoBlur::box;
  params.blur.size = 3;
  const Seen once = see(scene, view, params);
  params.blur.passes = 2;
  const Seen twice = see(scene, view, params);
  for (int y = 4; y < 44; ++y) {
    for (int x = 4; x < 44; ++x) {
      double sum = 0.0;
      for (int k = 0; k < 9; ++k) sum += static_cast<double>(once.ao.at(x + k % 3 - 1, y + k / 3 - 1)) / 9.0;
      ASSERT_NEAR(static_cast<double>(twice.ao.at(x, y)), sum, 1e-5);
    }
  }
}

}  // namespace
}  // namespace umbrameter
