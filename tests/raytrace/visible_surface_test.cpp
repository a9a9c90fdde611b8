// What a depth buffer knows of the built-in scenes, against the full geometry where everything that matters is in view.
#include "raytrace/visible_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "raytrace/ao_integral.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

constexpr auto occluders_in_view = static_cast<std::size_t>(Occluders::in_view);
constexpr auto occluders_seen = static_cast<std::size_t>(Occluders::seen);
constexpr auto occluders_solid = static_cast<std::size_t>(Occluders::solid);

AoIntegral plain(double reach) {
  return {AoDirections::cosine, reach, [](const AoHit&) { return 1.0; }, [](double a) { return a; }, {}};
}

// Pixels from which nothing within the reach is hidden: no surface before another one is as near as that in the image.
std::vector<char> far_from_depth_edges(const GBuffer& gbuffer, const VisibleSurface& surface, double pixels_per_reach) {
  const int width = gbuffer.width;
  const int height = gbuffer.height;
  std::vector<char> is_far(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1);
  const auto exclude = [&](int x, int y) {
    const int far = static_cast<int>(std::ceil(pixels_per_reach)) + 1;
    for (int j = std::max(y - far, 0); j <= std::min(y + far, height - 1); ++j) {
      for (int i = std::max(x - far, 0); i <= std::min(x + far, width - 1); ++i) {
        is_far[gbuffer.instance.index(i, j)] = 0;
      }
    }
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = gbuffer.instance.index(x, y);
      if (!gbuffer.is_surface(at)) is_far[at] = 0;
      const auto check = [&](std::size_t next) {
        if (gbuffer.is_surface(at) && gbuffer.is_surface(next) && !surface.is_joined(at, next)) exclude(x, y);
      };
      if (x + 1 < width) check(gbuffer.instance.index(x + 1, y));
      if (y + 1 < height) check(gbuffer.instance.index(x, y + 1));
    }
  }
  return is_far;
}

struct Difference {
  double mean = 0.0;        // accessibility on the surface less that on all occluders in view
  double half_width = 0.0;  // of the 95 % interval
  double pixels = 0.0;
};
Difference difference(const TracedIntegral& traced, std::size_t occluders, const std::vector<char>& is_counted) {
  Difference difference;
  double variance = 0.0;
  for (std::size_t i = 0; i < is_counted.size(); ++i) {
    if (is_counted[i] == 0) continue;
    difference.mean += traced.accessibility[occluders][i] - traced.accessibility[occluders_in_view][i];
    variance += traced.step_variance[occluders_seen][i];
    ++difference.pixels;
  }
  difference.mean /= difference.pixels;
  difference.half_width = 1.96 * std::sqrt(variance) / difference.pixels;
  return difference;
}

TEST(VisibleSurface, Away_from_depth_edges_corner_is_what_it_is_on_the_full_geometry) {
  // Its walls' tops are one pixel high here: facets of which nearly all border on two creases.
  const Scene scene = load_scene("corner");
  const Camera& camera = scene.cameras[0];
  const Tracer tracer(scene);
  constexpr double reach = 0.138;  // the default
  for (const int width : {160, 240, 331}) {
    const View view{width, width * 9 / 16, camera};
    const GBuffer gbuffer = trace_gbuffer(tracer, view);
    const TracedIntegral traced = trace_integral(tracer, gbuffer, view, plain(reach), {16, 1});
    const double focal =
        0.5 * view.height / std::tan(0.5 * std::get<PerspectiveProjection>(camera.projection).vertical_fov);
    constexpr double nearest = 5.0;  // metres from camera to scene, or more
    const std::vector<char> is_far =
        far_from_depth_edges(gbuffer, VisibleSurface(gbuffer, view), reach * focal / nearest);
    for (const std::size_t occluders : {occluders_seen, occluders_solid}) {
      const Difference d = difference(traced, occluders, is_far);
      EXPECT_GT(d.pixels, 0.7 * width * view.height * 0.66);
      // One ray of 16 in one pixel may pass a crease by less than the rounding of positions.
      EXPECT_NEAR(d.mean, 0.0, d.half_width + 1.0 / 16.0 / d.pixels) << width;
      EXPECT_LT(d.half_width, 1e-4) << width;
    }
  }
}

TEST(VisibleSurface, Seen_from_above_the_slots_of_trench_are_solid_but_for_the_place_of_their_edges_in_a_pixel) {
  // Walls are occluders_seen edge-on: where within a pixel they are is unknown. The error has either sign and is 0 on
  // average over cameras that differ by parts of a pixel.
  const Scene scene = load_scene("trench");
  const Tracer tracer(scene);
  constexpr int cameras = 8;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < cameras; ++i) {
    View view{320, 36, scene.cameras[2]};
    auto& lens = std::get<OrthographicProjection>(view.camera.projection);
    const double pixel = 2.0 * lens.half_width / view.width;
    lens.half_height = 0.5 * pixel * view.height;
    view.camera.world_from_camera[3].x += pixel * (i + 0.5) / cameras;
    const GBuffer gbuffer = trace_gbuffer(tracer, view);
    const TracedIntegral traced = trace_integral(tracer, gbuffer, view, plain(0.33), {8, 1});
    const Difference d = difference(traced, occluders_solid, std::vector<char>(gbuffer.position.size(), 1));
    sum += d.mean / cameras;
    squares += d.mean * d.mean / cameras;
    EXPECT_GT(difference(traced, occluders_seen, std::vector<char>(gbuffer.position.size(), 1)).mean, 0.1)
        << "without thickness";
  }
  const double scatter = std::sqrt(squares - sum * sum);
  EXPECT_LT(scatter, 2e-3);
  EXPECT_NEAR(sum, 0.0, 2.0 * scatter / std::sqrt(cameras - 1.0));
}

}  // namespace
}  // namespace umbrameter
