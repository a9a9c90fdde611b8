// Soft shadows of a half-plane edge. Light at height H, edge at height h, receiver x from the edge's foot towards the
// open side; V is the visible share of the light.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/quantiles.h"
#include "edge_scene.h"
#include "raytrace/tracer.h"

namespace umbrameter {
namespace {

using namespace edge;

struct Coverage {
  int pixels = 0;
  int held = 0;
  double normal = 0.0;  // (mean of estimates − mean of answers) over its standard error
};

// Over seeds, at each point, with the interval of every estimate.
Coverage cover(const Edge& edge, const Light& light, const std::vector<vec3>& points,
               const std::function<double(vec3)>& exact, const TruthParams& params, std::uint32_t seeds) {
  const Tracer tracer(edge.scene);
  const GBuffer gbuffer = edge.surfels(points);
  std::vector<double> answers;
  for (const vec3& point : points) answers.push_back(exact(point));
  Coverage coverage;
  double difference = 0.0;
  double variance = 0.0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const TracedVisibility traced = trace_visibility(tracer, gbuffer, light, {params, seed});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = static_cast<double>(traced.visibility[i]) - answers[i];
      const double s = traced.standard_error[i];
      ++coverage.pixels;
      coverage.held += std::abs(error) <= student_95(traced.degrees_of_freedom) * s ? 1 : 0;
      difference += error;
      variance += traced.variance[i];
    }
  }
  coverage.normal = difference / std::sqrt(std::max(variance, 1e-14));
  return coverage;
}

// Points from −reach to reach along x, each away from the others along z, inside of the penumbra.
std::vector<vec3> penumbra(double reach, int count) {
  std::vector<vec3> points;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * (i + 0.5) / count - 1.0;
    points.emplace_back(static_cast<float>(0.94 * reach * t), 0.0f, static_cast<float>(0.8 * std::sin(37.0 * t)));
  }
  return points;
}

// 95 ± 1.5 %, and 2.5 standard deviations of a binomial count, √(.0475 n).
void expect_honest(const Coverage& coverage) {
  const double n = coverage.pixels;
  const double share = coverage.held / n;
  ASSERT_GT(n, 300.0);
  EXPECT_NEAR(share, 0.95, 0.015 + 2.5 * std::sqrt(0.0475 / n));
  // Independent estimates: the normal distribution exceeds 4 once in 16000.
  EXPECT_LT(std::abs(coverage.normal), 4.0);
}

TEST(AreaShadow, A_rectangle_over_an_edge) {
  // H = 5, h = 2, W = 1, x = .2: .800000.
  EXPECT_NEAR(of_rectangle(0.2, 1.0), 0.8, 1e-12);
  const Edge edge;
  const auto exact = [](vec3 p) { return of_rectangle(p.x, 1.0); };
  expect_honest(cover(edge, lamp(RectangleEmitter{1.0, 2.0}), std::vector<vec3>(50, {0.2f, 0, 0}), exact, {128}, 20));
  expect_honest(cover(edge, lamp(RectangleEmitter{1.0, 2.0}), penumbra(1.0 / 3.0, 100), exact, {128}, 20));
}

TEST(AreaShadow, A_disk_over_an_edge) {
  // H = 5, h = 2, r = .5, x = .2: .857622.
  EXPECT_NEAR(of_disk(0.2, 0.5), 0.857622, 1e-6);
  const Edge edge;
  const auto exact = [](vec3 p) { return of_disk(p.x, 0.5); };
  expect_honest(cover(edge, lamp(DiskEmitter{0.5}), std::vector<vec3>(50, {0.2f, 0, 0}), exact, {128}, 20));
  expect_honest(cover(edge, lamp(DiskEmitter{0.5}), penumbra(1.0 / 3.0, 100), exact, {128}, 20));
}

TEST(AreaShadow, A_rectangle_turned_against_the_edge) {
  // Turned by β, a side W throws a shadow W |cos β| long across the edge, the other L |sin β|: what lies on one side of
  // a line is the integral of a trapezoid. Here by quadrature along L.
  constexpr double width = 1.0;
  constexpr double length = 2.0;
  constexpr double turn = 0.5;
  const auto exact = [](vec3 p) {
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double along = length * ((i + 0.5) / steps - 0.5);
      // The line at height H that the edge throws back from p: light is seen where its x is above this.
      const double line = -p.x * (light_height - edge_height) / edge_height;
      sum += std::clamp(0.5 - (line - along * std::sin(turn)) / (width * std::cos(turn)), 0.0, 1.0) / steps;
    }
    return sum;
  };
  expect_honest(cover(Edge(), lamp(RectangleEmitter{width, length}, turn), penumbra(0.6, 100), exact, {128}, 20));
}

