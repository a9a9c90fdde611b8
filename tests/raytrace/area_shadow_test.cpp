// Soft shadows of a half-plane edge. Light at height H, edge at height h, receiver x from the edge's foot towards the
// open side; V is the visible share of the light.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/parallel.h"
#include "raytrace/area_light.h"
#include "raytrace/tracer.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// Eight randomisations: Student's t with seven degrees of freedom is below 2.365 in 95 % of the cases.
constexpr double student_95 = 2.365;
constexpr double edge_height = 2.0;
constexpr double light_height = 5.0;

// A floor at y = 0 and a half plane x < 0 at y = 2, so far reaching that no line from the floor to a light passes it.
struct Edge {
  Scene scene = shapes::empty_scene();
  std::uint32_t floor = 0;
  explicit Edge(double turn = 0.0) {
    dmat4 turned(1.0);
    turned[0] = dvec4(std::cos(turn), 0, -std::sin(turn), 0);
    turned[2] = dvec4(std::sin(turn), 0, std::cos(turn), 0);
    floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
    shapes::add_mesh(scene, shapes::quad({-400, edge_height, 400}, {400, 0, 0}, {0, 0, -800}), turned);
  }
  GBuffer surfels(const std::vector<vec3>& points) const {
    return shapes::surfels(points, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
  }
};

// Shines straight down from above the edge, turned about the vertical.
Light lamp(Emitter emitter, double turn = 0.0) {
  Light light;
  light.name = "lamp";
  light.shape = SpotLight{};
  light.world_from_light = {dvec4(std::cos(turn), 0, -std::sin(turn), 0), dvec4(std::sin(turn), 0, std::cos(turn), 0),
                            dvec4(0, 1, 0, 0), dvec4(0, light_height, 0, 1)};
  light.world_from_light[1] = dvec4(glm::cross(dvec3(0, 1, 0), dvec3(light.world_from_light[0])), 0);
  light.emitter = emitter;
  return light;
}

// TRUTH: V = clamp(½ + x(H − h)/(hW), 0, 1).
double of_rectangle(double x, double width) {
  return std::clamp(0.5 + x * (light_height - edge_height) / (edge_height * width), 0.0, 1.0);
}

// u = clamp(x(H − h)/(hr), −1, 1), V = ½ + (u√(1 − u²) + asin u)/π: the part of a disk on one side of a line.
double of_disk(double u) {
  u = std::clamp(u, -1.0, 1.0);
  return 0.5 + (u * std::sqrt(1.0 - u * u) + std::asin(u)) / pi;
}
double of_disk(double x, double radius) { return of_disk(x * (light_height - edge_height) / (edge_height * radius)); }

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
  Coverage coverage;
  double difference = 0.0;
  double variance = 0.0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const TracedVisibility traced = trace_visibility(tracer, gbuffer, light, {params, seed});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = static_cast<double>(traced.visibility[i]) - exact(points[i]);
      const double s = traced.standard_error[i];
      ++coverage.pixels;
      // Float rounding of an estimate that is exact.
      coverage.held += std::abs(error) <= student_95 * s + 1e-6 ? 1 : 0;
      difference += error;
      variance += s * s;
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

// Binomial(n, .95) has a standard deviation of √(.0475 n): four of them, and one per cent for the t of lumpy means.
void expect_honest(const Coverage& coverage) {
  const double n = coverage.pixels;
  const double share = coverage.held / n;
  EXPECT_NEAR(share, 0.95, 0.01 + 4.0 * std::sqrt(0.0475 / n));
  // Independent estimates: the normal distribution exceeds 4 once in 16000.
  EXPECT_LT(std::abs(coverage.normal), 4.0);
  std::printf("coverage %.4f, mean off by %.2f standard errors\n", share, coverage.normal);
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

}  // namespace
}  // namespace umbrameter
