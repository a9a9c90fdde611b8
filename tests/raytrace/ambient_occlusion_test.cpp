// Answers known from mathematics. O = 1 − AO; sources: Howell, A Catalog of Radiation Heat Transfer Configuration
// Factors; Lambert's polygon formula. Means over the receiver's points must meet them within the traced interval.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "raytrace/tracer.h"
#include "tests/support/polygons.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// Standard errors of a mean that it may be off by: more happens once in two million tests.
constexpr double sigmas = 5.0;
// What the meshes differ from their ideals by, at most. Walls of 200 m instead of endless ones: 10⁻⁵. Up to three
// planes of 20 m seen from 1 mm: 3 · 10⁻³/20. Inscribed spheres of 400 × 200 facets: (2π/400)²/6 + (π/200)²/6
// = 8.2·10⁻⁵ of their area; disks of 720 corners less. Tabulated answers: six digits.
constexpr double geometry = 1.5e-4;
constexpr float floor_half = 8.0f;

// A floor of 16 × 16 m at y = 0, and surfels on it.
struct Floor {
  Scene scene = shapes::empty_scene();
  std::uint32_t floor = 0;
  Floor() {
    floor = shapes::add_mesh(
        scene, shapes::quad({-floor_half, 0, floor_half}, {2 * floor_half, 0, 0}, {0, 0, -2 * floor_half}));
  }
  GBuffer surfels(const std::vector<vec3>& points) const {
    return shapes::surfels(points, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
  }
};

struct Expected {
  double cosine;
  double uniform;  // NaN where no closed form is at hand
};
using Occlusion = std::function<Expected(const vec3&)>;

// Means over the points, for both weights, within the interval of their sum.
void expect_means(const Floor& floor, const std::vector<vec3>& points, double distance, const Occlusion& occlusion) {
  const Tracer tracer(floor.scene);
  Expected sum{0, 0};
  for (const vec3& p : points) {
    const Expected o = occlusion(p);
    sum.cosine += o.cosine;
    sum.uniform += o.uniform;
  }
  const double n = static_cast<double>(points.size());
  const auto expect = [&](AoWeight weight, double accessibility) {
    const TracedAo traced = trace_ao(tracer, floor.surfels(points), {16384, weight, distance}, 1);
    double total = 0.0;
    double variance = 0.0;
    for (const float ao : traced.ao.pixels) total += ao;
    for (const float v : traced.variance.pixels) variance += v;
    EXPECT_NEAR(total / n, accessibility, sigmas * std::sqrt(variance) / n + geometry);
    EXPECT_LT(sigmas * std::sqrt(variance) / n, 6e-4) << "too few rays to tell";
  };
  expect(AoWeight::cosine, 1.0 - sum.cosine / n);
  if (!std::isnan(sum.uniform)) expect(AoWeight::uniform, 1.0 - sum.uniform / n);
}

std::vector<vec3> around(vec3 center, float spread, int count) {
  std::vector<vec3> points;
  for (int i = 0; i < count; ++i) {
    const float t = 2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 1.0f;
    points.push_back(center + spread * vec3(t, 0.0f, 0.3f * t));
  }
  return points;
}

// The wall stands at x = 0, as high as h, and 200 m to either side: what lies beyond subtends less than
// (h/200)·(d/200)/2π < 10⁻⁵ of the hemisphere.
Floor wall(float h) {
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::quad({0, 0, -200}, {0, h, 0}, {0, 0, 400}));
  return floor;
}

// Directions of azimuth φ off the wall's normal meet it at horizontal distance d/cos φ: below the elevation of its top
// and, with a limit D, below the elevation at which the way is D. ∫ sin e cos e de and ∫ cos e de have closed forms.
Expected wall_by_quadrature(double h, double d, double limit) {
  constexpr int steps = 20000;
  Expected o{0, 0};
  for (int i = 0; i < steps; ++i) {
    const double phi = pi * ((i + 0.5) / steps - 0.5);
    double elevation = std::atan(h * std::cos(phi) / d);
    if (limit > 0.0) {
      const double c = d / (limit * std::cos(phi));
      elevation = c < 1.0 ? std::min(elevation, std::acos(c)) : 0.0;
    }
    o.cosine += 0.5 * std::sin(elevation) * std::sin(elevation) / steps;
    o.uniform += 0.5 * std::sin(elevation) / steps;
  }
  return o;
}

