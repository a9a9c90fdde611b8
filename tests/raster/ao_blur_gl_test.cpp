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
  AoParams params = method(AoTechniques::choice<Ssao>);
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

// One pass of XeGTAO's denoiser.
Image<double> denoised(const Image<double>& source, const GBuffer& surfels, double center_weight) {
  Image<double> result(source.width, source.height, 1.0);
  const auto index = [&](ivec2 at) {
    return source.index(std::clamp(at.x, 0, source.width - 1), std::clamp(at.y, 0, source.height - 1));
  };
  const auto depth = [&](ivec2 at) {
    return surfels.is_surface(index(at)) ? static_cast<double>(surfels.depth[index(at)]) : 1e30;
  };
  // 1 on one surface, 0 across an edge, as `at` sees its neighbour.
  const auto edge = [&](ivec2 at, ivec2 to) {
    const double before = depth(at - to) - depth(at);
    const double after = depth(at + to) - depth(at);
    const double difference = std::min(std::abs(after), std::abs(after + before) / 2.0);
    return std::clamp(1.25 - difference / (0.011 * depth(at)), 0.0, 1.0);
  };
  const ivec2 left(-1, 0), right(1, 0), up(0, -1), down(0, 1);
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      const ivec2 at(x, y);
      if (!surfels.is_surface(index(at))) continue;
      double l = edge(at, left) * edge(at + left, right), r = edge(at, right) * edge(at + right, left);
      double u = edge(at, up) * edge(at + up, down), d = edge(at, down) * edge(at + down, up);
      const double leak = 0.5 * std::clamp(4.0 - 2.5 - l - r - u - d, 0.0, 1.0) / (4.0 - 2.5);
      for (double* each : {&l, &r, &u, &d}) *each = std::min(*each + leak, 1.0);
      double sum = center_weight * source[index(at)];
      double weights = center_weight;
      const auto add = [&](ivec2 where, double weight) {
        if (!surfels.is_surface(index(where))) return;
        sum += weight * source[index(where)];
        weights += weight;
      };
      add(at + left, l), add(at + right, r), add(at + up, u), add(at + down, d);
      add(at + left + up, 0.85 * 0.5 * (l * edge(at + left, up) + u * edge(at + up, left)));
      add(at + right + up, 0.85 * 0.5 * (r * edge(at + right, up) + u * edge(at + up, right)));
      add(at + left + down, 0.85 * 0.5 * (l * edge(at + left, down) + d * edge(at + down, left)));
      add(at + right + down, 0.85 * 0.5 * (r * edge(at + right, down) + d * edge(at + down, right)));
      result[index(at)] = sum / weights;
    }
  }
  return result;
}

TEST_F(AoMethodsGl, The_denoiser_of_XeGTAO_is_that_of_the_processor_and_sharpens_its_last_pass) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  add_mesh(scene, box({-0.02f, 1, -0.02f}, {0.02f, 2, 0.02f}));  // one pixel wide: cut off on both sides
  for (int i = 0; i < 9; ++i) {                                  // a pixel each: cut off on all sides
    const vec3 center(0.25 * i - 1.0, 2.2, 0.0);
    add_mesh(scene, box(center - 0.03f, center + 0.03f));
  }
  const View view = perspective_view(65, 48, {2, 3, 4}, {0, 1.5, 0});
  AoParams params = method(AoTechniques::choice<Ssao>);
  params.sampling.samples = 8;
  const Seen raw = see(scene, view, params);
  params.blur.kind = AoBlur::xegtao;
  for (const int passes : {1, 3}) {
    params.blur.passes = passes;
    Image<double> expected(view.width, view.height, 1.0);
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<double>(raw.ao[i]);
    for (int pass = 0; pass < passes; ++pass) {
      expected = denoised(expected, raw.surfels, pass + 1 == passes ? 1.2 : 1.2 / 5.0);
    }
    const Seen seen = see(scene, view, params);
    double change = 0.0;
    int differing = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      differing += std::abs(static_cast<double>(seen.ao[i]) - expected[i]) > 1e-4 ? 1 : 0;
      change += std::abs(expected[i] - static_cast<double>(raw.ao[i]));
    }
    EXPECT_EQ(differing, 0);
    EXPECT_GT(change, 10.0);
  }
}

TEST_F(AoMethodsGl, The_denoiser_of_XeGTAO_keeps_an_edge_between_two_depths) {
  Scene scene;
  add_mesh(scene, ground(100));
  add_mesh(scene, box({-50, 0, -50}, {50, 1, 0}));
  const View view = orthographic_view(128, 128, {0, 10, 1}, {0, 0, 1}, 4.0, {0, 0, -1});
  AoParams params = method(AoTechniques::choice<Marched>);
  params.sampling.radius = 2.0;
  params.blur.kind = AoBlur::xegtao;
  params.blur.passes = 4;
  const Seen seen = see(scene, view, params);
  for (int y = 1; y < 127; ++y) {
    for (int x = 32; x < 96; ++x) {
      const std::size_t i = seen.ao.index(x, y);
      if (seen.surfels.position[i].y > 0.5f) {
        ASSERT_EQ(seen.ao[i], 1.0f);
      } else if (seen.surfels.position[i].z < 0.13f) {
        ASSERT_LT(seen.ao[i], 0.85f);
      }
    }
  }
}

TEST_F(AoMethodsGl, The_default_blur_of_GTAO_is_the_denoiser_of_XeGTAO) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  const View view = orthographic_view(48, 48, {2, 3, 4}, {0, 0.5, 0}, 2.0);
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.blur = {};
  const Seen own = see(scene, view, params);
  params.blur.kind = AoBlur::xegtao;
  EXPECT_EQ(own.ao.pixels, see(scene, view, params).ao.pixels);
  params.blur.kind = AoBlur::none;
  EXPECT_NE(own.ao.pixels, see(scene, view, params).ao.pixels);
}

TEST_F(AoMethodsGl, Two_passes_of_a_box_are_a_box_of_a_box) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  const View view = orthographic_view(48, 48, {2, 3, 4}, {0, 0.5, 0}, 2.0);
  AoParams params = method(AoTechniques::choice<Ssao>);
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
