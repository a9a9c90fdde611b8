// Whether the reference's intervals hold the truth as often as they say, with a fixed number of rays and with a
// tolerance; and how many rays each sampler needs.
#include <gtest/gtest.h>

#include <cmath>

#include "core/quantiles.h"
#include "raytrace/tracer.h"
#include "tests/support/ao_cases.h"

namespace umbrameter {
namespace {

double half_width(const TracedAo& traced, std::size_t i) {
  return student_95(traced.degrees_of_freedom) * static_cast<double>(traced.standard_error[i]);
}

// Share of interval_pixels whose interval holds the case's answer.
double coverage(const ao_cases::Case& c, const TracedAo& traced) {
  int held = 0;
  for (std::size_t i = 0; i < traced.ao.size(); ++i) {
    held += std::abs(traced.ao[i] - c.accessibility) <= half_width(traced, i) ? 1 : 0;
  }
  return static_cast<double>(held) / static_cast<double>(traced.ao.size());
}

double mean_square_error(const ao_cases::Case& c, const TracedAo& traced) {
  double sum = 0.0;
  for (const float ao : traced.ao.pixels) sum += std::pow(ao - c.accessibility, 2);
  return sum / static_cast<double>(traced.ao.size());
}

// (Mean of the interval_pixels − answer) over the mean's standard error, which four exceed once in 16000 cases. What
// the meshes differ from their ideals by is less than an eighth of it, see ambient_occlusion_test.cpp.
double normal_deviation(const ao_cases::Case& c, const TracedAo& traced) {
  double difference = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < traced.ao.size(); ++i) {
    difference += traced.ao[i] - c.accessibility;
    variance += traced.variance[i];
  }
  return difference / std::sqrt(variance);
}
constexpr double most_deviation = 4.0;

// Pixels a case: the standard error of a coverage of 95 % is √(.95·.05/3000) = 0.4 %.
constexpr int interval_pixels = 3000;
constexpr double expected = 0.95;
constexpr double allowed = 0.015;

TEST(AoInterval, With_a_fixed_number_of_rays_it_holds_the_known_answer_95_times_in_100) {
  for (const ao_cases::Case& c : ao_cases::all()) {
    const Scene scene = ao_cases::scene_of(c);
    TruthParams params = ao_cases::params_of(c);
    params.spp = 256;
    const TracedAo traced = trace_ao(Tracer(scene), ao_cases::surfels_of(c, interval_pixels), params, 11);
    EXPECT_NEAR(coverage(c, traced), expected, allowed) << c.name;
    EXPECT_LT(std::abs(normal_deviation(c, traced)), most_deviation) << c.name;
  }
}

TEST(AoInterval, With_a_tolerance_it_holds_the_known_answer_95_times_in_100) {
  for (const ao_cases::Case& c : ao_cases::all()) {
    const Scene scene = ao_cases::scene_of(c);
    TruthParams params = ao_cases::params_of(c);
    params.tolerance = 0.04;
    const TracedAo traced = trace_ao(Tracer(scene), ao_cases::surfels_of(c, interval_pixels), params, 11);
    EXPECT_NEAR(coverage(c, traced), expected, allowed) << c.name;
    EXPECT_LT(std::abs(normal_deviation(c, traced)), most_deviation) << c.name;
    EXPECT_LE(traced.precision.worst_half_width, params.tolerance) << c.name;
    EXPECT_EQ(traced.precision.pixels_at_limit, 0u) << c.name;
  }
}

TEST(AoInterval, Other_weights_limits_planes_polygons_and_solids_are_held_as_well) {
  // Of 1500 interval_pixels 93 % is 3.6 standard deviations of the binomial count below 95 %.
  constexpr int fewer = 1500;
  for (const ao_cases::Case& c : ao_cases::others()) {
    const Scene scene = ao_cases::scene_of(c);
    const Tracer tracer(scene);
    TruthParams params = ao_cases::params_of(c);
    for (const double tolerance : {0.0, 0.05}) {
      params.tolerance = tolerance;
      const TracedAo traced = trace_ao(tracer, ao_cases::surfels_of(c, fewer), params, 17);
      EXPECT_GE(coverage(c, traced), 0.93) << c.name << ", tolerance " << tolerance;
      EXPECT_LE(coverage(c, traced), 0.985) << c.name << ", tolerance " << tolerance;
      EXPECT_LT(std::abs(normal_deviation(c, traced)), most_deviation) << c.name << ", tolerance " << tolerance;
    }
  }
}

TEST(AoInterval, A_pixel_stops_between_its_limits_and_says_how_many_rays_it_took) {
  const ao_cases::Case c = ao_cases::all()[3];
  const Scene scene = ao_cases::scene_of(c);
  TruthParams params = ao_cases::params_of(c);
  params.tolerance = 0.01;
  params.min_spp = 300;
  params.max_spp = 900;
  const TracedAo traced = trace_ao(Tracer(scene), ao_cases::surfels_of(c, 500), params, 3);
  double rays = 0.0;
  std::uint64_t above = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_GE(traced.samples[i], 300.0f);
    EXPECT_LE(traced.samples[i], 900.0f);
    rays += traced.samples[i];
    if (half_width(traced, i) <= params.tolerance) continue;
    ++above;
    EXPECT_GT(traced.samples[i], 900.0f - 16.0f) << "it stopped early, above the tolerance";
  }
  EXPECT_EQ(static_cast<std::uint64_t>(rays), traced.statistics.rays);
  EXPECT_EQ(above, traced.precision.pixels_at_limit);
  EXPECT_GT(above, 0u);
  EXPECT_NEAR(traced.precision.mean_samples, rays / 500.0, 1e-9);
}

