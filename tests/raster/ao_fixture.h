// What the tests of the AO methods share: an open plane, a step of known occlusion, and the processor's result.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "test_scenes.h"

namespace umbrameter::testing_scenes {

constexpr double degree = pi / 180.0;

class AoMethodsGl : public GlTest {
 protected:
  struct Seen {
    GBuffer surfels;
    Image<float> ao;
  };
  Seen see(const Scene& scene, const View& view, const AoParams& params) const {
    const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), scene), view);
    return {read_back(context(), surfels), draw_ao(context(), surfels, view, params, 1)};
  }

  // Of the square of 32 pixels about a pixel, background left out.
  static double mean_near(const Seen& seen, int center_x, int center_y) {
    double sum = 0.0;
    double count = 0.0;
    for (int y = center_y - 16; y < center_y + 16; ++y) {
      for (int x = center_x - 16; x < center_x + 16; ++x) {
        const std::size_t i = seen.ao.index(x, y);
        if (seen.surfels.is_surface(i)) sum += static_cast<double>(seen.ao[i]), ++count;
      }
    }
    return sum / count;
  }

  struct OpenPlane {
    double angle;  // between the camera's axis and the plane's normal
    double axis;   // AO at the centre of the image
    double edge;   // AO where a ray leaves the axis by 24 degrees, to the side
  };
  std::vector<OpenPlane> open_plane(AoParams params) const {
    Scene scene;
    add_mesh(scene, ground(1000));
    params.sampling.radius = 0.5;
    params.bias.depth = 0.01;
    std::vector<OpenPlane> all;
    for (const double angle : {10.0, 30.0, 60.0, 85.0}) {
      const dvec3 eye(0, 3 * std::cos(angle * degree), 3 * std::sin(angle * degree));
      const View view = perspective_view(480, 160, eye, {0, 0, 0}, 2 * std::atan(std::tan(25 * degree) * 160 / 480));
      const Seen seen = see(scene, view, params);
      all.push_back({angle, mean_near(seen, 240, 80), mean_near(seen, 464, 80)});
    }
    return all;
  }
  struct Tolerance {
    double angle;
    double darkening;
  };
  void expect_open_plane(const AoParams& params, const std::vector<Tolerance>& allowed, double open = 1.0) const {
    const std::vector<OpenPlane> measured = open_plane(params);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      for (const double ao : {measured[i].axis, measured[i].edge}) {
        EXPECT_NEAR(ao, open, allowed[i].darkening) << allowed[i].angle;
      }
      RecordProperty("axis_" + std::to_string(static_cast<int>(allowed[i].angle)), std::to_string(measured[i].axis));
      RecordProperty("edge_" + std::to_string(static_cast<int>(allowed[i].angle)), std::to_string(measured[i].edge));
    }
  }

  // A step of height 1 seen from above; AO of the lower floor at a distance from the step.
  double beside_step(const AoParams& params, double distance) const {
    Scene scene;
    add_mesh(scene, ground(100));
    add_mesh(scene, box({-50, 0, -50}, {50, 1, 0}));
    const View view = orthographic_view(256, 256, {0, 10, 1}, {0, 0, 1}, 4.0, {0, 0, -1});
    const Seen seen = see(scene, view, params);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < seen.ao.size(); ++i) {
      const vec3& position = seen.surfels.position[i];
      if (std::abs(static_cast<double>(position.z) - distance) > 0.081 || std::abs(position.x) > 0.321f) continue;
      sum += static_cast<double>(seen.ao[i]), ++count;
    }
    EXPECT_GT(count, 100.0);
    return sum / count;
  }

  // The processor runs the same text on the depths that were read back. One pixel in `one_in` may differ.
  template <class Method, class Settings>
  void expect_as_on_cpu(const AoParams& params, Method method, const Settings& settings, int one_in = 200) const {
    Scene scene;
    add_mesh(scene, ground(20));
    add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
    add_mesh(scene, box({-0.2f, 1, -0.2f}, {0.1f, 2, 0.1f}));
    for (const View& view :
         {perspective_view(48, 32, {2, 3, 4}, {0, 0.5, 0}), orthographic_view(48, 32, {2, 3, 4}, {0, 0.5, 0}, 2.0)}) {
      const Seen seen = see(scene, view, params);
      method.clip_from_view = mat4(clip_from_view(view));
      method.size = {view.width, view.height};
      method.is_orthographic = std::holds_alternative<OrthographicProjection>(view.camera.projection) ? 1 : 0;
      method.depth = seen.surfels.depth;
      for (std::size_t i = 0; i < seen.ao.size(); ++i) {
        if (!seen.surfels.is_surface(i)) method.depth[i] = std::numeric_limits<float>::infinity();
      }
      const dmat4 view_from_world = umbrameter::view_from_world(view);
      const std::vector<vec4> noise = stratified_tile(params.noise, 1);
      int differing = 0;
      double total = 0.0;
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          const std::size_t i = seen.ao.index(x, y);
          float expected = 1.0f;
          if (seen.surfels.is_surface(i)) {
            typename Method::AoSurfel surfel;
            surfel.pixel = {x, view.height - 1 - y};
            surfel.position = vec3(view_from_world * dvec4(dvec3(seen.surfels.position[i]), 1.0));
            surfel.normal = glm::normalize(vec3(dmat3(view_from_world) * dvec3(seen.surfels.geometric_normal[i])));
            const auto size = static_cast<std::size_t>(params.noise.size);
            surfel.noise = vec2(noise[static_cast<std::size_t>(y) % size * size + static_cast<std::size_t>(x) % size]);
            expected = std::min(1.0f, method.accessibility(surfel, settings));
          }
          total += static_cast<double>(1.0f - expected);
          differing += std::abs(seen.ao[i] - expected) > 2e-3f ? 1 : 0;
        }
      }
      EXPECT_GT(total, 20.0) << "nothing is occluded";
      // Where a sample lies on a pixel's border, rounding selects one pixel or the other.
      EXPECT_LE(differing, view.width * view.height / one_in);
    }
  }
};

inline AoParams method(AoTechniques::Choice name) {
  AoParams params;
  params.technique = name;
  params.sampling.radius = 0.5;
  params.bias.depth = 0.01;
  params.blur.kind = AoBlur::none;
  return params;
}

// The mean of f(distance, azimuth) over even distances from 0 to `radius` and even azimuths.
template <class F>
double mean_over_disk(double radius, const F& f) {
  double sum = 0.0;
  constexpr int parts = 1000;
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j < parts; ++j) sum += f(radius * (i + 0.5) / parts, 2.0 * pi * (j + 0.5) / parts);
  }
  return sum / (parts * parts);
}

}  // namespace umbrameter::testing_scenes
