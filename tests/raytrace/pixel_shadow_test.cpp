// A straight shadow edge on a plane under a directional light: each pixel's visibility is the share of its area on the
// lit side of a line.
#include "raytrace/pixel_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/quantiles.h"
#include "edge_scene.h"

namespace umbrameter {
namespace {

using namespace edge;

constexpr int side = 48;
constexpr double pixel = 0.1;  // metres

// Looks straight down at the floor from below the half plane; x to the right, and up the image is −z.
View below_the_edge() {
  View view;
  view.width = side;
  view.height = side;
  view.camera.projection = OrthographicProjection{0.5 * side * pixel, 0.5 * side * pixel, 0.0, 10.0};
  view.camera.world_from_camera = {dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 1.5, 0, 1)};
  return view;
}

// A sun whose light travels down, and along −x by `slant` for each metre of height.
Light sun(double slant) {
  const dvec3 back = glm::normalize(dvec3(slant, 1.0, 0.0));
  const dvec3 right = glm::normalize(glm::cross(dvec3(0, 0, 1), back));
  Light light;
  light.shape = DirectionalLight{};
  light.world_from_light = {dvec4(right, 0), dvec4(glm::cross(back, right), 0), dvec4(back, 0), dvec4(0, 0, 0, 1)};
  return light;
}

// Share of a square on one side of a line: the points p with dot(p − center, normal) > offset (Sutherland and Hodgman).
double share_beyond(const dvec2& center, double length, const dvec2& normal, double offset) {
  const dvec2 corners[] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  std::vector<dvec2> kept;
  for (int i = 0; i < 4; ++i) {
    const dvec2 a = center + length * corners[i];
    const dvec2 b = center + length * corners[(i + 1) % 4];
    const double at_a = glm::dot(a, normal) - offset;
    const double at_b = glm::dot(b, normal) - offset;
    if (at_a > 0.0) kept.push_back(a);
    if ((at_a > 0.0) != (at_b > 0.0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const dvec2& a = kept[i];
    const dvec2& b = kept[(i + 1) % kept.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(0.5 * twice) / (length * length);
}

struct Coverage {
  int pixels = 0;  // through which the edge passes
  int held = 0;
  double mean_error = 0.0;
  double standard_error = 0.0;  // of the mean error
};

// The edge of the half plane is turned by `turn` and its shadow is 2 · slant farther along −x.
Coverage cover(double turn, double slant, const TruthParams& params) {
  const Edge edge(turn);
  const Tracer tracer(edge.scene);
  const View view = below_the_edge();
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const dvec2 normal(std::cos(turn), -std::sin(turn));  // of the edge on the floor: x and z
  const double offset = glm::dot(dvec2(-edge_height * slant, 0.0), normal);
  Coverage coverage;
  double variance = 0.0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const TracedVisibility traced = trace_pixel_visibility(tracer, gbuffer, view, sun(slant), {params, seed});
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const dvec2 center = pixel * dvec2(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side);
        const double exact = share_beyond(center, pixel, normal, offset);
        const std::size_t i = gbuffer.instance.index(x, y);
        const double error = static_cast<double>(traced.visibility[i]) - exact;
        if (exact <= 0.0 || exact >= 1.0) {
          EXPECT_NEAR(error, 0.0, 1e-6) << x << " " << y;
          continue;
        }
        ++coverage.pixels;
        const double half_width = student_95(traced.degrees_of_freedom) * static_cast<double>(traced.standard_error[i]);
        coverage.held += std::abs(error) <= half_width ? 1 : 0;
        coverage.mean_error += error;
        variance += traced.variance[i];
      }
    }
  }
  coverage.mean_error /= coverage.pixels;
  coverage.standard_error = std::sqrt(variance) / coverage.pixels;
  return coverage;
}

TEST(PixelShadow, Of_a_straight_edge_is_the_lit_share_of_the_area_within_the_interval) {
  for (const double turn : {0.07, 0.4, 1.0}) {
    for (const double slant : {0.0, 0.6}) {
      const Coverage coverage = cover(turn, slant, {.spp = 256});
      ASSERT_GT(coverage.pixels, 200) << turn;
      EXPECT_GT(static_cast<double>(coverage.held) / coverage.pixels, 0.92) << turn << " " << slant;
      EXPECT_LT(std::abs(coverage.mean_error), 3.0 * coverage.standard_error + 1e-5) << turn << " " << slant;
      EXPECT_LT(coverage.standard_error, 0.002);
    }
  }
}

TEST(PixelShadow, Keeps_its_tolerance) {
  const Coverage coverage = cover(0.4, 0.6, {.tolerance = 0.04});
  EXPECT_GT(static_cast<double>(coverage.held) / coverage.pixels, 0.92);
  EXPECT_LT(std::abs(coverage.mean_error), 3.0 * coverage.standard_error + 1e-5);
}

// The light comes along (−1, −1, 0), so that the floor is lit for x > −2 and what is at y = 1 for x > −1. A dark strip
// at y = 1 covers a third of the pixels from −1.6 to −1.5; their centres see the floor.
TEST(PixelShadow, Leaves_out_other_surfaces_in_the_pixel) {
  Edge edge;
  shapes::add_mesh(edge.scene, shapes::quad({-1.53f, 1.0f, 8.0f}, {0.33f, 0, 0}, {0, 0, -16}));
  const Tracer tracer(edge.scene);
  const View view = below_the_edge();
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const TracedVisibility traced = trace_pixel_visibility(tracer, gbuffer, view, sun(1.0), {{.spp = 64}, 1});
  const auto column = [](double x) { return static_cast<int>(std::floor(x / pixel + 0.5 * side)); };
  for (int y = 4; y < side - 4; ++y) {
    const std::size_t beside = gbuffer.instance.index(column(-1.55), y);
    const std::size_t strip = gbuffer.instance.index(column(-1.35), y);
    EXPECT_EQ(gbuffer.instance[beside], 0u);
    EXPECT_EQ(traced.visibility[beside], 1.0f);
    EXPECT_EQ(gbuffer.instance[strip], 2u);
    EXPECT_EQ(traced.visibility[strip], 0.0f);
  }
}

// Mean over a pixel of a penumbra that is far wider than a pixel: that of the centre, up to its curvature.
TEST(PixelShadow, Of_an_area_light_averages_over_the_light_too) {
  const Edge edge;
  const Tracer tracer(edge.scene);
  const View view = below_the_edge();
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const Light light = lamp(RectangleEmitter{2.0, 0.5});
  const TracedVisibility traced = trace_pixel_visibility(tracer, gbuffer, view, light, {{.spp = 1024}, 1});
  double error = 0.0;
  double variance = 0.0;
  int pixels = 0;
  for (int x = 0; x < side; ++x) {
    const double place = pixel * (x + 0.5 - 0.5 * side);
    if (std::abs(place) > 1.2) continue;  // the penumbra is 4/3 m wide on each side
    for (int y = 0; y < side; ++y) {
      const std::size_t i = gbuffer.instance.index(x, y);
      error += static_cast<double>(traced.visibility[i]) - of_rectangle(place, 2.0);
      variance += traced.variance[i];
      ++pixels;
    }
  }
  EXPECT_LT(std::abs(error / pixels), 3.0 * std::sqrt(variance) / pixels + 1e-3);
  EXPECT_GT(pixels, 900);
}

TEST(PixelShadow, Does_not_depend_on_the_number_of_threads) {
  const Edge edge(0.4);
  const Tracer tracer(edge.scene);
  const View view = below_the_edge();
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const auto trace = [&] { return trace_pixel_visibility(tracer, gbuffer, view, sun(0.3), {{.spp = 32}, 7}); };
  const TracedVisibility all = trace();
  const ThreadLimit one(1);
  EXPECT_EQ(all.visibility.pixels, trace().visibility.pixels);
}

}  // namespace
}  // namespace umbrameter
