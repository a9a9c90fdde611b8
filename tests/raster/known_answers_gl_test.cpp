// Shadow-map bias measured through the real shadow map against what mathematics says of it.
// Notation: texel t in metres, theta between the light and the plane's normal, psi the azimuth of the slope in texel
// axes, p >= q the larger and smaller of |cos psi|, |sin psi|, bias b in metres along the light.
#include <algorithm>
#include <cmath>

#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

constexpr double degrees = pi / 180.0;

struct Slope {
  double theta;  // degrees
  double psi;    // degrees
};

class KnownAnswersGl : public GlTest {
 protected:
  struct Plane {
    UploadedScene scene;
    GpuGBuffer surfels;
    ShadowMap map;
    Light light;
  };

  // A plane that fills the whole map, and 256 x 256 surfels spread over the middle of it.
  Plane make_plane(const Slope& slope, int resolution, double texel) const {
    const double theta = slope.theta * degrees;
    const LightFrame frame = exact_frame({std::sin(theta), std::cos(theta), 0}, resolution, texel, slope.psi * degrees);
    Scene scene;
    add_mesh(scene, ground(static_cast<float>(8.0 * frame.half_extent)));
    Plane plane;
    plane.light = light_of(frame);
    plane.scene = upload(context(), scene);
    plane.map = draw_shadow_map(context(), plane.scene, plane.light, frame, {});
    const double reach = 0.5 * frame.half_extent;
    plane.surfels = upload(context(), surfels_on_ground(256, 256, -reach, reach, -reach, reach));
    return plane;
  }

  RasterVisibility measure(const Plane& plane, const ShadowParams& params) const {
    const gl::Texture lit = upload(context(), Image<float>(256, 256, 1.0f));
    return draw_visibility(context(), {plane.scene, plane.surfels, plane.map, plane.light, params, &lit});
  }
};

// Item 12: s = b / (t tan theta). s <= (p-q)/2: 1/2 - s/p; up to (p+q)/2: ((p+q)/2 - s)^2 / (2pq); above: 0.
double acne_share(double b, double t, const Slope& slope) {
  const double c = std::abs(std::cos(slope.psi * degrees));
  const double d = std::abs(std::sin(slope.psi * degrees));
  const double p = std::max(c, d);
  const double q = std::min(c, d);
  const double s = b / (t * std::tan(slope.theta * degrees));
  if (s <= (p - q) / 2) return 0.5 - s / p;
  if (s < (p + q) / 2) return ((p + q) / 2 - s) * ((p + q) / 2 - s) / (2 * p * q);
  return 0.0;
}

TEST_F(KnownAnswersGl, The_acne_share_of_a_lit_plane_follows_its_formula) {
  for (const Slope slope : {Slope{35, 0}, Slope{60, 45}, Slope{75, 20}}) {
    for (const int resolution : {64, 256, 1024}) {
      const double t = 12.8 / resolution;
      const Plane plane = make_plane(slope, resolution, t);
      for (const double share_of_least : {0.1, 0.3, 0.6, 0.9}) {
        ShadowParams params;
        params.constant_bias = share_of_least * t * std::tan(slope.theta * degrees) * 0.7;
        const RasterVisibility found = measure(plane, params);
        const vec4 classes = mean(found.wrong);
        // 65536 surfels, evenly spread; their rectangle cuts texels at its edge; vertices snap to 1/256 texel.
        EXPECT_NEAR(static_cast<double>(classes.x), acne_share(params.constant_bias, t, slope),
                    3e-3 + 0.15 / resolution)
            << slope.theta << "/" << slope.psi << " at " << resolution << ", bias " << params.constant_bias;
        EXPECT_EQ(classes.y, 0.0f);
        EXPECT_EQ(classes.z, 0.0f);
        EXPECT_EQ(classes.w, 0.0f);
        EXPECT_NEAR(1.0 - mean(found.visibility), static_cast<double>(classes.x), 1e-6);
      }
    }
  }
}

TEST_F(KnownAnswersGl, The_acne_share_meets_the_table) {
  struct Row {
    double psi, bias, share;
  };
  // t = 0.1, theta = 60 degrees.
  for (const Row row : {Row{0, 0.0, .5}, Row{0, .02, .384530}, Row{0, .04, .269060}, Row{0, .08, .038120},
                        Row{45, .04, .226735}, Row{45, .08, .060136}}) {
    const Plane plane = make_plane({60, row.psi}, 128, 0.1);
    ShadowParams params;
    params.constant_bias = row.bias;
    EXPECT_NEAR(static_cast<double>(mean(measure(plane, params).wrong).x), row.share, 4e-3)
        << row.psi << " " << row.bias;
  }
}