TEST(AmbientOcclusion, An_open_plane_is_open_and_a_closed_room_is_closed) {
  Floor open;
  const std::vector<vec3> points = around({0, 0, 0}, 3.0f, 32);
  for (const float ao : trace_ao(Tracer(open.scene), open.surfels(points), {256}, 1).ao.pixels) EXPECT_EQ(ao, 1.0f);
  Floor room;
  shapes::add_mesh(room.scene, shapes::box({-floor_half, 0, -floor_half}, {floor_half, 5, floor_half}));
  const TracedAo traced = trace_ao(Tracer(room.scene), room.surfels(points), {256}, 1);
  for (const float ao : traced.ao.pixels) EXPECT_EQ(ao, 0.0f);
  // 256 rays that agree may have missed 3/256, with eight randomisations 2.3646 standard errors.
  for (const float error : traced.standard_error.pixels) EXPECT_NEAR(error, 2.99573 / 256 / 2.3646, 1e-6);
  for (const float variance : traced.variance.pixels) EXPECT_EQ(variance, 0.0f);
}

TEST(AmbientOcclusion, A_closed_room_is_closed_also_for_surfels_on_its_creases_and_in_its_corners) {
  // Rasterisers put surfels exactly on edges, where a rounded origin could fall behind the wall. Coordinates far from
  // the origin and a turned room leave no number exact.
  for (const double far : {0.0, 1000.3}) {
    for (const bool shared : {false, true}) {
      dmat4 transform(1.0);
      transform[0] = dvec4(std::cos(0.3), std::sin(0.3), 0, 0);
      transform[1] = dvec4(-std::sin(0.3), std::cos(0.3), 0, 0);
      transform[3] = dvec4(far, 0.1 * far, -0.7 * far, 1);
      Scene scene = shapes::empty_scene();
      const std::uint32_t room = shapes::add_mesh(scene, shapes::box({-3, 0, -2}, {3, 2.5f, 2}), transform);
      if (shared) scene.instances.push_back({scene.instances[room].mesh, 0, dmat4(2.0)});
      constexpr int along = 40;
      GBuffer gbuffer(3 * along, 12);
      for (std::uint32_t t = 0; t < 12; ++t) {
        const Triangle corners = world_triangle(scene, room, t);
        const dvec3 v[] = {corners.a, corners.b, corners.c};
        const dvec3 inside = dvec3(transform * dvec4(0, 1.25, 0, 1)) - corners.a;
        dvec3 normal = glm::normalize(glm::cross(corners.b - corners.a, corners.c - corners.a));
        if (glm::dot(normal, inside) < 0.0) normal = -normal;
        for (int i = 0; i < 3 * along; ++i) {
          const std::size_t pixel = gbuffer.instance.index(i, static_cast<int>(t));
          gbuffer.instance[pixel] = room;
          gbuffer.triangle[pixel] = t;
          gbuffer.position[pixel] = vec3(glm::mix(v[i / along], v[(i / along + 1) % 3], i % along / (along - 1.0)));
          gbuffer.geometric_normal[pixel] = vec3(normal);
        }
      }
      const TracedAo traced = trace_ao(Tracer(scene), gbuffer, {64}, 1);
      for (std::size_t i = 0; i < traced.ao.size(); ++i) {
        ASSERT_EQ(traced.ao[i], 0.0f) << "far " << far << ", shared " << shared << ", surfel " << i;
      }
    }
  }
}

