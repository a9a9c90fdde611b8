// A warped map, drawn: its depths, and the least biases without acne.
#include <cmath>

#include "techniques/shadow/cascades.h"
#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class WarpGl : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    add_mesh(scene_, ground(60.0f));
    uploaded_ = upload(context(), scene_);
    view_ = perspective_view(200, 150, {0, 2, 20}, {0, 0, 10});
    surfels_ = draw_gbuffer(context(), uploaded_, view_);
    MapFitParams fit;
    fit.fit = MapFit::view;
    fit.warp = Warp::lispsm;
    layout_ = fit_map(light_, bounds_of(scene_), {256, 1}, {read_back(context(), surfels_), view_}, fit);
    ASSERT_TRUE(layout_.warp);
  }

  double acne(const BiasParams& bias, const MapDepthParams& depth = {}) const {
    const gl::Texture lit = upload(context(), Image<float>(200, 150, 1.0f));
    const ShadowMap map = draw_shadow_map(context(), uploaded_, light_, layout_, depth);
    return static_cast<double>(
        mean(draw_visibility(context(), {uploaded_, surfels_, map, light_, bias, make_technique(ShadowParams{}), &lit})
                 .wrong)
            .x);
  }

  const double tan_theta_ = 1.2;
  const Light light_ = directional_light({1.2 * std::cos(0.4), 1.0, 1.2 * std::sin(0.4)});
  Scene scene_;
  UploadedScene uploaded_;
  View view_;
  GpuGBuffer surfels_;
  MapLayout layout_;
};

TEST_F(WarpGl, It_holds_the_depth_of_a_plane_at_each_texels_centre) {
  const ShadowMapImages images = read_back(context(), draw_shadow_map(context(), uploaded_, light_, layout_));
  const dmat4 world_from_light = glm::inverse(layout_.light_from_world);
  int compared = 0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const float stored = images.depth[0].at(x, 255 - y);
      const dvec3 origin(world_from_light * dvec4(texel_ray(layout_, {x, y}, 0).origin, 1.0));
      const dvec3 hit = origin - origin.y / light_.axis().y * light_.axis();
      if (!(std::hypot(hit.x, hit.z) < 59.9)) continue;  // beyond the ground, or beyond the horizon
      ASSERT_NEAR(static_cast<double>(stored) * layout_.far_depth, -origin.y / light_.axis().y, 1e-4) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 256 * 200);
}

// ½ t (p + q) tan theta with p + q ≤ √2, as for other maps; t is a texel's longer side.
TEST_F(WarpGl, A_bias_in_texels_the_receiver_plane_and_the_polygon_offset_free_a_plane_of_acne) {
  BiasParams bias;
  bias.constant = 0.0;
  EXPECT_GT(acne(bias), 0.3);  // half of the pixels that show it
  bias.constant = {1.05 * std::sqrt(0.5) * tan_theta_, LengthUnit::texels};
  EXPECT_EQ(acne(bias), 0.0);
  bias.constant = 1e-4;
  bias.receiver_plane = true;
  EXPECT_EQ(acne(bias), 0.0);
  bias.receiver_plane = false;
  MapDepthParams depth;
  depth.polygon_offset_factor = 1.1;  // the texels of a quad differ in size
  EXPECT_EQ(acne(bias, depth), 0.0);
}

}  // namespace
}  // namespace umbrameter
