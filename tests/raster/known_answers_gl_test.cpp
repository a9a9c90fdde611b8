// Shadow-map bias measured through the real shadow map against what mathematics says of it.
// Notation: texel t in metres, theta between the light and the plane's normal, psi the azimuth of the slope in texel
// axes, p >= q the larger and smaller of |cos psi|, |sin psi|, bias b in metres along the light.
#include <algorithm>
#include <cmath>

#include "compare/bias_response.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

constexpr double degrees = pi / 180.0;

struct Slope {
  double theta;  // degrees
  double psi;    // degrees
};

std::vector<double> evenly(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / (count - 1));
  return values;
}

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

// Of 256 x 256 surfels.
double share(const VisibilitySums& sums, Cause cause) {
  return static_cast<double>(sums.wrong[static_cast<std::size_t>(cause)]) / (256.0 * 256.0 * sums.weight_sum);
}

class KnownAnswersGl : public GlTest {
 protected:
  struct Plane {
    UploadedScene scene;
    GpuGBuffer surfels;
    ShadowMap map;
    Light light;
  };

  // A plane that fills the whole map, and 256 x 256 surfels spread over the middle of it.
  Plane make_plane(const Slope& slope, int resolution, double texel, const MapDepthParams& depth = {}) const {
    const double theta = slope.theta * degrees;
    const MapLayout layout =
        exact_layout({std::sin(theta), std::cos(theta), 0}, resolution, texel, slope.psi * degrees);
    Scene scene;
    add_mesh(scene, ground(static_cast<float>(8.0 * layout.views.front().half_extent)));
    Plane plane;
    plane.light = light_of(layout);
    plane.scene = upload(context(), scene);
    plane.map = draw_shadow_map(context(), plane.scene, plane.light, layout, depth);
    const double reach = 0.5 * layout.views.front().half_extent;
    plane.surfels = upload(context(), surfels_on_ground(256, 256, -reach, reach, -reach, reach));
    return plane;
  }

  // The sums at each bias; the truth is the same everywhere.
  std::vector<VisibilitySums> respond(const Plane& plane, const ShadowParams& params, const std::vector<double>& biases,
                                      float truth) const {
    const gl::Texture image = upload(context(), Image<float>(256, 256, truth));
    const BiasHistogram histogram = draw_bias_response(
        context(), {plane.scene, plane.surfels, plane.map, plane.light, params.bias, make_technique(params), &image},
        {to_floats(biases), {0.0f}});
    return sums_at_biases(histogram, 0);
  }