TEST(AmbientOcclusion, An_infinitely_long_wall) {
  // AO cos .853553, uni .750000 at d = 1; .621268, .577979 at d = 0.25.
  const Floor floor = wall(1.0f);
  expect_means(floor, std::vector<vec3>(32, {1, 0, 0}), 0.0, [](vec3) { return Expected{1 - .853553, 1 - .75}; });
  expect_means(floor, std::vector<vec3>(32, {.25f, 0, 0}), 0.0, [](vec3) {
    return Expected{1 - .621268, 1 - .577979};
  });
  expect_means(floor, around({2, 0, 1}, 1.8f, 64), 0.0, [](vec3 p) {
    const double d = p.x;
    return Expected{0.5 * (1.0 - d / std::sqrt(d * d + 1.0)), std::atan(1.0 / d) / pi};
  });
}

TEST(AmbientOcclusion, A_wall_with_a_distance_limit) {
  const auto segment = [](double c) { return std::acos(c) - c * std::sqrt(1.0 - c * c); };
  // AO cos .868736, uni .793870 at h = 1, d = 1, D = 2.
  const Floor floor = wall(1.0f);
  expect_means(floor, std::vector<vec3>(32, {1, 0, 0}), 2.0, [](vec3) { return Expected{1 - .868736, 1 - .793870}; });
  EXPECT_NEAR(wall_by_quadrature(1.0, 1.0, 2.0).cosine, 1 - .868736, 1e-6);
  EXPECT_NEAR(wall_by_quadrature(1.0, 1.0, 2.0).uniform, 1 - .793870, 1e-5);
  expect_means(floor, around({1.5f, 0, 0}, 1.3f, 64), 2.0, [](vec3 p) { return wall_by_quadrature(1.0, p.x, 2.0); });
  // A limit below the wall's height: c ≥ a, O_cos = S(c)/π, O_uni = (1 − c)/2; beyond the limit 0.
  expect_means(wall(4.0f), around({0.6f, 0, 0}, 0.5f, 64), 1.0, [&](vec3 p) {
    return p.x >= 1.0f ? Expected{0, 0} : Expected{segment(p.x) / pi, (1.0 - p.x) / 2.0};
  });
}

TEST(AmbientOcclusion, A_sphere_wholly_above_the_horizon) {
  // O_cos = cos θ (R/L)², O_uni = 1 − √(1 − (R/L)²): AO .555556, .745356 for R = 1 at 1.5 overhead.
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::sphere({0, 1.5f, 0}, 1.0f, 200, 400));
  expect_means(floor, std::vector<vec3>(32, {0, 0, 0}), 0.0, [](vec3) { return Expected{1 - .555556, 1 - .745356}; });
  expect_means(floor, around({2, 0, 1}, 1.5f, 64), 0.0, [](vec3 p) {
    const double squared = 2.25 + glm::dot(dvec3(p), dvec3(p));
    return Expected{1.5 / std::sqrt(squared) / squared, 1.0 - std::sqrt(1.0 - 1.0 / squared)};
  });
}

TEST(AmbientOcclusion, A_sphere_overhead_with_a_distance_limit) {
  // c = (h² + D² − R²)/(2hD) from the law of cosines; O_cos = 1 − c², O_uni = 1 − c.
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::sphere({0, 1.5f, 0}, 1.0f, 200, 400));
  // Beyond the tangents' length √(h² − R²) = 1.118 the limit cuts nothing off.
  const double tangent = std::sqrt(1.25);
  for (const double limit : {0.55, 0.7, 0.9, 1.1, 1.2, 2.0}) {
    const double c = limit < tangent ? (2.25 + limit * limit - 1.0) / (3.0 * limit) : tangent / 1.5;
    expect_means(floor, std::vector<vec3>(32, {0, 0, 0}), limit, [&](vec3) { return Expected{1 - c * c, 1 - c}; });
  }
}