// From p the half plane's edge is a great circle, whose pole is (h, x, 0): directions on its side see the light. The
// angle from the circle to the middle of a light is δ, the light's half angle θ.
struct SeenCone {
  double tan_delta;
  double tan_theta;
};

SeenCone sphere_from(vec3 p, double radius) {
  const dvec3 pole = glm::normalize(dvec3(edge_height, p.x, 0.0));
  const dvec3 way = dvec3(0, light_height, 0) - dvec3(p);
  const double distance = glm::length(way);
  return {std::tan(std::asin(glm::dot(pole, way) / distance)), std::tan(std::asin(radius / distance))};
}

// Of the rings of the cone, by their solid angle sin θ dθ, the part on one side of the great circle.
double of_cap(const SeenCone& cone) {
  constexpr int steps = 20000;
  const double widest = std::atan(cone.tan_theta);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double theta = widest * (i + 0.5) / steps;
    const double part = 1.0 - std::acos(std::clamp(cone.tan_delta / std::tan(theta), -1.0, 1.0)) / pi;
    sum += std::sin(theta) * part * widest / steps;
  }
  return sum / (1.0 - std::cos(widest));
}

TEST(AreaShadow, A_sphere_over_an_edge) {
  // In the plane across the way to its middle the sphere is a disk of radius tan θ, and the edge a line at tan δ.
  constexpr double radius = 1.2;
  const auto area = [](vec3 p) {
    const SeenCone cone = sphere_from(p, radius);
    return of_disk(cone.tan_delta / cone.tan_theta);
  };
  const auto solid_angle = [](vec3 p) { return of_cap(sphere_from(p, radius)); };
  const std::vector<vec3> points = penumbra(0.75, 100);
  EXPECT_GT(std::abs(area(points[15]) - solid_angle(points[15])), 5e-4);
  const Light light = lamp(SphereEmitter{radius});
  expect_honest(cover(Edge(), light, points, area, {.spp = 128}, 20));
  expect_honest(
      cover(Edge(), light, points, solid_angle, {.spp = 128, .light_sampling = LightSampling::solid_angle}, 20));
}

TEST(AreaShadow, A_small_sphere_far_off_is_a_disk) {
  // TRUTH's disk, to first order in r/H: at r = .05 it holds to 10⁻⁴.
  const auto exact = [](vec3 p) { return of_disk(p.x, 0.05); };
  expect_honest(cover(Edge(), lamp(SphereEmitter{0.05}), penumbra(1.0 / 30.0, 100), exact, {128}, 20));
}

TEST(AreaShadow, A_sun_of_some_angular_diameter_over_an_edge) {
  // Overhead: a disk of radius h tan(α/2) in the edge's shadow.
  for (const double degrees : {0.53, 20.0, 120.0}) {
    const double half = 0.5 * degrees * pi / 180.0;
    const double radius = edge_height * std::tan(half);
    Light sun = shapes::directional({0, 1, 0});
    sun.emitter = DistantEmitter{2.0 * half};
    const double reach = std::min(radius, 7.0);
    const std::vector<vec3> points = penumbra(reach, 100);
    expect_honest(cover(
        Edge(), sun, points, [&](vec3 p) { return of_disk(p.x / radius); }, {.spp = 128}, 20));
    const auto solid_angle = [&](vec3 p) { return of_cap({p.x / edge_height, std::tan(half)}); };
    expect_honest(
        cover(Edge(), sun, points, solid_angle, {.spp = 128, .light_sampling = LightSampling::solid_angle}, 20));
  }
}

// By quadrature over the light: |cos| over the squared distance is the solid angle of a piece of it.
double by_solid_angle(vec3 p, double half, bool is_disk) {
  constexpr int steps = 1000;
  double lit = 0.0;
  double all = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double x = half * (2.0 * (i + 0.5) / steps - 1.0);
    for (int k = 0; k < steps / 10; ++k) {
      const double z = half * (20.0 * (k + 0.5) / steps - 1.0);
      if (is_disk && x * x + z * z > half * half) continue;
      const dvec3 way = dvec3(x, light_height, z) - dvec3(p);
      const double weight = way.y / std::pow(glm::length(way), 3);
      all += weight;
      // Where the way is at the edge's height.
      if (static_cast<double>(p.x) + way.x * edge_height / light_height > 0.0) lit += weight;
    }
  }
  return lit / all;
}

