// The AO methods: an open plane, a wall of known occlusion, and the shader against the processor.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

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

  // The processor runs the same text on the depths that were read back.
  template <class Method, class Settings>
  void expect_as_on_cpu(const AoParams& params, Method method, const Settings& settings) const {
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
      EXPECT_LE(differing, view.width * view.height / 200);
    }
  }
};

AoParams method(AoTechniqueName name) {
  AoParams params;
  params.technique = name;
  params.sampling.radius = 0.5;
  params.bias.depth = 0.01;
  params.blur.kind = AoBlur::none;
  return params;
}

TEST_F(AoMethodsGl, An_open_plane_is_open_for_GTAO_but_at_grazing_angles) {
  AoParams params = method(AoTechniqueName::gtao);
  params.blur.kind = AoBlur::box;
  // At 60 and 85 degrees a sample's pixel lies beside the slice, and the plane is higher there than in the slice.
  for (const auto spacing : {AoSliceSpacing::angle, AoSliceSpacing::image}) {
    params.slices.spacing = spacing;
    // Even in the image, slices are not even about the direction to the viewer at the edge.
    const double at_edge = spacing == AoSliceSpacing::image ? 0.01 : 0.005;
    expect_open_plane(params, {{10, at_edge}, {30, 0.005}, {60, 0.02}, {85, 0.06}});
  }
}

TEST_F(AoMethodsGl, GTAO_meets_the_closed_form_beside_a_step) {
  AoParams params = method(AoTechniqueName::gtao);
  params.sampling.radius = 4.0;
  params.gtao = {1.0, 1e-3, 2.0, 0.0, 1.0};
  params.slices.slices = 8;
  params.slices.steps = 48;
  // ½(1 − d/√(d² + h²)), weighted by the cosine.
  EXPECT_NEAR(beside_step(params, 1.0), 0.853553, 0.01);
  EXPECT_NEAR(beside_step(params, 0.25), 0.621268, 0.01);
}

TEST_F(AoMethodsGl, GTAO_is_that_of_the_processor) {
  AoParams params = method(AoTechniqueName::gtao);
  params.gtao.thin_compensation = 0.7;
  for (const auto spacing : {AoSliceSpacing::angle, AoSliceSpacing::image}) {
    params.slices.spacing = spacing;
    expect_as_on_cpu(params, shared::GtaoMethod{}, settings_of(std::get<Gtao>(make_technique(params))));
  }
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

TEST_F(AoMethodsGl, An_open_plane_is_open_for_HBAO_and_Alchemy_AO_and_half_open_for_full_sphere_SSAO) {
  AoParams params = method(AoTechniqueName::hbao);
  params.blur.kind = AoBlur::box;
  expect_open_plane(params, {{10, 0.005}, {30, 0.005}, {60, 0.015}, {85, 0.05}});
  params.technique = AoTechniqueName::alchemy;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    expect_open_plane(params, {{10, 1e-3}, {30, 1e-3}, {60, 1e-3}, {85, 1e-3}});
  }
  params.technique = AoTechniqueName::crytek;
  params.bias.depth = 0.0;
  // Near the horizon, half of the points lie before the background.
  expect_open_plane(params, {{10, 0.03}, {30, 0.03}, {60, 0.05}, {85, 0.5}}, 0.5);
}

TEST_F(AoMethodsGl, HBAO_meets_its_integral_beside_a_step) {
  AoParams params = method(AoTechniqueName::hbao);
  params.sampling.radius = 3.0;
  params.hbao = {16, 96, 0.0, 1.0, true};
  for (const double distance : {0.5, 1.0}) {
    // The sine of the step's edge in each direction, times 1 - (r/R)².
    const double occlusion = mean_over_disk(1.0, [&](double, double azimuth) {
      if (std::cos(azimuth) <= 0.0) return 0.0;
      const double square = 1.0 + std::pow(distance / std::cos(azimuth), 2);
      return std::max(0.0, 1.0 - square / 9.0) / std::sqrt(square);
    });
    EXPECT_NEAR(beside_step(params, distance), 1.0 - occlusion, 0.015);
  }
}

TEST_F(AoMethodsGl, Alchemy_AO_meets_its_integral_beside_a_step) {
  AoParams params = method(AoTechniqueName::alchemy);
  params.sampling.radius = 2.0;
  params.sampling.samples = 512;
  params.alchemy.turns = 89;
  params.alchemy.bias = 0.0;
  params.alchemy.intensity = 0.5;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    for (const double distance : {0.5, 1.0}) {
      const double occlusion = mean_over_disk(2.0, [&](double across, double azimuth) {
        const double square = across * across + 1.0;
        if (across * std::cos(azimuth) <= distance || square >= 4.0) return 0.0;
        // The height is 1 and the radius is 2.
        return estimator == AlchemyEstimator::sao ? 5.0 * 2.0 * std::pow(1.0 - square / 4.0, 3) / square
                                                  : 2.0 * 2.0 / square;
      });
      EXPECT_NEAR(beside_step(params, distance), 1.0 - 0.5 * occlusion, 0.015);
    }
  }
}

TEST_F(AoMethodsGl, Full_sphere_SSAO_is_the_share_of_the_ball_above_the_step) {
  AoParams params = method(AoTechniqueName::crytek);
  params.sampling.radius = 2.0;
  params.sampling.samples = 512;
  params.bias.depth = 0.0;
  params.ssao.range_check = false;
  for (const double distance : {0.5, 1.0}) {
    // In the half-ball above the floor: the discs of the ball at the height y, cut at the step.
    double hidden = 0.0;
    constexpr int parts = 10000;
    for (int i = 0; i < parts; ++i) {
      const double y = (i + 0.5) / parts;  // up to the height 1
      const double r = std::sqrt(4.0 - y * y);
      if (r > distance) hidden += r * r * std::acos(distance / r) - distance * std::sqrt(r * r - distance * distance);
    }
    EXPECT_NEAR(beside_step(params, distance), 0.5 - hidden / parts / (4.0 / 3.0 * pi * 8.0), 0.015);
  }
}

TEST_F(AoMethodsGl, HBAO_Alchemy_AO_and_full_sphere_SSAO_are_those_of_the_processor) {
  AoParams params = method(AoTechniqueName::hbao);
  expect_as_on_cpu(params, shared::HbaoMethod{}, settings_of(std::get<Hbao>(make_technique(params))));
  params.technique = AoTechniqueName::alchemy;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    expect_as_on_cpu(params, shared::AlchemyMethod{}, settings_of(std::get<Alchemy>(make_technique(params))));
  }
  params.technique = AoTechniqueName::crytek;
  expect_as_on_cpu(params, shared::CrytekMethod{}, settings_of(std::get<Crytek>(make_technique(params))));
}

}  // namespace
}  // namespace umbrameter