// Item 11: b0 = rho t (p+q) tan theta, rho = r + 1/2 for (2r+1)^2 nearest taps.
TEST_F(KnownAnswersGl, The_least_bias_without_acne_follows_its_formula) {
  for (const Slope slope : {Slope{35, 0}, Slope{60, 45}, Slope{75, 20}}) {
    for (const int resolution : {64, 256, 1024}) {
      const double t = 12.8 / resolution;
      const Plane plane = make_plane(slope, resolution, t);
      const double p_plus_q = std::abs(std::cos(slope.psi * degrees)) + std::abs(std::sin(slope.psi * degrees));
      for (const int taps : {1, 3, 5}) {
        ShadowParams params;
        params.filter = taps == 1 ? ShadowFilter::nearest : ShadowFilter::box;
        params.filter_size = taps;
        const double least = 0.5 * taps * t * p_plus_q * std::tan(slope.theta * degrees);
        params.constant_bias = 1.01 * least;
        EXPECT_EQ(mean(measure(plane, params).visibility), 1.0) << slope.theta << " " << resolution << " " << taps;
        params.constant_bias = 0.96 * least;
        EXPECT_LT(mean(measure(plane, params).visibility), 1.0) << slope.theta << " " << resolution << " " << taps;
      }
    }
  }
}

TEST_F(KnownAnswersGl, A_slope_scaled_bias_counts_texels) {
  // The same with the bias as s m, m = t tan theta: least s is (p+q)/2 = 0.5 for psi = 0.
  for (const double theta : {20.0, 50.0, 70.0}) {
    const Plane plane = make_plane({theta, 0}, 256, 0.05);
    ShadowParams params;
    params.constant_bias = 0.0;
    params.slope_bias = 0.51;
    EXPECT_EQ(mean(measure(plane, params).visibility), 1.0) << theta;
    params.slope_bias = 0.25;  // item 12: 1/2 - s/p
    EXPECT_NEAR(mean(measure(plane, params).visibility), 1.0 - 0.25, 4e-3) << theta;
  }
}

// Item 13: behind a wall of thickness w on flat ground, sun elevation e: a strip of width max(0, b cos e - w).
TEST_F(KnownAnswersGl, The_lit_strip_behind_a_wall_follows_its_formula) {
  for (const double elevation : {25.0, 40.0, 60.0}) {
    const double e = elevation * degrees;
    const dvec3 towards(-std::cos(e), std::sin(e), 0);
    Scene scene;
    add_mesh(scene, ground(30.0f));
    add_mesh(scene, box({-0.05f, 0, -20}, {0, 3, 20}));
    const UploadedScene uploaded = upload(context(), scene);
    // All in the wall's shadow, which is 3 / tan e >= 1.7 m wide.
    const double width = 0.5;
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, 0, width, -2, 2));
    const gl::Texture blocked = upload(context(), Image<float>(256, 256, 0.0f));
    for (const int resolution : {512, 1024, 2048}) {
      // Turned against the wall, so that the strip meets texels in every phase.
      const LightFrame frame = exact_frame(towards, resolution, 10.0 / resolution, 20 * degrees);
      const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(frame), frame, {});
      for (const double bias : {0.02, 0.2, 0.4}) {
        ShadowParams params;
        params.constant_bias = bias;
        const RasterVisibility found =
            draw_visibility(context(), {uploaded, surfels, map, light_of(frame), params, &blocked});
        const double strip = std::max(0.0, bias * std::cos(e) - 0.05);
        // A texel shifts each piece of the edge by up to half of t sin e; over all phases that averages out.
        const double tolerance = 0.15 * frame.half_extent * 2 / resolution + 0.002;
        EXPECT_NEAR(mean(found.visibility) * width, strip, tolerance) << elevation << " " << resolution << " " << bias;
        const vec4 classes = mean(found.wrong);
        EXPECT_NEAR(static_cast<double>(classes.z) * width, strip, tolerance) << "peter-panning, " << elevation;
        EXPECT_EQ(classes.x, 0.0f);
        EXPECT_EQ(classes.y, 0.0f);
      }
    }
  }
}

}  // namespace
}  // namespace umbrameter