TEST(AreaShadow, The_visible_share_of_the_solid_angle_of_flat_lights) {
  // Half of 3 m at 5 m: the solid angle of the near side is much larger than that of the far one. The quadrature is
  // good to one cell of its thousand, in which the edge lies: 10⁻³ at most, and a fifth of it on the average.
  const std::vector<vec3> points = penumbra(2.0, 25);
  const TruthParams params{.spp = 64, .light_sampling = LightSampling::solid_angle};
  EXPECT_GT(std::abs(by_solid_angle(points[4], 3.0, false) - of_rectangle(points[4].x, 6.0)), 0.01);
  expect_honest(cover(
      Edge(), lamp(RectangleEmitter{6.0, 6.0}), points, [](vec3 p) { return by_solid_angle(p, 3.0, false); }, params,
      20));
  expect_honest(cover(
      Edge(), lamp(DiskEmitter{3.0}), points, [](vec3 p) { return by_solid_angle(p, 3.0, true); }, params, 20));
}

// A floor and a light 4 by 4 m that stands upright on it: in the plane x = `distance`, its near side at z = `near`.
TracedVisibility of_upright(const Emitter& emitter, double distance, double near, std::uint32_t points,
                            bool has_blocker = false) {
  Scene scene = shapes::empty_scene();
  const std::uint32_t floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  // Hides what is above 45 degrees from the surfel, however near.
  if (has_blocker) shapes::add_mesh(scene, shapes::quad({-8, 0.5f, 0.5f}, {16, 0, 0}, {0, 8, 0}));
  Light light = shapes::directional({1, 0, 0});
  light.shape = PointLight{};
  light.emitter = emitter;
  light.world_from_light[3] = dvec4(distance, 2.0, near + 2.0, 1);
  const GBuffer gbuffer = shapes::surfels({{0, 0, 0}}, {0, 1, 0}, floor, [](vec3) { return 1u; });
  const TruthParams params{.spp = static_cast<int>(points), .light_sampling = LightSampling::solid_angle};
  return trace_visibility(Tracer(scene), gbuffer, light, {params, 1});
}

TEST(AreaShadow, A_light_seen_edge_on_has_the_limit_of_its_visible_share) {
  // The surfel is in the plane of the rectangle, whose solid angle there is 0. Near that plane a piece counts by
  // cosine / r² = height / r³, and the height is the same for all pieces.
  const TracedVisibility open = of_upright(RectangleEmitter{4.0, 4.0}, 0.0, 1.0, 65536);
  EXPECT_EQ(open.visibility[0], 1.0f);
  EXPECT_EQ(open.variance[0], 0.0f);
  EXPECT_GT(open.standard_error[0], 0.0f);
  EXPECT_EQ(open.statistics.rays, 65536u);
  // What is below 45 degrees, y < z, of the square 0 < y < 4, 1 < z < 5, by quadrature. The blocker stands at z = 0.5.
  constexpr int steps = 2000;
  double lit = 0.0;
  double all = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double y = 4.0 * (i + 0.5) / steps;
      const double z = 1.0 + 4.0 * (k + 0.5) / steps;
      const double weight = std::pow(y * y + z * z, -1.5);
      all += weight;
      if (y < z) lit += weight;
    }
  }
  const TracedVisibility half = of_upright(RectangleEmitter{4.0, 4.0}, 0.0, 1.0, 65536, true);
  EXPECT_LT(half.standard_error[0], 0.002f);
  // Student's t with fifteen degrees of freedom is below 4.07 in 99.9 % of the cases.
  EXPECT_NEAR(half.visibility[0], lit / all, 4.07 * static_cast<double>(half.standard_error[0]));
  EXPECT_GT(std::abs(lit / all - 11.5 / 16.0), 0.02) << "even weights would say the same";
}

TEST(AreaShadow, Points_of_uneven_weights_claim_no_more_than_the_even_ones_that_they_are_worth) {
  // Nothing in the way: the half width is the rule of three's, −ln 0.05 over the points' worth, which is
  // (∫ w)² / (A ∫ w²) of their number (Kish 1965) with w = 1/r³. Here by quadrature, half a metre off the plane.
  constexpr int steps = 400;
  double area = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double y = 4.0 * (i + 0.5) / steps;
      const double z = 1.0 + 4.0 * (k + 0.5) / steps;
      if (std::hypot(y - 2.0, z - 3.0) > 2.0) continue;
      const double weight = std::pow(0.25 + y * y + z * z, -1.5);
      area += 1.0;
      sum += weight;
      squares += weight * weight;
    }
  }
  const double worth = sum * sum / (squares * area);
  EXPECT_LT(worth, 0.5);
  constexpr std::uint32_t points = 65536;
  const auto half_width_of = [](const Emitter& emitter) {
    const TracedVisibility traced = of_upright(emitter, 0.5, 1.0, points);
    EXPECT_EQ(traced.visibility[0], 1.0f);
    return student_95(traced.degrees_of_freedom) * static_cast<double>(traced.standard_error[0]);
  };
  EXPECT_NEAR(half_width_of(DiskEmitter{2.0}) * points, 2.995732 / worth, 0.02 * 2.995732 / worth);
  // Clear of the floor, which hides what is lower than the step off it.
  EXPECT_NEAR(half_width_of(RectangleEmitter{3.9, 3.9}) * points, 2.995732, 1e-3) << "even over its solid angle";
}