TEST(AmbientOcclusion, A_sphere_resting_on_the_floor) {
  // O_cos = R³/(s² + R²)^{3/2}: AO .910557, .894427 (uni) for R = 1 at s = 2. The sphere stands 10⁻⁴ above the floor.
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::sphere({0, 1.0001f, 0}, 1.0f, 200, 400));
  expect_means(floor, std::vector<vec3>(32, {2, 0, 0}), 0.0, [](vec3) { return Expected{1 - .910557, 1 - .894427}; });
  expect_means(floor, around({2.2f, 0, 0}, 1.5f, 64), 0.0, [](vec3 p) {
    const double squared = glm::dot(dvec3(p), dvec3(p)) + 1.0;
    return Expected{std::pow(squared, -1.5), std::nan("")};
  });
}

TEST(AmbientOcclusion, A_parallel_disk) {
  // O_cos = ½(1 − (s² + h² − r²)/√((s² + h² + r²)² − 4r²s²)): AO .5, uni .707107 for r = 1 at height 1.
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::disk({0, 1, 0}, 1.0f, 720));
  expect_means(floor, std::vector<vec3>(32, {0, 0, 0}), 0.0, [](vec3) { return Expected{.5, 1 - .707107}; });
  expect_means(floor, around({1, 0, 0}, 1.0f, 64), 0.0, [](vec3 p) {
    const double s2 = glm::dot(dvec3(p), dvec3(p));
    const double root = std::sqrt((s2 + 2.0) * (s2 + 2.0) - 4.0 * s2);
    return Expected{0.5 * (1.0 - s2 / root), std::nan("")};
  });
}

TEST(AmbientOcclusion, A_ceiling_with_a_distance_limit) {
  // O_cos = 1 − (h/D)², O_uni = 1 − h/D: AO .444444, .666667 for h = 2, D = 3. Ways of 3 m reach 2.24 m aside.
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::quad({-7, 2, -7}, {14, 0, 0}, {0, 0, 14}));
  const std::vector<vec3> points = around({0, 0, 0}, 3.0f, 64);
  expect_means(floor, points, 3.0, [](vec3) { return Expected{1 - 4.0 / 9.0, 1 - 2.0 / 3.0}; });
  expect_means(floor, points, 2.05, [](vec3) { return Expected{1 - 4.0 / 4.2025, 1 - 2.0 / 2.05}; });
  expect_means(floor, points, 1.95, [](vec3) { return Expected{0, 0}; });
}

TEST(AmbientOcclusion, Planes_that_meet_at_right_angles_and_grooves) {
  // Two planes 1/2, three 1/4. At 1 mm from the edge of planes of 20 m the rest is 10⁻³/20 of each.
  Floor two;
  shapes::add_mesh(two.scene, shapes::quad({0, 0, -20}, {0, 20, 0}, {0, 0, 40}));
  expect_means(two, std::vector<vec3>(32, {0.001f, 0, 0}), 0.0, [](vec3) { return Expected{.5, .5}; });
  shapes::add_mesh(two.scene, shapes::quad({-20, 0, 0}, {0, 20, 0}, {40, 0, 0}));
  expect_means(two, std::vector<vec3>(32, {0.001f, 0, 0.001f}), 0.0, [](vec3) { return Expected{.75, .75}; });
  // V groove of opening Φ: AO_cos = sin²(Φ/2).
  for (const double opening : {pi / 3.0, 2.0 * pi / 3.0}) {
    Floor groove;
    const vec3 up = 20.0f * vec3(dvec3(std::cos(opening), std::sin(opening), 0));
    shapes::add_mesh(groove.scene, shapes::quad({0, 0, -20}, up, {0, 0, 40}));
    const double closed = 1.0 - std::pow(std::sin(opening / 2.0), 2);
    expect_means(groove, std::vector<vec3>(32, {0.001f, 0, 0}), 0.0, [&](vec3) {
      return Expected{closed, std::nan("")};
    });
  }
}