  RasterVisibility measure(const Plane& plane, const ShadowParams& params) const {
    const gl::Texture lit = upload(context(), Image<float>(256, 256, 1.0f));
    return draw_visibility(
        context(), {plane.scene, plane.surfels, plane.map, plane.light, params.bias, make_technique(params), &lit});
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

// At every bias of an axis, from one pass each.
TEST_F(KnownAnswersGl, The_acne_share_of_a_lit_plane_follows_its_formula) {
  for (const double theta : {20.0, 35.0, 50.0, 65.0, 80.0}) {
    for (const double psi : {0.0, 20.0, 45.0}) {
      for (const int resolution : {64, 512}) {
        const Slope slope{theta, psi};
        const double t = 12.8 / resolution;
        const std::vector<double> biases = evenly(0.0, t * std::tan(theta * degrees), 64);
        const std::vector<VisibilitySums> found = respond(make_plane(slope, resolution, t), {}, biases, 1.0f);
        for (std::size_t k = 0; k < biases.size(); ++k) {
          // Four standard deviations of a count of 65536 surfels; their window is no whole number of texels long, which
          // shifts the share of a pattern of period one by at most f(1 − f) over its length in texels; and rasterisers
          // snap the plane's corners to 1/256 texel, which moves its depths by up to 1/512 texel along both axes.
          const double expected = acne_share(biases[k], t, slope);
          const double spread = std::max(expected * (1.0 - expected), 1e-5);
          const double window = 0.5 * resolution * std::cos(theta * degrees);
          const double snapped = expected > 0.0 ? (1.0 + std::abs(std::tan(slope.psi * degrees))) / 512.0 : 0.0;
          EXPECT_NEAR(share(found[k], Cause::acne), expected,
                      4.0 * std::sqrt(spread / 65536.0) + spread / window + snapped)
              << theta << "/" << psi << " at " << resolution << ", bias " << biases[k];
          for (const Cause other : {Cause::false_occlusion, Cause::peter_panning, Cause::light_leak}) {
            EXPECT_EQ(share(found[k], other), 0.0);
          }
        }
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
    params.bias.constant = row.bias;
    EXPECT_NEAR(static_cast<double>(mean(measure(plane, params).wrong).x), row.share, 4e-3)
        << row.psi << " " << row.bias;
  }
}

// Item 11: b0 = rho t (p+q) tan theta, where rho is 1/2 for one nearest tap, r + 1/2 for (2r+1)^2 of them, 1 for
// bilinear 2×2 and r + 1 for (2r+1)^2 bilinear taps. An even kernel of n^2 taps has n/2 and (n+1)/2: its middle is at
// most half a texel from the receiver, or at the receiver.
TEST_F(KnownAnswersGl, The_least_bias_without_acne_follows_its_formula) {
  struct Case {
    ShadowFilter filter;
    int size;
    FilterTaps taps;
    double rho;
  };
  constexpr Case cases[] = {
      {ShadowFilter::nearest, 1, FilterTaps::nearest, 0.5}, {ShadowFilter::bilinear, 1, FilterTaps::nearest, 1.0},
      {ShadowFilter::box, 3, FilterTaps::nearest, 1.5},     {ShadowFilter::box, 5, FilterTaps::nearest, 2.5},
      {ShadowFilter::tent, 3, FilterTaps::nearest, 1.5},    {ShadowFilter::gaussian, 5, FilterTaps::nearest, 2.5},
      {ShadowFilter::box, 3, FilterTaps::linear, 2.0},      {ShadowFilter::box, 4, FilterTaps::nearest, 2.0},
      {ShadowFilter::gaussian, 4, FilterTaps::linear, 2.5}, {ShadowFilter::optimized, 5, FilterTaps::nearest, 3.0}};
  for (const Slope slope : {Slope{20, 0}, Slope{35, 70}, Slope{60, 45}, Slope{75, 20}}) {
    for (const int resolution : {64, 256, 1024}) {
      const double t = 12.8 / resolution;
      const Plane plane = make_plane(slope, resolution, t);
      const double p_plus_q = std::abs(std::cos(slope.psi * degrees)) + std::abs(std::sin(slope.psi * degrees));
      for (const Case& c : cases) {
        ShadowParams params;
        params.pcf.filter = c.filter;
        params.pcf.size = c.size;
        params.pcf.taps = c.taps;
        const double least = c.rho * t * p_plus_q * std::tan(slope.theta * degrees);
        const std::vector<double> biases = evenly(0.85 * least, 1.05 * least, 201);
        const std::vector<VisibilitySums> found = respond(plane, params, biases, 1.0f);
        std::size_t k = 0;
        while (k < found.size() && share(found[k], Cause::acne) > 0.0) ++k;
        ASSERT_LT(k, found.size());
        // Some of 65536 surfels lies within 1/100 texel of the corner that needs the most, for grids of up to 64²
        // texels in view; of more, within 1/20. Vertices snap to 1/256 texel.
        const double missed = (resolution > 256 ? 0.05 : 0.02) / c.rho;
        EXPECT_LE(biases[k], least * 1.004 + 1e-5) << slope.theta << " " << resolution << " " << c.rho;
        EXPECT_GE(biases[k], least * (1.0 - missed)) << slope.theta << " " << resolution << " " << c.rho;
      }
    }
  }
}

// EEVEE: (√½ / cos 0.534) t (sin theta + …) ≥ ½ t (p + q) sin theta.
// Final Fantasy XVI: 2 mm and the slope t p tan theta of the hardware ≥ ½ t (p + q) tan theta.
TEST_F(KnownAnswersGl, The_biases_of_EEVEE_and_Final_Fantasy_XVI_free_a_plane_of_acne_under_one_tap) {
  ShadowParams eevee;
  eevee.bias.constant = 0.0;
  eevee.bias.normal_offset = {0.82147, 0.0, OffsetProfile::eevee};
  ShadowParams oriented;
  oriented.bias.constant = 0.002;
  MapDepthParams slope_of_hardware;
  slope_of_hardware.polygon_offset_factor = 1.0;
  for (const double theta : {1.0, 20.0, 50.0, 75.0, 85.0}) {
    for (const double psi : {0.0, 20.0, 45.0}) {
      const Slope slope{theta, psi};
      const Plane plain = make_plane(slope, 256, 0.05);
      EXPECT_EQ(mean(measure(plain, eevee).visibility), 1.0) << theta << " " << psi;
      const Plane moved = make_plane(slope, 256, 0.05, slope_of_hardware);
      EXPECT_EQ(mean(measure(moved, oriented).visibility), 1.0) << theta << " " << psi;
      if (theta > 1.0) {
        EXPECT_LT(mean(measure(plain, oriented).visibility), 0.95) << "the 2 mm alone are too few";
      }
    }
  }
}

// The plane's depth at a texel's centre is what the map holds there, up to the rounding of depths to 2^-24 of the range
// and of vertices to 1/256 texel, which moves the plane by t tan theta / 256 along the light.
TEST_F(KnownAnswersGl, The_receiver_plane_frees_a_plane_of_acne_at_slopes_up_to_85_degrees) {
  for (const Slope slope : {Slope{20, 0}, Slope{60, 45}, Slope{75, 20}, Slope{85, 70}}) {
    for (const int resolution : {64, 1024}) {
      const double t = 12.8 / resolution;
      const Plane plane = make_plane(slope, resolution, t);
      ShadowParams params;
      params.bias.receiver_plane = true;
      const double rounding = t * std::tan(slope.theta * degrees) / 256.0 + plane.map.layout.far_depth * 0x1p-22;
      params.bias.constant = rounding;
      for (const ShadowFilter filter : {ShadowFilter::nearest, ShadowFilter::bilinear, ShadowFilter::gaussian,
                                        ShadowFilter::area_tent, ShadowFilter::vogel}) {
        params.pcf.filter = filter;
        params.pcf.size = 7;
        params.pcf.radius = 6.0;
        EXPECT_EQ(mean(measure(plane, params).visibility), 1.0) << slope.theta << " " << resolution;
      }
    }
  }
}

// A tap at distance d from the receiver in the map needs at most d tan theta.
TEST_F(KnownAnswersGl, A_cone_bias_of_tan_theta_frees_a_plane_of_acne_under_every_kernel) {
  for (const double theta : {20.0, 60.0, 75.0}) {
    const Plane plane = make_plane({theta, 30}, 256, 0.05);
    ShadowParams params;
    for (const int size : {1, 4, 7}) {
      params.pcf.filter = ShadowFilter::box;
      params.pcf.size = size;
      params.bias.constant = 0.05 * std::tan(theta * degrees) / 256.0 + plane.map.layout.far_depth * 0x1p-22;
      params.bias.cone = std::tan(theta * degrees);
      EXPECT_EQ(mean(measure(plane, params).visibility), 1.0) << theta << " " << size;
      params.bias.cone *= 0.5;
      EXPECT_LT(mean(measure(plane, params).visibility), 1.0) << theta << " " << size;
    }
  }
}

TEST_F(KnownAnswersGl, A_slope_scaled_bias_counts_texels) {
  // The same with the bias as s m, m = t tan theta: least s is (p+q)/2 = 0.5 for psi = 0.
  for (const double theta : {20.0, 50.0, 70.0}) {
    const Plane plane = make_plane({theta, 0}, 256, 0.05);
    ShadowParams params;
    params.bias.constant = 0.0;
    params.bias.slope = 0.51;
    EXPECT_EQ(mean(measure(plane, params).visibility), 1.0) << theta;
    params.bias.slope = 0.25;  // item 12: 1/2 - s/p
    EXPECT_NEAR(mean(measure(plane, params).visibility), 1.0 - 0.25, 4e-3) << theta;
  }
}

// The receiver is raised by o t sin theta along its normal, so that the shadow of a wall of height h ends at
// (h − o t sin theta) tan theta.
TEST_F(KnownAnswersGl, A_normal_offset_shortens_a_shadow_by_its_length_times_tan_theta) {
  for (const double theta : {30.0, 50.0, 70.0}) {
    const double a = theta * degrees;
    Scene scene;
    add_mesh(scene, ground(30.0f));
    add_mesh(scene, box({-0.2f, 0, -20}, {0, 1, 20}));
    const UploadedScene uploaded = upload(context(), scene);
    const double texel = 0.01;
    const MapLayout layout = exact_layout({-std::sin(a), std::cos(a), 0}, 1024, texel, 20 * degrees);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
    const double width = 1.2 * std::tan(a);
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, 0, width, -1, 1));
    for (const double offset : {0.0, 4.0, 16.0}) {
      ShadowParams params;
      params.bias.constant = 0.02;
      params.bias.slope = 0.75;  // frees the ground of acne; the wall's top is far above it
      params.bias.normal_offset.texels = offset;
      const Image<float> found =
          draw_visibility(context(), {uploaded, surfels, map, light_of(layout), params.bias, make_technique(params)})
              .visibility;
      const double length = (1.0 - mean(found)) * width;
      // A texel covers t / cos theta of the ground; over all phases of the turned map that averages out.
      EXPECT_NEAR(length, (1.0 - offset * texel * std::sin(a)) * std::tan(a), 0.3 * texel / std::cos(a) + 0.03 * texel)
          << theta << " " << offset;
    }
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
      const MapLayout layout = exact_layout(towards, resolution, 10.0 / resolution, 20 * degrees);
      const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
      const std::vector<double> biases = evenly(0.0, 0.45, 32);
      const BiasHistogram histogram = draw_bias_response(
          context(), {uploaded, surfels, map, light_of(layout), {}, make_technique(ShadowParams{}), &blocked},
          {to_floats(biases), {0.0f}});
      const std::vector<VisibilitySums> found = sums_at_biases(histogram, 0);
      for (std::size_t k = 0; k < biases.size(); ++k) {
        const double strip = std::max(0.0, biases[k] * std::cos(e) - 0.05);
        // A texel shifts each piece of the edge by up to half of t sin e; over all phases that averages out.
        const double tolerance = 0.15 * layout.views.front().half_extent * 2 / resolution + 0.002;
        EXPECT_NEAR(share(found[k], Cause::peter_panning) * width, strip, tolerance)
            << elevation << " " << resolution << " " << biases[k];
        EXPECT_EQ(share(found[k], Cause::acne), 0.0);
        EXPECT_EQ(share(found[k], Cause::false_occlusion), 0.0);
      }
    }
  }
}

// On a plane across the axis of a light at a power of two metres, the matrix and the division give each receiver the
// very number that the map stores.
TEST_F(KnownAnswersGl, An_equal_number_is_lit_or_not_as_the_comparison_says) {
  Scene scene;
  add_mesh(scene, ground(30.0f));
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = spot_light({0, 4, 0}, {0, 0, 0}, 0.35);
  const GpuGBuffer surfels = upload(context(), surfels_on_ground(64, 64, -1, 1, -1, 1));
  const auto visibility = [&](DepthComparison comparison, double near, double far) {
    MapDepthParams depth;
    depth.encoding = DepthEncoding::perspective;
    depth.near_depth = near;
    depth.far_depth = far;
    depth.receiver_precision = ReceiverPrecision::single;
    depth.comparison = comparison;
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 256), depth);
    ShadowParams params;
    params.bias.constant = {0.0, LengthUnit::metres};
    return mean(
        draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)}).visibility);
  };
  for (const auto& [near, far] : {std::pair{0.016, 0.0}, std::pair{0.016, 16.0}, std::pair{0.5, 500.0}}) {
    EXPECT_EQ(visibility(DepthComparison::less_equal, near, far), 1.0) << near;
    EXPECT_EQ(visibility(DepthComparison::less, near, far), 0.0) << near;
  }
  EXPECT_EQ(visibility(DepthComparison::less, 0.5, 3.0), 1.0) << "nothing beyond the far plane casts";
}