// Estimates a case with a tolerance: the standard error of a coverage of 95 % is √(.0475/4000) = 0.34 %.
void expect_stopped_honestly(const Light& light, const std::vector<vec3>& points,
                             const std::function<double(vec3)>& exact, TruthParams params) {
  params.tolerance = 0.04;
  const Coverage coverage = cover(Edge(), light, points, exact, params, 40);
  ASSERT_EQ(coverage.pixels, 4000);
  EXPECT_NEAR(coverage.held / 4000.0, 0.95, 0.015);
  EXPECT_LT(std::abs(coverage.normal), 4.0);
  const TracedVisibility traced = trace_visibility(Tracer(Edge().scene), Edge().surfels(points), light, {params, 77});
  EXPECT_EQ(traced.precision.pixels, points.size());
  EXPECT_LE(traced.precision.worst_half_width, params.tolerance);
  EXPECT_EQ(traced.precision.pixels_at_limit, 0u);
  double samples = 0.0;
  for (const float n : traced.samples.pixels) samples += n;
  EXPECT_NEAR(samples, static_cast<double>(traced.statistics.rays), 0.5);
  // A pilot of 64, and 2.9957/0.04 at least.
  EXPECT_GT(traced.precision.mean_samples, 64.0 + 75.0);
}

TEST(AreaShadow, With_a_tolerance_intervals_hold_the_known_answer_95_times_in_100) {
  const std::vector<vec3> points = penumbra(1.0 / 3.0, 100);
  expect_stopped_honestly(lamp(RectangleEmitter{1.0, 2.0}), points, [](vec3 p) { return of_rectangle(p.x, 1.0); }, {});
  expect_stopped_honestly(lamp(DiskEmitter{0.5}), points, [](vec3 p) { return of_disk(p.x, 0.5); }, {});
  const auto sphere = [](vec3 p) {
    const SeenCone cone = sphere_from(p, 1.2);
    return of_disk(cone.tan_delta / cone.tan_theta);
  };
  expect_stopped_honestly(lamp(SphereEmitter{1.2}), penumbra(0.75, 100), sphere, {});
  const double half = 10.0 * pi / 180.0;
  Light sun = shapes::directional({0, 1, 0});
  sun.emitter = DistantEmitter{2.0 * half};
  const double radius = edge_height * std::tan(half);
  expect_stopped_honestly(sun, penumbra(radius, 100), [&](vec3 p) { return of_disk(p.x / radius); }, {});
  expect_stopped_honestly(sun, penumbra(radius, 100),
                          [&](vec3 p) {
                            return of_cap({p.x / edge_height, std::tan(half)});
                          },
                          {.light_sampling = LightSampling::solid_angle});
  const TruthParams by_solid{.light_sampling = LightSampling::solid_angle};
  expect_stopped_honestly(
      lamp(RectangleEmitter{6.0, 6.0}), penumbra(2.0, 100), [](vec3 p) { return by_solid_angle(p, 3.0, false); },
      by_solid);
  // Weights that differ by a factor of several.
  expect_stopped_honestly(
      lamp(DiskEmitter{3.0}), penumbra(2.0, 100), [](vec3 p) { return by_solid_angle(p, 3.0, true); }, by_solid);
}

TEST(AreaShadow, The_standard_error_tells_the_scatter_over_seeds) {
  // Root of the mean variance that is told against the true scatter about the known answer.
  const Edge edge;
  const Tracer tracer(edge.scene);
  const std::vector<vec3> points = penumbra(1.0 / 3.0, 200);
  double told = 0.0;
  double found = 0.0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const TracedVisibility traced =
        trace_visibility(tracer, edge.surfels(points), lamp(DiskEmitter{0.5}), {{.spp = 128}, seed});
    for (std::size_t i = 0; i < points.size(); ++i) {
      told += traced.variance[i];
      found += std::pow(static_cast<double>(traced.visibility[i]) - of_disk(points[i].x, 0.5), 2);
    }
  }
  // 4000 estimates of seven degrees of freedom: the ratio of the two is known to √(2/4000 + 2/28000) = 2.4 %.
  EXPECT_NEAR(told / found, 1.0, 0.1);
}

}  // namespace
}  // namespace umbrameter
