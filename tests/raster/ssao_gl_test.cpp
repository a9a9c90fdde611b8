#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// Radius 2 m, bias 0.1 m.
AoParams in_a_scene_of_100_m() { return in_metres(AoParams{}, 100.0); }

class SsaoGl : public GlTest {
 protected:
  Image<float> ao(const Scene& scene, const View& view, const AoParams& params, std::uint32_t seed = 1) const {
    return draw_ao(context(), draw_gbuffer(context(), upload(context(), scene), view), view, params, seed);
  }
};

TEST_F(SsaoGl, An_open_plane_is_open) {
  Scene scene;
  add_mesh(scene, ground(500));
  AoParams params = in_a_scene_of_100_m();
  for (const View& view :
       {perspective_view(160, 90, {0, 4, 3}, {0, 0, 0}), orthographic_view(160, 90, {0, 8, 6}, {0, 0, 0}, 3.0)}) {
    const Image<float> image = ao(scene, view, params);
    EXPECT_GT(mean(image), 0.995);
    EXPECT_LE(*std::max_element(image.pixels.begin(), image.pixels.end()), 1.0f);
  }
}

TEST_F(SsaoGl, Background_is_open_before_and_after_the_blur) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}));
  const View view = perspective_view(64, 64, {2, 3, 4}, {0, 0, 0});
  const GBuffer gbuffer = read_back(context(), draw_gbuffer(context(), upload(context(), scene), view));
  for (const AoBlur blur : {AoBlur::none, AoBlur::box}) {
    AoParams params = in_a_scene_of_100_m();
    params.bias.depth = -1.0;  // everything occludes itself
    params.blur.kind = blur;
    const Image<float> image = ao(scene, view, params);
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (gbuffer.is_surface(i)) continue;
      ASSERT_EQ(image[i], 1.0f);
    }
    EXPECT_LT(*std::min_element(image.pixels.begin(), image.pixels.end()), 0.5f);
  }
}

TEST_F(SsaoGl, A_corner_is_darker_than_the_open_floor_in_both_projections) {
  Scene scene;
  add_mesh(scene, quad({-10, 0, 10}, {10, 0, 10}, {10, 0, -1}, {-10, 0, -1}));
  add_mesh(scene, quad({-10, 0, -1}, {10, 0, -1}, {10, 10, -1}, {-10, 10, -1}));
  AoParams params = in_a_scene_of_100_m();
  params.sampling.samples = 256;
  params.sampling.radius = 1.0;
  for (const View& view :
       {perspective_view(128, 128, {0, 4, 5}, {0, 0, 0}), orthographic_view(128, 128, {0, 8, 8}, {0, 0, 0}, 3.0)}) {
    const GBuffer gbuffer = read_back(context(), draw_gbuffer(context(), upload(context(), scene), view));
    const Image<float> image = ao(scene, view, params);
    double near_sum = 0, near_count = 0, far_sum = 0, far_count = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (gbuffer.instance[i] != 0) continue;
      const float distance = gbuffer.position[i].z + 1.0f;
      if (distance < 0.2f) near_sum += static_cast<double>(image[i]), ++near_count;
      if (distance > 1.5f) far_sum += static_cast<double>(image[i]), ++far_count;
    }
    ASSERT_GT(near_count, 50);
    ASSERT_GT(far_count, 50);
    EXPECT_LT(near_sum / near_count, 0.9);
    EXPECT_GT(near_sum / near_count, 0.4) << "two planes leave half of the hemisphere open";
    EXPECT_GT(far_sum / far_count, 0.99);
  }
}

TEST_F(SsaoGl, Without_the_range_check_a_near_object_darkens_the_far_wall_behind_it) {
  Scene scene;
  add_mesh(scene, quad({-50, -50, -20}, {50, -50, -20}, {50, 50, -20}, {-50, 50, -20}));
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}));
  const View view = perspective_view(96, 96, {0, 0, 6}, {0, 0, 0});
  AoParams params = in_a_scene_of_100_m();
  params.sampling.radius = 3.0;
  params.ssao.range_check = false;
  const double unchecked = mean(ao(scene, view, params));
  params.ssao.range_check = true;
  const double checked = mean(ao(scene, view, params));
  EXPECT_GT(checked, unchecked + 0.003);
}