// A perspective depth is A − B / z with B = f n / (f − n), and the reciprocal depth of a plane with the unit normal m
// at the distance d from the light is linear in the map's coordinates: m · (x, y, −1) / d. A nearest tap is off by half
// a texel t (a tangent), so that the same bias B t (|m.x| + |m.y|) / (2 d) serves the whole plane.
TEST_F(KnownAnswersGl, One_bias_in_a_perspective_map_s_depth_serves_a_whole_plane) {
  Scene scene;
  add_mesh(scene, ground(30.0f));
  const UploadedScene uploaded = upload(context(), scene);
  const Light light = spot_light({0, 3, 0}, {6, 0, 0.5}, 0.35);
  const MapLayout layout = fit_light(light, bounds_of(scene), 256);
  MapDepthParams depth;
  depth.encoding = DepthEncoding::reversed;
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout, depth);
  const dvec3 normal(layout.light_from_world * dvec4(0, 1, 0, 0));
  const double texel = 2.0 * layout.views.front().half_extent / 256;
  const double b = layout.far_depth * depth.near_depth / (layout.far_depth - depth.near_depth);
  const double least = b * texel * (std::abs(normal.x) + std::abs(normal.y)) / (2.0 * 3.0);
  const gl::Texture lit = upload(context(), Image<float>(256, 256, 1.0f));
  const auto acne = [&](double from, double to, const Length& bias) {
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, from, to, -0.1 * from, 0.1 * from));
    ShadowParams params;
    params.bias.constant = bias;
    return mean(draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params), &lit})
                    .wrong)
        .x;
  };
  for (const auto& [from, to] : {std::pair{3.0, 4.0}, std::pair{8.0, 9.0}, std::pair{16.0, 20.0}}) {
    EXPECT_EQ(acne(from, to, {1.005 * least, LengthUnit::map_depth}), 0.0f) << from;
    EXPECT_GT(acne(from, to, {0.9 * least, LengthUnit::map_depth}), 0.0f) << from;
  }
  // In metres, what serves the far end is many times what serves the near one.
  const auto metres = [&](double x) {
    return Length{1.005 * least * metres_per_map_depth(map.layout, depth_of(layout, {x, 0, 0}))};
  };
  EXPECT_EQ(acne(3.0, 4.0, metres(4.0)), 0.0f);
  EXPECT_GT(acne(16.0, 20.0, metres(4.0)), 0.1f);
  EXPECT_GT(metres(20.0).number, 10.0 * metres(4.0).number);
}

}  // namespace
}  // namespace umbrameter