TEST(AmbientOcclusion, A_box_by_its_polygons) {
  Floor floor;
  shapes::add_mesh(floor.scene, shapes::box({-3, 0, -1}, {-1, 2, 1}));
  const auto occlusion = [](vec3 p) {
    // From x > −1 and |z| < 1 at y = 0 only the face x = −1 is turned to the point.
    const polygons::Polygon face = {{-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, {-1, 0, 1}};
    return Expected{polygons::cosine_share(face, dvec3(p), {0, 1, 0}), std::nan("")};
  };
  EXPECT_NEAR(occlusion({0, 0, 0}).cosine, 1 - .809864, 1e-6);  // AO .809864 from the origin
  expect_means(floor, std::vector<vec3>(32, {0, 0, 0}), 0.0, occlusion);
  expect_means(floor, around({0.8f, 0, 0.1f}, 1.4f, 64), 0.0, occlusion);
}

TEST(AmbientOcclusion, A_hanging_triangle_by_lambert) {
  Floor floor;
  Mesh triangle;
  triangle.positions = {{-1, 0.5f, 0}, {2, 1.5f, -1}, {0, 2.5f, 1.5f}};
  triangle.triangles = {{0, 1, 2}};
  shapes::add_mesh(floor.scene, triangle);
  expect_means(floor, around({0, 0, 0}, 3.0f, 64), 0.0, [&](vec3 p) {
    const polygons::Polygon corners(triangle.positions.begin(), triangle.positions.end());
    return Expected{polygons::cosine_share(corners, dvec3(p), {0, 1, 0}), std::nan("")};
  });
}

TEST(AmbientOcclusion, Masked_leaves_let_rays_through) {
  Floor floor;
  Material clear;
  clear.alpha_mode = AlphaMode::mask;
  clear.base_color.w = 0.25f;
  floor.scene.materials.push_back(clear);
  Mesh roof = shapes::quad({-8, 1, -8}, {16, 0, 0}, {0, 0, 16});
  roof.material = 1;
  shapes::add_mesh(floor.scene, roof);
  const auto mean = [&] {
    return trace_ao(Tracer(floor.scene), floor.surfels({{0, 0, 0.5f}}), {256, AoWeight::cosine, 3.0}, 1).ao[0];
  };
  EXPECT_EQ(mean(), 1.0f);
  floor.scene.materials[1].alpha_cutoff = 0.25f;
  EXPECT_NEAR(mean(), 1.0f / 9.0f, 0.01f);
}

TEST(AmbientOcclusion, Thread_counts_change_nothing_and_seeds_only_the_noise) {
  const Floor floor = wall(1.0f);
  const GBuffer gbuffer = floor.surfels(around({1, 0, 0}, 0.9f, 200));
  const Tracer tracer(floor.scene);
  std::vector<TracedAo> runs;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    runs.push_back(trace_ao(tracer, gbuffer, {64, AoWeight::uniform, 1.0}, 5));
  }
  EXPECT_EQ(runs[0].ao, runs[1].ao);
  EXPECT_EQ(runs[0].ao, runs[2].ao);
  EXPECT_EQ(runs[0].standard_error, runs[2].standard_error);
  EXPECT_EQ(runs[0].statistics.rays, 200u * 64u);
  const TracedAo other = trace_ao(tracer, gbuffer, {64, AoWeight::uniform, 1.0}, 6);
  EXPECT_NE(runs[0].ao, other.ao);
  double difference = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    difference += other.ao[i] - runs[0].ao[i];
    variance += std::pow(other.standard_error[i], 2) + std::pow(runs[0].standard_error[i], 2);
  }
  EXPECT_LT(std::abs(difference), 5.0 * std::sqrt(variance));
}

TEST(AmbientOcclusion, One_ray_a_pixel_says_that_it_knows_nothing_of_its_error) {
  const Floor floor = wall(1.0f);
  const TracedAo traced = trace_ao(Tracer(floor.scene), floor.surfels({{1, 0, 0}}), {1}, 1);
  EXPECT_TRUE(traced.ao[0] == 0.0f || traced.ao[0] == 1.0f);
  EXPECT_EQ(traced.standard_error[0], 0.5f);
}

}  // namespace
}  // namespace umbrameter
