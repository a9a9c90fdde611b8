// What visibility of a light with extent means where no formula is needed: limits, horizons, what blocks.
#include "raytrace/area_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/quantiles.h"
#include "core/random.h"
#include "edge_scene.h"
#include "raytrace/spherical_rectangle.h"
#include "raytrace/tracer.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

using namespace edge;

TEST(AreaShadow, A_light_shrunk_to_nothing_is_hard) {
  Edge edge;
  shapes::add_mesh(edge.scene, shapes::sphere({1, 1, 0.5}, 0.5f, 16, 24));
  const Tracer tracer(edge.scene);
  std::vector<vec3> points;
  for (int i = 0; i < 900; ++i) {
    points.emplace_back(static_cast<float>(i % 30) / 6.0f - 2.4567f, 0.0f, static_cast<float>(i / 30) / 6.0f - 2.4f);
  }
  const GBuffer gbuffer = edge.surfels(points);
  Light bulb = lamp({});
  Light sun = shapes::directional({0.3, 1, 0.2});
  const Image<float> hard_bulb = trace_visibility(tracer, gbuffer, bulb).visibility;
  const Image<float> hard_sun = trace_visibility(tracer, gbuffer, sun).visibility;
  double lit = 0.0;
  for (const float v : hard_bulb.pixels) lit += v;
  EXPECT_GT(lit, 300.0);
  EXPECT_LT(lit, 600.0);
  for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle}) {
    const TruthSampling sampled{{.spp = 16, .light_sampling = sampling}, 3};
    for (const Emitter& tiny :
         {Emitter(SphereEmitter{1e-9}), Emitter(DiskEmitter{1e-9}), Emitter(RectangleEmitter{1e-9, 1e-9})}) {
      bulb.emitter = tiny;
      const TracedVisibility traced = trace_visibility(tracer, gbuffer, bulb, sampled);
      EXPECT_EQ(traced.visibility, hard_bulb);
      EXPECT_EQ(traced.variance, Image<float>(900, 1, 0.0f));
    }
    sun.emitter = DistantEmitter{1e-9};
    EXPECT_EQ(trace_visibility(tracer, gbuffer, sun, sampled).visibility, hard_sun);
  }
}

TEST(AreaShadow, A_hard_light_has_no_standard_error) {
  const Edge edge;
  const TracedVisibility traced = trace_visibility(Tracer(edge.scene), edge.surfels({{1, 0, 0}}), lamp({}));
  EXPECT_TRUE(traced.standard_error.empty());
}

// A floor alone and a light that faces along −x towards a surfel in the middle, its own middle `height` above the
// floor.
TracedVisibility on_open_floor(Light light, const Emitter& emitter, double height) {
  Scene scene = shapes::empty_scene();
  const std::uint32_t floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  light.emitter = emitter;
  light.world_from_light[3] = dvec4(3, height, 0, 1);
  const GBuffer gbuffer = shapes::surfels({{0, 0, 0}}, {0, 1, 0}, floor, [](vec3) { return 1u; });
  return trace_visibility(Tracer(scene), gbuffer, light, {{.spp = 4096}, 1});
}

TracedVisibility on_open_floor(const Emitter& emitter, double height) {
  Light light = shapes::directional({1, 0, 0});
  light.shape = PointLight{};
  return on_open_floor(light, emitter, height);
}

// Student's t with fifteen degrees of freedom is below 4.07 in 99.9 % of the cases.
void expect_share(const TracedVisibility& traced, double share) {
  EXPECT_GT(traced.standard_error[0], 0.0f);
  EXPECT_EQ(traced.degrees_of_freedom, 15);
  EXPECT_LT(traced.standard_error[0], 0.01f);
  EXPECT_NEAR(traced.visibility[0], share, 4.07 * static_cast<double>(traced.standard_error[0]));
}

