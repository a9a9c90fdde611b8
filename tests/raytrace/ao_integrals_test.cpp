// Falloffs, shading normals, bent normals and hit distances against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "raytrace/tracer.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

constexpr int pixels = 64;

// A floor, and under an endless ceiling where height is above 0: 4 km wide, what lies beyond is below 10⁻⁵.
Scene floor_under(float height) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  if (height > 0.0f) {
    shapes::add_mesh(scene, shapes::quad({-2000, height, -2000}, {4000, 0, 0}, {0, 0, 4000}));
  }
  return scene;
}

GBuffer surfels() {
  return shapes::surfels(std::vector<vec3>(pixels, {0, 0, 0.5f}), {0, 1, 0}, 0,
                         [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
}

TruthParams with_rays(int spp) {
  TruthParams params;
  params.spp = spp;
  return params;
}

struct IntegralMean {
  double value = 0.0;
  double error = 0.0;  // standard
};
IntegralMean mean_of(const TracedAo& traced) {
  IntegralMean mean;
  for (std::size_t i = 0; i < traced.ao.size(); ++i) {
    mean.value += traced.ao[i] / static_cast<double>(traced.ao.size());
    mean.error += traced.variance[i];
  }
  mean.error = std::sqrt(mean.error) / static_cast<double>(traced.ao.size());
  return mean;
}

void expect_mean(const TracedAo& traced, double exact, const std::string& what) {
  const IntegralMean mean = mean_of(traced);
  EXPECT_NEAR(mean.value, exact, 5.0 * mean.error + 2e-5) << what;
  EXPECT_LT(mean.error, 3e-4) << what;
}

TEST(AoFalloffs, Under_an_endless_ceiling_each_has_its_closed_form) {
  // Ceiling at height h, limit D, c = h/D; a ray at μ = cos θ goes h/μ. With weight w(x), x = c/μ:
  //   O_cos = ∫ 2μ w dμ and O_uni = ∫ w dμ over μ from c to 1.
  constexpr double h = 1.2;
  constexpr double limit = 3.0;
  constexpr double c = h / limit;
  constexpr double a = c * c;
  constexpr double start = 0.385;
  const double log_c = std::log(c);
  struct Expected {
    AoFalloff falloff;
    const char* name;
    double cosine;
    double uniform;
  };
  const Expected expected[] = {
      {AoFalloff::none, "none", 1 - a, 1 - c},
      {AoFalloff::linear, "linear", (1 - c) * (1 - c), 1 - c + c * log_c},
      {AoFalloff::quadratic, "quadratic", 1 - a + 2 * a * log_c, (1 - c) * (1 - c)},
      {AoFalloff::hbao, "hbao", 1 - a + 2 * a * log_c, (1 - c) * (1 - c)},
      // (1 − a/μ²)³ = 1 − 3a/μ² + 3a²/μ⁴ − a³/μ⁶.
      {AoFalloff::sao, "sao", 1 + 1.5 * a - 3 * a * a + 0.5 * a * a * a + 6 * a * log_c,
       (1 + 3 * a - a * a + 0.2 * a * a * a) - (c + 3 * c - c + 0.2 * c)},
      // 1 beyond μ = c/s, (1 − c/μ)/(1 − s) from c to there; here c/s > 1, and only the fading part is met.
      {AoFalloff::gtao, "gtao", (1 - c) * (1 - c) / (1 - start), (1 - c + c * log_c) / (1 - start)},
      // Beyond the limit smoothstep of μ/c: ∫ 2μ(3μ²/c² − 2μ³/c³) dμ from 0 to c = 0.7 c², ∫ (…) dμ = c/2.
      {AoFalloff::ssao, "ssao", 1 - a + 0.7 * a, 1 - c + c / 2},
  };
  const Scene scene = floor_under(static_cast<float>(h));
  const Tracer tracer(scene);
  for (const Expected& e : expected) {
    TruthParams params = with_rays(4096);
    params.ao_distance = limit;
    params.ao_falloff = e.falloff;
    expect_mean(trace_ao(tracer, surfels(), params, 1), 1.0 - e.cosine, e.name);
    params.ao_weight = AoWeight::uniform;
    // The ceiling ends at 2 km: of the uniform hemisphere 1.2/2000 lie below its edge, seen by ssao alone with a weight
    // below 3 (1.2/2000/c)².
    expect_mean(trace_ao(tracer, surfels(), params, 1), 1.0 - e.uniform, e.name);
  }
}

TEST(AoFalloffs, Gtao_counts_in_full_near_by) {
  // c = 0.1 below s = 0.385: O_cos = 1 − c²/s.
  const Scene scene = floor_under(0.1f);
  TruthParams params = with_rays(4096);
  params.ao_distance = 1.0;
  params.ao_falloff = AoFalloff::gtao;
  expect_mean(trace_ao(Tracer(scene), surfels(), params, 1), 0.01 / 0.385, "gtao");
}

TEST(AoFalloffs, A_falloff_without_a_distance_is_an_error) {
  const Scene scene = floor_under(1.0f);
  TruthParams params = with_rays(16);
  params.ao_falloff = AoFalloff::linear;
  EXPECT_THROW(trace_ao(Tracer(scene), surfels(), params, 1), Error);
  params = with_rays(16);
  params.tolerance = 0.01;
  params.min_spp = 512;
  params.max_spp = 256;
  EXPECT_THROW(trace_ao(Tracer(scene), surfels(), params, 1), Error);
}

TEST(AoNormals, About_a_tilted_shading_normal_directions_into_the_surface_are_blocked) {
  // Of a hemisphere tilted by τ over an open plane (1 + cos τ)/2 stays above it by the cosine, 1 − τ/π evenly.
  const Scene scene = floor_under(0.0f);
  const Tracer tracer(scene);
  for (const double tilt : {0.3, 1.0}) {
    GBuffer gbuffer = surfels();
    for (vec3& normal : gbuffer.shading_normal.pixels) normal = vec3(dvec3(std::sin(tilt), std::cos(tilt), 0.0));
    TruthParams params = with_rays(4096);
    params.ao_normal = AoNormal::shading;
    for (const AoLayers layers : {AoLayers::none, AoLayers::all}) {
      params.ao_layers = layers;
      params.ao_weight = AoWeight::cosine;
      expect_mean(trace_ao(tracer, gbuffer, params, 1), (1.0 + std::cos(tilt)) / 2.0, "cosine");
      params.ao_weight = AoWeight::uniform;
      expect_mean(trace_ao(tracer, gbuffer, params, 1), 1.0 - tilt / pi, "uniform");
    }
    params.ao_normal = AoNormal::geometric;
    for (const float ao : trace_ao(tracer, gbuffer, params, 1).ao.pixels) EXPECT_EQ(ao, 1.0f);
  }
}

TEST(AoLayers, The_bent_normal_is_the_mean_open_direction) {
  // Open plane: the normal. A wall of 200 m beside a point at 1 mm leaves the half of the hemisphere with x > 0, whose
  // mean direction by cos θ/π is, before it is normalised,
  // along x ∫₀^{π/2} sin²θ cos θ dθ · ∫_{−π/2}^{π/2} cos φ dφ / π = (1/3)(2)/π,
  // along y ∫₀^{π/2} cos²θ sin θ dθ · π / π = 1/3.
  Scene scene = floor_under(0.0f);
  TruthParams params = with_rays(4096);
  params.ao_layers = AoLayers::bent_normal;
  const TracedAo open = trace_ao(Tracer(scene), surfels(), params, 1);
  for (const vec3& normal : open.bent_normal.pixels) EXPECT_GT(normal.y, 0.99999f);
  EXPECT_TRUE(open.hit_distance.empty());
  shapes::add_mesh(scene, shapes::quad({-0.001f, 0, -200}, {0, 200, 0}, {0, 0, 400}));
  const TracedAo half = trace_ao(Tracer(scene), surfels(), params, 1);
  dvec3 mean(0.0);
  for (const vec3& normal : half.bent_normal.pixels) mean += dvec3(normal) / static_cast<double>(pixels);
  EXPECT_NEAR(mean.x / mean.y, 2.0 / pi, 1e-3);
  EXPECT_NEAR(mean.z, 0.0, 1e-3);
  EXPECT_NEAR(glm::length(mean), 1.0, 1e-3);
}

TEST(AoLayers, The_hit_distance_is_the_mean_way_of_the_blocked_rays) {
  // Ceiling at h within D, c = h/D: ∫ 2μ (h/μ) dμ / ∫ 2μ dμ over μ from c to 1 = 2h(1 − c)/(1 − c²) = 2h/(1 + c).
  const Scene scene = floor_under(1.2f);
  TruthParams params = with_rays(4096);
  params.ao_layers = AoLayers::hit_distance;
  params.ao_distance = 3.0;
  const TracedAo traced = trace_ao(Tracer(scene), surfels(), params, 1);
  double mean = 0.0;
  for (const float distance : traced.hit_distance.pixels) mean += distance / static_cast<double>(pixels);
  EXPECT_NEAR(mean, 2.4 / 1.4, 1e-3);
  EXPECT_TRUE(traced.bent_normal.empty());
  params.ao_distance = 1.0;
  for (const float distance : trace_ao(Tracer(scene), surfels(), params, 1).hit_distance.pixels) {
    EXPECT_EQ(distance, std::numeric_limits<float>::infinity());
  }
}

TEST(AoLayers, Asking_for_them_does_not_change_accessibility) {
  const Scene scene = floor_under(1.2f);
  const Tracer tracer(scene);
  TruthParams params = with_rays(256);
  params.ao_distance = 3.0;
  const TracedAo fast = trace_ao(tracer, surfels(), params, 4);
  params.ao_layers = AoLayers::all;
  const TracedAo full = trace_ao(tracer, surfels(), params, 4);
  EXPECT_EQ(fast.ao, full.ao);
  EXPECT_EQ(fast.standard_error, full.standard_error);
}

}  // namespace
}  // namespace umbrameter