TEST(AoInterval, A_smaller_tolerance_costs_more_rays_and_open_pixels_need_what_the_rule_of_three_asks) {
  const ao_cases::Case c = ao_cases::all()[0];
  const Scene scene = ao_cases::scene_of(c);
  const Tracer tracer(scene);
  TruthParams params = ao_cases::params_of(c);
  std::uint64_t rays[2] = {};
  for (const int i : {0, 1}) {
    params.tolerance = i == 0 ? 0.02 : 0.01;
    rays[i] = trace_ao(tracer, ao_cases::surfels_of(c, 100), params, 3).statistics.rays;
  }
  EXPECT_GT(rays[1], rays[0]);
  Scene open = shapes::empty_scene();
  shapes::add_mesh(open, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  const TracedAo traced = trace_ao(Tracer(open), ao_cases::surfels_of(c, 100), params, 3);
  // A pilot of 64 and at least 2.9957/0.01 = 300 rays, in steps of up to a quarter.
  EXPECT_GE(traced.precision.mean_samples, 364.0);
  EXPECT_LE(traced.precision.mean_samples, 64.0 + 1.25 * 300.0 + 16.0);
  for (const float ao : traced.ao.pixels) EXPECT_EQ(ao, 1.0f);
}

TEST(AoInterval, Occluders_too_small_to_be_met_are_within_the_interval_of_pixels_that_look_open) {
  // A sphere that covers p = (R/L)² of the hemisphere: 64 rays meet none of it in about e^(−64 p) of the
  // interval_pixels.
  for (const double p : {0.005, 0.02}) {
    ao_cases::Case c{"speck", shapes::sphere({0, 2, 0}, 2.0f * static_cast<float>(std::sqrt(p)), 60, 120)};
    c.accessibility = 1.0 - p;
    const Scene scene = ao_cases::scene_of(c);
    TruthParams params;
    params.spp = 64;
    const TracedAo traced = trace_ao(Tracer(scene), ao_cases::surfels_of(c, interval_pixels), params, 5);
    int open = 0;
    for (std::size_t i = 0; i < traced.ao.size(); ++i) {
      EXPECT_GT(traced.standard_error[i], 0.0f);
      if (traced.ao[i] < 1.0f) continue;
      ++open;
      EXPECT_LE(p, half_width(traced, i));
    }
    EXPECT_GT(open, interval_pixels / 8);
    EXPECT_GT(coverage(c, traced), expected - allowed);
  }
}

TEST(AoInterval, Of_random_points_the_variance_is_the_binomial_one) {
  const ao_cases::Case c = ao_cases::all()[0];
  const Scene scene = ao_cases::scene_of(c);
  TruthParams params = ao_cases::params_of(c);
  params.sampler = Sampler::random;
  params.spp = 256;
  const TracedAo traced = trace_ao(Tracer(scene), ao_cases::surfels_of(c, interval_pixels), params, 7);
  const double binomial = c.accessibility * (1.0 - c.accessibility) / 256.0;
  // A mean of 3000 squares of normal variables has a relative standard error of √(2/3000) = 2.6 %; four of them.
  EXPECT_NEAR(mean_square_error(c, traced) / binomial, 1.0, 0.104);
  double variance = 0.0;
  for (const float v : traced.variance.pixels) variance += v;
  // Of 7 degrees of freedom each: √(2/21000) = 1 %.
  EXPECT_NEAR(variance / interval_pixels / binomial, 1.0, 0.04);
  EXPECT_NEAR(coverage(c, traced), expected, allowed);
}

TEST(AoInterval, Scrambled_sobol_at_1024_rays_errs_no_more_than_random_points_at_4096) {
  constexpr int count = 400;
  double owen_256 = 0.0;
  double random_1024 = 0.0;
  for (const ao_cases::Case& c : ao_cases::all()) {
    const Scene scene = ao_cases::scene_of(c);
    const Tracer tracer(scene);
    const GBuffer surfels = ao_cases::surfels_of(c, count);
    TruthParams params = ao_cases::params_of(c);
    const double binary = c.accessibility * (1.0 - c.accessibility);  // a ray's variance
    params.spp = 1024;
    EXPECT_LE(mean_square_error(c, trace_ao(tracer, surfels, params, 13)), binary / 4096.0) << c.name;
    params.spp = 256;
    owen_256 += mean_square_error(c, trace_ao(tracer, surfels, params, 13));
    random_1024 += binary / 1024.0;
  }
  EXPECT_LE(owen_256, random_1024) << "over all cases, a quarter of 1024 is enough";
}

TEST(AoInterval, Threads_and_neighbours_change_nothing_when_pixels_stop_on_their_own) {
  const ao_cases::Case c = ao_cases::all()[0];
  const Scene scene = ao_cases::scene_of(c);
  const Tracer tracer(scene);
  std::vector<vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back({0.02f + 0.01f * static_cast<float>(i), 0, 0.1f});
  const auto triangle_of = [](vec3 p) { return p.x > -p.z ? 0u : 1u; };
  const GBuffer gbuffer = shapes::surfels(points, {0, 1, 0}, 0, triangle_of);
  TruthParams params = ao_cases::params_of(c);
  params.tolerance = 0.02;
  std::vector<TracedAo> runs;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    runs.push_back(trace_ao(tracer, gbuffer, params, 5));
  }
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(runs[0].ao, runs[i].ao);
    EXPECT_EQ(runs[0].standard_error, runs[i].standard_error);
    EXPECT_EQ(runs[0].samples, runs[i].samples);
    EXPECT_EQ(runs[0].precision.mean_half_width, runs[i].precision.mean_half_width);
  }
  // Half of the interval_pixels gone: the others fall into other packets.
  GBuffer gaps = gbuffer;
  for (std::size_t i = 0; i < 300; i += 2) gaps.instance[i] = gaps.triangle[i] = no_id;
  const TracedAo fewer = trace_ao(tracer, gaps, params, 5);
  for (std::size_t i = 1; i < 300; i += 2) {
    EXPECT_EQ(fewer.ao[i], runs[0].ao[i]);
    EXPECT_EQ(fewer.samples[i], runs[0].samples[i]);
  }
}

}  // namespace
}  // namespace umbrameter