TEST(AreaShadow, What_is_below_the_horizon_is_hidden_by_the_surface_itself) {
  // The light's own y, along which its height lies, is the world's.
  expect_share(on_open_floor(RectangleEmitter{1.0, 2.0}, 0.0), 0.5);
  expect_share(on_open_floor(RectangleEmitter{1.0, 2.0}, 0.5), 0.75);
  expect_share(on_open_floor(DiskEmitter{1.0}, 0.5), of_disk(0.5));
  expect_share(on_open_floor(SphereEmitter{1.0}, 0.0), 0.5);
  for (const Emitter& emitter : {Emitter(RectangleEmitter{1.0, 2.0}), Emitter(DiskEmitter{1.0})}) {
    EXPECT_EQ(on_open_floor(emitter, 1.001).visibility[0], 1.0f);
    EXPECT_EQ(on_open_floor(emitter, -1.001).visibility[0], 0.0f);
    EXPECT_EQ(on_open_floor(emitter, -1.001).statistics.rays, 0u);
  }
  EXPECT_EQ(on_open_floor(SphereEmitter{1.0}, 1.001).visibility[0], 1.0f);
  EXPECT_EQ(on_open_floor(SphereEmitter{1.0}, -1.001).visibility[0], 0.0f);
  // A sun 5 degrees below the horizon, 20 across: what is above is a segment of its disk, at −tan 5° of tan 10°.
  const double below = std::tan(5.0 * pi / 180.0);
  const DistantEmitter sun{20.0 * pi / 180.0};
  expect_share(on_open_floor(shapes::directional({1, -below, 0}), sun, 0.0),
               of_disk(-below / std::tan(10.0 * pi / 180.0)));
}

TEST(AreaShadow, Visibility_is_geometry_however_the_light_is_turned) {
  // From behind and beyond its cone a flat light is seen as well; that it does not shine there is another quantity.
  const Edge edge;
  Light light = lamp(DiskEmitter{0.5});
  light.world_from_light = {dvec4(1, 0, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, -1, 0, 0), dvec4(0, light_height, 0, 1)};
  ASSERT_GT(light.axis().y, 0.99);
  const TracedVisibility traced = trace_visibility(Tracer(edge.scene), edge.surfels({{3, 0, 0}, {-3, 0, 0}}), light);
  EXPECT_EQ(traced.visibility[0], 1.0f);
  EXPECT_EQ(traced.visibility[1], 0.0f);
}

TEST(AreaShadow, A_surfel_within_a_sphere_light_sees_it_and_background_is_lit) {
  EXPECT_EQ(on_open_floor(SphereEmitter{4.0}, 0.0).visibility[0], 1.0f);
  const Edge edge;
  GBuffer gbuffer = edge.surfels({{1, 0, 0}, {-1, 0, 0}});
  gbuffer.instance[1] = no_id;
  const TracedVisibility traced = trace_visibility(Tracer(edge.scene), gbuffer, lamp(DiskEmitter{0.1}));
  EXPECT_EQ(traced.visibility[1], 1.0f);
  EXPECT_EQ(traced.standard_error[1], 0.0f);
}

TEST(AreaShadow, What_is_behind_the_light_or_inside_of_a_sphere_does_not_block) {
  Edge edge;
  shapes::add_mesh(edge.scene, shapes::quad({-0.2f, 5.01f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}));
  shapes::add_mesh(edge.scene, shapes::box({-0.1f, 4.9f, -0.1f}, {0.1f, 5.005f, 0.1f}));
  const Tracer tracer(edge.scene);
  const GBuffer gbuffer = edge.surfels({{2, 0, 0}});
  EXPECT_EQ(trace_visibility(tracer, gbuffer, lamp(SphereEmitter{0.5})).visibility[0], 1.0f);
  const float disk = trace_visibility(tracer, gbuffer, lamp(DiskEmitter{0.5})).visibility[0];
  EXPECT_LT(disk, 1.0f);
  EXPECT_GT(disk, 0.8f);
}

TEST(AreaShadow, One_randomisation_claims_nothing_and_any_number_of_points_will_do) {
  const Edge edge;
  const Tracer tracer(edge.scene);
  const GBuffer gbuffer = edge.surfels({{0.1f, 0, 0}});
  const Light light = lamp(DiskEmitter{0.5});
  EXPECT_EQ(trace_visibility(tracer, gbuffer, light, {{.spp = 1}, 1}).variance[0], 0.25f);
  for (const int spp : {2, 7, 33, 1001}) {
    const TracedVisibility traced = trace_visibility(tracer, gbuffer, light, {{.spp = spp}, 1});
    EXPECT_NEAR(traced.visibility[0], of_disk(0.1, 0.5), 2.0 / std::sqrt(spp));
    EXPECT_EQ(traced.statistics.rays, static_cast<std::uint64_t>(spp));
  }
}

