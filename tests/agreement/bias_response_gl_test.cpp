// One pass over all biases against each bias drawn on its own.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "compare/bias_response.h"
#include "core/error.h"
#include "raster/rasterizer.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

struct Filter {
  const char* name;
  ShadowFilter filter;
  int size;
  FilterTaps taps;
};
constexpr Filter filters[] = {{"nearest", ShadowFilter::nearest, 3, FilterTaps::nearest},
                              {"bilinear", ShadowFilter::bilinear, 3, FilterTaps::nearest},
                              {"box 3", ShadowFilter::box, 3, FilterTaps::nearest},
                              {"box 3 of linear taps", ShadowFilter::box, 3, FilterTaps::linear},
                              {"tent 5", ShadowFilter::tent, 5, FilterTaps::nearest},
                              {"Gaussian 5", ShadowFilter::gaussian, 5, FilterTaps::linear},
                              {"Poisson 16", ShadowFilter::poisson, 3, FilterTaps::nearest}};

class BiasResponseGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  const gl::Context& context() const { return *context_; }

 private:
  std::unique_ptr<gl::Context> context_;
};

TEST_F(BiasResponseGl, One_pass_counts_what_rendering_each_cell_counts) {
  const BiasAxes axes{{-0.01f, 0.0f, 0.004f, 0.02f, 0.05f, 0.3f, 2.0f}, {0.0f, 0.5f, 2.0f, -0.5f}};
  Scene scene = load_scene("contact-box");
  std::vector<std::string> notes;
  const View view{160, 90, select_camera(scene, "", 16.0 / 9.0, notes)};
  const UploadedScene uploaded = upload(context(), scene);
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view);
  const GBuffer gbuffer = read_back(context(), surfels);
  const Tracer tracer(scene);
  Light spot = scene.lights.front();
  const Bounds bounds = bounds_of(scene);
  const dvec3 above = bounds.center() + -3.0 * bounds.radius() * spot.axis();
  spot.world_from_light[3] = dvec4(above, 1.0);
  spot.shape = SpotLight{1000.0, 0.0, 0.4};
  Light point = spot;
  point.shape = PointLight{};
  for (const Light& light : {scene.lights.front(), spot, point}) {
    const LightFrame frame = fit_light(light, bounds, 200);
    const CountedPixels counted = count_pixels(gbuffer, light, frame);
    const Image<float> visibility = trace_visibility(tracer, gbuffer, light).visibility;
    const gl::Texture truth = upload_truth(context(), visibility, counted.counting);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, frame, {});
    for (const Filter& filter : filters) {
      for (const double normal_offset : {0.0, 0.7}) {
        ShadowParams params;
        params.filter = filter.filter;
        params.filter_size = filter.size;
        params.filter_taps = filter.taps;
        params.normal_offset = normal_offset;
        const BiasHistogram histogram =
            draw_bias_response(context(), {uploaded, surfels, map, light, params, &truth}, axes);
        std::uint64_t wrong = 0;
        for (std::size_t s = 0; s < axes.slope.size(); ++s) {
          const std::vector<VisibilitySums> at = sums_at_biases(histogram, s);
          for (std::size_t k = 0; k < axes.constant.size(); ++k) {
            params.constant_bias = static_cast<double>(axes.constant[k]);
            params.slope_bias = static_cast<double>(axes.slope[s]);
            const RasterVisibility cell = draw_visibility(context(), {uploaded, surfels, map, light, params, &truth});
            const VisibilitySums drawn = sum_wrong_taps(cell.wrong, counted);
            ASSERT_EQ(at[k].weight_sum, drawn.weight_sum) << filter.name;
            ASSERT_EQ(at[k].wrong, drawn.wrong)
                << filter.name << " bias " << params.constant_bias << " slope " << params.slope_bias;
            ASSERT_TRUE(at[k].squares == drawn.squares) << filter.name << " " << params.constant_bias;
            ASSERT_EQ(at[k].largest, drawn.largest) << filter.name << " " << params.constant_bias;
            wrong += drawn.wrong[0] + drawn.wrong[1] + drawn.wrong[2] + drawn.wrong[3];
            // The additive identity, from the images themselves.
            double error = 0.0;
            for (std::size_t i = 0; i < visibility.size(); ++i) {
              if (counted.counting[i] != Counting::counted) continue;
              error += std::abs(static_cast<double>(cell.visibility[i]) - static_cast<double>(visibility[i]));
            }
            const TruthCounts counts = count_truth(visibility, counted);
            ASSERT_NEAR(error / static_cast<double>(counts.pixels), to_statistics(drawn, counts).mae, 1e-7);
          }
        }
        EXPECT_GT(wrong, 0u) << filter.name;
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