TEST_F(SsaoGl, The_box_blur_is_the_mean_of_its_pixels) {
  Scene scene;
  add_mesh(scene, quad({-10, 0, 10}, {10, 0, 10}, {10, 0, -1}, {-10, 0, -1}));
  add_mesh(scene, quad({-10, -1, -1}, {10, -1, -1}, {10, 10, -1}, {-10, 10, -1}));
  const View view = orthographic_view(64, 48, {0, 6, 8}, {0, 1, 0}, 1.5);
  AoParams params = in_a_scene_of_100_m();
  params.sampling.samples = 8;
  params.blur.kind = AoBlur::none;
  const Image<float> raw = ao(scene, view, params);
  params.blur.kind = AoBlur::box;
  for (const int side : {1, 4, 5}) {
    params.blur.size = side;
    const Image<float> blurred = ao(scene, view, params);
    for (int y = 8; y < 40; ++y) {
      for (int x = 8; x < 56; ++x) {
        double sum = 0.0;
        for (int j = 0; j < side; ++j) {
          for (int i = 0; i < side; ++i) sum += static_cast<double>(raw.at(x + i - side / 2, y + j - side / 2));
        }
        ASSERT_NEAR(static_cast<double>(blurred.at(x, y)), sum / (side * side), 1e-6) << side << " " << x << " " << y;
      }
    }
  }
}

// The image at a bias of the axes, from the first samples.
Image<float> image_at(const std::vector<std::vector<OccludingSample>>& pixels, const View& view, std::size_t bias,
                      int samples) {
  Image<float> ao(view.width, view.height, 1.0f);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    float occlusion = 0.0f;
    for (const OccludingSample& each : pixels[i]) {
      if (each.index() < samples && bias < each.biases()) occlusion += each.weight;
    }
    ao[i] = std::max(1.0f - occlusion * share_of_sample(samples), 0.0f);
  }
  return ao;
}

TEST_F(SsaoGl, One_pass_holds_the_image_of_every_bias_and_number_of_samples_to_the_bit) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  add_mesh(scene, box({-0.1f, 0, 2}, {0.1f, 3, 2.1f}));
  AoParams params = in_a_scene_of_100_m();
  params.sampling.radius = 1.0;
  params.blur.kind = AoBlur::none;
  params.kernel.kind = AoKernel::progressive;
  const AoAxes axes{{-0.05f, 0.0f, 1e-4f, 0.01f, 0.012f, 0.05f, 0.3f, 2.0f}, {1, 3, 8, 17, 49}, {}};
  for (const View& view :
       {perspective_view(96, 64, {2, 3, 4}, {0, 0.5, 0}), orthographic_view(96, 64, {2, 3, 4}, {0, 0.5, 0}, 2.0)}) {
    const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), scene), view);
    for (const bool range_check : {true, false}) {
      params.ssao.range_check = range_check;
      std::vector<std::vector<OccludingSample>> pixels;
      draw_ao_response(context(), surfels, view, params, 3, axes, [&](std::span<const AoResponseRow> rows) {
        for (const AoResponseRow& row : rows) {
          ASSERT_EQ(static_cast<std::size_t>(row.y) * row.counts.size(), pixels.size());
          for (std::size_t x = 0; x < row.counts.size(); ++x) {
            pixels.emplace_back(row.pixel(x).begin(), row.pixel(x).end());
          }
        }
      });
      ASSERT_EQ(pixels.size(), 96u * 64u);
      for (std::size_t b = 0; b < axes.biases.size(); ++b) {
        for (const int samples : axes.samples) {
          params.bias.depth = static_cast<double>(axes.biases[b]);
          params.sampling.samples = samples;
          const Image<float> drawn = draw_ao(context(), surfels, view, params, 3);
          EXPECT_EQ(drawn.pixels, image_at(pixels, view, b, samples).pixels) << axes.biases[b] << " " << samples;
        }
      }
      EXPECT_LT(mean(image_at(pixels, view, 0, 49)), mean(image_at(pixels, view, 5, 49)));
    }
  }
}

TEST_F(SsaoGl, Intensity_and_power_follow_the_blur) {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  const View view = perspective_view(64, 48, {2, 3, 4}, {0, 0.5, 0});
  AoParams params = in_a_scene_of_100_m();
  params.sampling.radius = 1.0;
  const Image<float> plain = ao(scene, view, params);
  params.tone = {1.5, 2.0};
  const Image<float> toned = ao(scene, view, params);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const double open = std::max(0.0, 1.0 - 1.5 * (1.0 - static_cast<double>(plain[i])));
    ASSERT_NEAR(static_cast<double>(toned[i]), open * open, 1e-6);
  }
  EXPECT_LT(mean(toned), mean(plain) - 0.01);
}

}  // namespace
}  // namespace umbrameter