TEST(AreaShadow, Is_bit_identical_at_any_number_of_threads_and_differs_between_seeds) {
  const Edge edge(0.3);
  const Tracer tracer(edge.scene);
  GBuffer gbuffer(67, 45);
  for (int y = 0; y < gbuffer.height; ++y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const std::size_t i = gbuffer.instance.index(x, y);
      const vec3 p(0.02f * static_cast<float>(x - 33), 0.0f, 0.02f * static_cast<float>(y - 22));
      gbuffer.instance[i] = edge.floor;
      gbuffer.triangle[i] = p.x > -p.z ? 0u : 1u;
      gbuffer.position[i] = p;
      gbuffer.geometric_normal[i] = {0, 1, 0};
    }
  }
  std::vector<TracedVisibility> traced;
  for (const double tolerance : {0.1, 0.0}) {
    traced.clear();
    for (const int threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      const TruthSampling sampling{{.spp = 32, .tolerance = tolerance}, 9};
      traced.push_back(trace_visibility(tracer, gbuffer, lamp(SphereEmitter{0.5}), sampling));
    }
    for (const TracedVisibility& t : traced) {
      EXPECT_EQ(t.visibility, traced[0].visibility);
      EXPECT_EQ(t.standard_error, traced[0].standard_error);
      EXPECT_EQ(t.variance, traced[0].variance);
      EXPECT_EQ(t.samples, traced[0].samples);
      EXPECT_EQ(t.statistics.rays, traced[0].statistics.rays);
      EXPECT_EQ(t.precision.mean_half_width, traced[0].precision.mean_half_width);
    }
  }
  EXPECT_NE(trace_visibility(tracer, gbuffer, lamp(SphereEmitter{0.5}), {{.spp = 32}, 8}).visibility,
            traced[0].visibility);
}

TEST(AreaShadow, Pixels_that_stop_on_their_own_do_not_depend_on_their_neighbours_and_heed_the_limits) {
  const Edge edge;
  const Tracer tracer(edge.scene);
  std::vector<vec3> points;
  for (int i = 0; i < 300; ++i) points.emplace_back(0.004f * static_cast<float>(i - 150), 0.0f, 0.1f);
  const TruthParams params{.tolerance = 0.02, .min_spp = 300, .max_spp = 900};
  GBuffer gbuffer = edge.surfels(points);
  const TracedVisibility all = trace_visibility(tracer, gbuffer, lamp(DiskEmitter{0.5}), {params, 5});
  std::uint64_t above = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_GE(all.samples[i], 300.0f);
    EXPECT_LE(all.samples[i], 900.0f);
    if (student_95(all.degrees_of_freedom) * static_cast<double>(all.standard_error[i]) <= params.tolerance) continue;
    ++above;
    EXPECT_GT(all.samples[i], 900.0f - 16.0f) << "it stopped early, above the tolerance";
  }
  EXPECT_EQ(above, all.precision.pixels_at_limit);
  EXPECT_GT(above, 0u);
  for (std::size_t i = 0; i < 300; i += 2) gbuffer.instance[i] = gbuffer.triangle[i] = no_id;
  const TracedVisibility fewer = trace_visibility(tracer, gbuffer, lamp(DiskEmitter{0.5}), {params, 5});
  for (std::size_t i = 1; i < 300; i += 2) {
    EXPECT_EQ(fewer.visibility[i], all.visibility[i]);
    EXPECT_EQ(fewer.samples[i], all.samples[i]);
  }
}

TEST(LightView, A_surface_that_faces_no_part_of_a_light_is_known_without_rays) {
  int turned = 0;
  int missed = 0;  // it faces a part that is too small for the points
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const auto random = [k](std::uint32_t what) {
      return 2.0 * static_cast<double>(to_unit_float(hash(k, what))) - 1.0;
    };
    Light light = shapes::directional({random(0), random(1), random(2)});
    const std::vector<Emitter> emitters = {SphereEmitter{0.7}, DiskEmitter{0.8}, RectangleEmitter{1.0, 0.5}};
    light.shape = PointLight{};
    light.emitter = emitters[k % 3];
    if (k % 4 == 3) {
      light.shape = DirectionalLight{};
      light.emitter = DistantEmitter{0.5 + random(7) * 0.4};
    }
    const dvec3 from = 2.0 * dvec3(random(3), random(4), random(5));
    const dvec3 normal = glm::normalize(dvec3(random(6), random(8), random(9)));
    for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle}) {
      const LightView view(light, sampling, from);
      if (view.is_inside()) continue;
      double most = -1.0;
      for (int i = 0; i < 400; ++i) {
        const LightView::Sample sample =
            view.sample({(static_cast<float>(i % 20) + 0.5f) / 20.0f, (static_cast<float>(i / 20) + 0.5f) / 20.0f});
        EXPECT_NEAR(glm::length(sample.direction), 1.0, 1e-12);
        EXPECT_GT(sample.reach, 0.0);
        most = std::max(most, glm::dot(normal, sample.direction));
      }
      if (!faces(light, from, normal)) {
        ++turned;
        EXPECT_LE(most, 1e-12);
      } else if (most <= 0.0) {
        ++missed;
      }
    }
  }
  EXPECT_GT(turned, 500);
  EXPECT_LT(missed, 4000 / 100);
}

// Half sides a and b, straight up at distance d: Ω = 4 atan(ab / (d √(a² + b² + d²))).
TEST(SphericalRectangle, Knows_its_solid_angle) {
  for (const double distance : {1e-3, 0.5, 2.0, 700.0}) {
    for (const double side : {0.3, 2.0}) {
      const double away = std::sqrt(side * side + 1.0 + distance * distance);
      const double closed = 4.0 * std::atan(side / (distance * away));
      const SphericalRectangle rectangle({0, distance, 0}, {0, 0, side}, {1, 0, 0});
      EXPECT_NEAR(rectangle.solid_angle(), closed, 1e-14) << distance << ", " << side;
    }
  }
  const SphericalRectangle edge_on({3, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_EQ(edge_on.solid_angle(), 0.0);
  EXPECT_EQ(edge_on.error(), std::numeric_limits<double>::infinity());
}

TEST(SphericalRectangle, Its_points_are_even_over_the_solid_angle) {
  // A large light near by, off to one side, from the front, from behind and nearly edge on.
  for (const dvec3 middle : {dvec3(1.5, 0.4, 0.3), dvec3(1.5, -0.4, 0.3), dvec3(3, 2e-3, -1), dvec3(0, 5, 0)}) {
    const SphericalRectangle rectangle(middle, {2, 0, 0}, {0, 0, 1});
    const double all = rectangle.solid_angle();
    // The part up to a point's x has the share of the solid angle that the point's first coordinate says.
    for (const double share : {0.01, 0.3, 0.5, 0.9}) {
      const double x = rectangle.sample({share, 0.7}).x;
      const double half = 0.5 * (x - (middle.x - 2.0));
      const SphericalRectangle part({x - half, middle.y, middle.z}, {half, 0, 0}, {0, 0, 1});
      EXPECT_NEAR(part.solid_angle() / all, share, rectangle.error() + part.error()) << middle.x << ", " << middle.y;
    }
    // Any part has its share of points.
    constexpr int steps = 400;
    int within = 0;
    for (int i = 0; i < steps; ++i) {
      for (int k = 0; k < steps; ++k) {
        const dvec3 p = rectangle.sample({(i + 0.5) / steps, (k + 0.5) / steps});
        EXPECT_NEAR(p.y, middle.y, 1e-12);
        ASSERT_LE(std::abs(p.x - middle.x), 2.0 + 1e-12);
        ASSERT_LE(std::abs(p.z - middle.z), 1.0 + 1e-12);
        within += std::abs(p.x - middle.x) < 0.8 && p.z < middle.z + 0.2 ? 1 : 0;
      }
    }
    const SphericalRectangle part(middle - dvec3(0, 0, 0.4), {0.8, 0, 0}, {0, 0, 0.6});
    EXPECT_NEAR(within / static_cast<double>(steps * steps), part.solid_angle() / all, 3.0 / steps);
  }
}

TEST(LightView, Slanting_keeps_points_even_over_the_square) {
  constexpr int side = 256;
  int in_box = 0;
  for (int i = 0; i < side * side; ++i) {
    const vec2 point((static_cast<float>(i % side) + 0.5f) / side, (static_cast<float>(i / side) + 0.5f) / side);
    const vec2 moved = shear(point, {0.7f, 1.3f});
    ASSERT_TRUE(moved.x >= 0.0f && moved.x < 1.0f && moved.y >= 0.0f && moved.y < 1.0f);
    in_box += moved.x < 0.3f && moved.y > 0.6f ? 1 : 0;
  }
  constexpr double n = side * side;
  EXPECT_NEAR(in_box / n, 0.3 * 0.4, 2.0 / side);
}

}  // namespace
}  // namespace umbrameter
