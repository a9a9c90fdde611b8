// A method's own integral on the full geometry and on what a depth buffer knows of it, against closed forms.
#include "raytrace/ao_integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

constexpr auto all = static_cast<std::size_t>(Occluders::all);
constexpr auto in_view = static_cast<std::size_t>(Occluders::in_view);
constexpr auto seen = static_cast<std::size_t>(Occluders::seen);
constexpr auto solid = static_cast<std::size_t>(Occluders::solid);

View view_from(const dvec3& eye, const dvec3& target, double degrees = 50.0) {
  View view{120, 90, {}};
  const dvec3 z = glm::normalize(eye - target);
  const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.999 ? dvec3(0, 1, 0) : dvec3(0, 0, -1), z));
  view.camera.world_from_camera = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(eye, 1));
  view.camera.projection = PerspectiveProjection{degrees * pi / 180.0, 0.01, 1000.0};
  return view;
}

View parallel(View view, double half_height) {
  view.camera.projection = OrthographicProjection{half_height, half_height, 0.01, 100.0};
  return view;
}

// Every hit up to the reach occludes in full.
AoIntegral plain(AoDirections directions, double reach) {
  return {directions, reach, [](const AoHit&) { return 1.0; }, [](double a) { return a; }, {}};
}

Scene floor() {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}));
  return scene;
}

struct Traced {
  GBuffer gbuffer;
  TracedIntegral integral;
};
Traced trace(const Scene& scene, const View& view, const AoIntegral& integral, int spp = 64) {
  const Tracer tracer(scene);
  Traced traced{trace_gbuffer(tracer, view), {}};
  traced.integral = trace_integral(tracer, traced.gbuffer, view, integral, {spp, 1});
  return traced;
}

struct Mean {
  double value = 0.0;
  double error = 0.0;  // standard
  double exact = 0.0;
  double pixels = 0.0;
};
// Over floor pixels that `is_in` selects, with the mean of the closed form at their positions.
template <class IsIn, class Exact>
Mean mean_over(const Traced& traced, std::size_t occluders, const IsIn& is_in, const Exact& exact) {
  Mean mean;
  for (std::size_t i = 0; i < traced.gbuffer.position.size(); ++i) {
    const vec3& p = traced.gbuffer.position[i];
    if (traced.gbuffer.instance[i] != 0 || !is_in(p)) continue;
    mean.value += traced.integral.accessibility[occluders][i];
    mean.error += traced.integral.variance[occluders][i];
    mean.exact += exact(p);
    ++mean.pixels;
  }
  mean.value /= mean.pixels;
  mean.exact /= mean.pixels;
  mean.error = std::sqrt(mean.error) / mean.pixels;
  return mean;
}

// The occlusion of a floor point at distance d from an endless wall of height h, limit D, cosine weight:
// c = d/D, a = d/√(d² + h²), S(c) = acos c − c√(1 − c²): c ≥ 1: 0; c ≥ a: S(c)/π; else (S(c) − a·S(c/a))/π.
double wall_occlusion(double d, double h, double limit) {
  const auto s = [](double c) { return std::acos(c) - c * std::sqrt(1.0 - c * c); };
  const double c = d / limit;
  const double a = d / std::hypot(d, h);
  if (c >= 1.0) return 0.0;
  return c >= a ? s(c) / pi : (s(c) - a * s(c / a)) / pi;
}

TEST(AoIntegral, Under_an_endless_ceiling_each_method_has_its_closed_form) {
  // Ceiling at height h, radius R, c = h/R; a ray at μ = cos θ goes h/μ, that is x = c/μ of the radius. The occlusion
  // is ∫ w(c/μ) dμ for uniform and ∫ 2μ w(c/μ) dμ for cosine weight, from c to 1.
  constexpr double h = 1.2;
  constexpr double radius = 3.0;
  constexpr double c = h / radius;
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::quad({-2000, h, -2000}, {4000, 0, 0}, {0, 0, 4000}));
  // Few pixels with many rays each: the occluders that this test does not look at are searched along rows of pixels.
  View view = view_from({0, 1.0, 0.01}, {0, 0, 0});
  view.width = 40;
  view.height = 30;
  AoSamplingParams sampling;
  sampling.radius = radius;
  GtaoParams gtao;
  gtao.radius_multiplier = gtao.power = 1.0;
  HbaoParams hbao;
  hbao.tangent_bias = 0.0;
  AlchemyParams alchemy;
  alchemy.bias = 0.0;
  alchemy.estimator = AlchemyEstimator::alchemy;
  alchemy.intensity = 0.25;
  // The share of the kernel's points ξ (0.1 + 0.9 u²) beyond c/μ, by midpoints.
  double ssao_occlusion = 0.0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double mu = c + (1.0 - c) * (i + 0.5) / steps;
      const double u = (k + 0.5) / steps;
      ssao_occlusion += (1.0 - c) / (1.0 * steps * steps) * std::max(0.0, 1.0 - c / mu / (0.1 + 0.9 * u * u));
    }
  }
  Marched uniform{sampling, {}, {}};
  uniform.params.weight = MarchedWeight::uniform;
  Bitmask bitmask{sampling, {}, {}, {}};
  EXPECT_FALSE(integral_of(bitmask)) << "weights by angle";
  bitmask.params.weight = BitmaskWeight::cosine;
  const std::pair<AoIntegral, double> expected[] = {
      // All is met from c on: ∫ 2μ dμ and ∫ dμ.
      {integral_of(Marched{sampling, {}, {}}), c * c},
      {*integral_of(bitmask), c * c},
      {integral_of(uniform), c},
      {integral_of(Ssao{sampling, {}, {}, {}, {}}), 1.0 - ssao_occlusion},
      // Only the fading part, from x = 0.385 on, is met: ∫ 2μ (1 − c/μ)/0.615 dμ.
      {integral_of(Gtao{sampling, {}, {}, gtao}), 1.0 - (1 - c) * (1 - c) / 0.615},
      // ∫ (1 − c²/μ²) dμ.
      {integral_of(Hbao{sampling, {}, hbao}), 1.0 - (1 - c) * (1 - c)},
      // A quarter of ∫ 2R (h/μ · μ)/(h/μ)² dμ = ∫ 2μ²/c dμ; the estimator's ε changes it by less than 10⁻³.
      {integral_of(Alchemy{sampling, {}, alchemy}), 1.0 - 0.25 * 2.0 / (3.0 * c) * (1 - c * c * c)},
      // Half of 1 − ∫ (1 − c³/μ³) dμ.
      {integral_of(Crytek{sampling, {}, {}, {}}), 0.5 * (1.0 - (1.0 - 1.5 * c + 0.5 * c * c * c))},
  };
  const auto everywhere = [](const vec3&) { return true; };
  for (const auto& [integral, exact] : expected) {
    const Traced traced = trace(scene, view, integral, 256);
    const Mean mean = mean_over(traced, all, everywhere, [](const vec3&) { return 0.0; });
    EXPECT_NEAR(mean.value, exact, 5.0 * mean.error + 2e-4) << integral.formula;
    EXPECT_LT(mean.error, 5e-4) << integral.formula;
  }
}

TEST(AoIntegral, An_open_plane_is_open_to_all_occluders_at_every_angle_of_view) {
  for (const double degrees : {5.0, 30.0, 60.0, 85.0}) {
    const double angle = degrees * pi / 180.0;
    const dvec3 eye(0.3, 3.0 * std::cos(angle), 3.0 * std::sin(angle));
    for (const View& view : {view_from(eye, dvec3(0)), parallel(view_from(eye, dvec3(0)), 1.0)}) {
      for (const AoDirections directions : {AoDirections::cosine, AoDirections::uniform}) {
        const Traced traced = trace(floor(), view, plain(directions, 0.5), 8);
        for (const Image<float>& image : traced.integral.accessibility) {
          EXPECT_EQ(*std::min_element(image.pixels.begin(), image.pixels.end()), 1.0f) << degrees;
        }
      }
    }
  }
}

TEST(AoIntegral, Beside_a_wall_in_full_view_all_occluders_give_the_closed_form) {
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::quad({0, 0, -500}, {0, 1, 0}, {0, 0, 1000}));
  const auto near = [](const vec3& p) { return p.x > 0.02f && p.x < 1.2f && std::abs(p.z) < 0.6f; };
  const auto exact = [](const vec3& p) { return 1.0 - wall_occlusion(p.x, 1.0, 0.8); };
  for (const View& view :
       {view_from({3, 2.5, 0.4}, {0.5, 0.3, 0}), parallel(view_from({3, 3, 0}, {0.5, 0.3, 0}), 1.6)}) {
    const Traced traced = trace(scene, view, plain(AoDirections::cosine, 0.8), 64);
    for (const std::size_t occluders : {all, in_view, seen, solid}) {
      const Mean mean = mean_over(traced, occluders, near, exact);
      EXPECT_GT(mean.pixels, 150.0);
      EXPECT_NEAR(mean.value, mean.exact, 4.0 * mean.error) << occluders;
    }
  }
}

TEST(AoIntegral, A_wall_beside_the_image_is_off_screen) {
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::quad({0, 0, -500}, {0, 1, 0}, {0, 0, 1000}));
  const View view = view_from({1.0, 3, 0.001}, {1.0, 0, 0}, 20.0);  // sees 0.3 < x < 1.7
  const Traced traced = trace(scene, view, plain(AoDirections::cosine, 0.8), 64);
  const auto near = [](const vec3& p) { return p.x < 0.6f; };
  const auto exact = [](const vec3& p) { return 1.0 - wall_occlusion(p.x, 1.0, 0.8); };
  const Mean full = mean_over(traced, all, near, exact);
  EXPECT_NEAR(full.value, full.exact, 4.0 * full.error);
  EXPECT_LT(full.exact, 0.95);
  for (const std::size_t occluders : {in_view, seen, solid}) {
    EXPECT_EQ(mean_over(traced, occluders, near, exact).value, 1.0) << occluders;
  }
}

TEST(AoIntegral, A_thin_disk_has_its_closed_form_unless_it_is_assumed_solid) {
  // On the axis: 1 − r²/(r² + h²); off the axis by s: ½(1 − (s² + h² − r²)/√((s² + h² + r²)² − 4r²s²)).
  constexpr double r = 0.5;
  constexpr double h = 0.4;
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::disk({0, h, 0}, r, 720));
  const View view = view_from({0, 1.2, 2.5}, {0, 0.1, 0.2});
  const auto near = [](const vec3& p) { return std::abs(p.x) < 0.4f && p.z > 0.0f && p.z < 0.8f; };
  const auto exact = [](const vec3& p) {
    const double s2 = double{p.x} * p.x + double{p.z} * p.z;
    const double root = std::sqrt((s2 + h * h + r * r) * (s2 + h * h + r * r) - 4.0 * r * r * s2);
    return 1.0 - 0.5 * (1.0 - (s2 + h * h - r * r) / root);
  };
  const Traced traced = trace(scene, view, plain(AoDirections::cosine, 2.0), 64);
  for (const std::size_t occluders : {all, in_view, seen}) {
    const Mean mean = mean_over(traced, occluders, near, exact);
    // The disk's outline is known to half a pixel, about 1 cm.
    EXPECT_NEAR(mean.value, mean.exact, 4.0 * mean.error + (occluders == seen ? 5e-3 : 2e-4)) << occluders;
  }
  const Mean thick = mean_over(traced, solid, near, exact);
  EXPECT_LT(thick.value, thick.exact - 0.04);
  // A slab of 1 mm hides little more than the disk.
  AoIntegral of_slab = plain(AoDirections::cosine, 2.0);
  of_slab.occlusion = [](const AoHit& hit) { return hit.behind <= 0.001 ? 1.0 : 0.0; };
  const Traced thin = trace(scene, view, of_slab, 64);
  const Mean slab = mean_over(thin, solid, near, exact);
  EXPECT_NEAR(slab.value, slab.exact, 1e-2);
}

TEST(AoIntegral, The_far_side_of_a_box_is_hidden) {
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::box({-40, -0.1f, -0.5f}, {40, 1, 0}));
  // Over the box, whose far side is at z = -0.5, onto the floor behind it.
  const View view = view_from({0, 4.0, 1.0}, {0, 0, -1.4}, 40.0);
  const auto near = [](const vec3& p) { return p.z < -1.0f && p.z > -1.4f && std::abs(p.x) < 0.5f; };
  const auto exact = [](const vec3& p) { return 1.0 - wall_occlusion(-0.5 - p.z, 1.0, 1.0); };
  const Traced traced = trace(scene, view, plain(AoDirections::cosine, 1.0), 64);
  for (const std::size_t occluders : {all, in_view}) {
    const Mean mean = mean_over(traced, occluders, near, exact);
    EXPECT_GT(mean.pixels, 150.0);
    EXPECT_NEAR(mean.value, mean.exact, 4.0 * mean.error);
  }
  // Without the far side, rays reach the top from inside, or nothing; all that is behind the top seems solid.
  const double full = mean_over(traced, in_view, near, exact).value;
  EXPECT_GT(mean_over(traced, seen, near, exact).value, full + 0.02);
  EXPECT_LT(mean_over(traced, solid, near, exact).value, full - 0.02);
}

// A plateau of height 1 m over the floor from x = 0 on, seen from above: its side is edge-on, seen by no pixel.
constexpr double plateau = 1.0;
Scene floor_and_plateau() {
  Scene scene = floor();
  shapes::add_mesh(scene, shapes::box({0, -0.1f, -40}, {40, plateau, 40}));
  return scene;
}

// The cosine-weighted share of the directions above the floor that are not blocked, by midpoints on the disk of their
// horizontal parts.
template <class IsBlocked>
double open_share(const IsBlocked& is_blocked) {
  constexpr int steps = 100;
  double open = 0.0, directions = 0.0;
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const double x = 2.0 * (i + 0.5) / steps - 1.0;
      const double z = 2.0 * (j + 0.5) / steps - 1.0;
      if (x * x + z * z >= 1.0) continue;
      directions += 1.0;
      if (!is_blocked(dvec3(x, std::sqrt(1.0 - x * x - z * z), z))) open += 1.0;
    }
  }
  return open / directions;
}

constexpr double radius_by_plateau = 1.5;
Bitmask bitmask_of(double thickness) {
  AoSamplingParams sampling;
  sampling.radius = radius_by_plateau;
  return {sampling, {}, {}, {.thickness = thickness, .weight = BitmaskWeight::cosine}};
}
Marched marched_of(double thickness) {
  AoSamplingParams sampling;
  sampling.radius = radius_by_plateau;
  return {sampling, {}, {.thickness = thickness}};
}

TEST(AoIntegral, A_plateau_out_of_reach_of_bitmask_and_ray_marching_blocks_nothing_below_its_top) {
  // Its edge is 1.15 m away, at the distance √(1.15² + 1²) = 1.524 m > R = 1.5 m, which the bitmask ignores. A ray of
  // 1.5 m is at most √(1.5² − 1.15²) = 0.963 m high there: too deep below the top for a thickness of 0.02 R = 0.03 m.
  // Pixels of 1/30 m, one of them centred at x = -1.15, with the edge between two of them.
  const View view = parallel(view_from({-35.0 / 30.0, 5, 0}, {-35.0 / 30.0, 0, 0}), 1.5);
  const auto near = [](const vec3& p) { return std::abs(p.x + 1.15f) < 0.01f && std::abs(p.z) < 1.0f; };
  const auto exact = [](const vec3&) { return 1.0; };
  for (const AoIntegral& integral : {*integral_of(bitmask_of(0.25)), integral_of(marched_of(0.02))}) {
    const Traced traced = trace(floor_and_plateau(), view, integral, 32);
    EXPECT_EQ(mean_over(traced, seen, near, exact).pixels, 60.0);
    EXPECT_LT(mean_over(traced, in_view, near, exact).value, 0.98) << "its side blocks rays, but no pixel sees it";
    EXPECT_EQ(mean_over(traced, seen, near, exact).value, 1.0) << integral.formula;
    EXPECT_EQ(mean_over(traced, solid, near, exact).value, 1.0) << integral.formula;
  }
}

TEST(AoIntegral, Beside_a_plateau_ray_marching_takes_it_for_as_thick_as_its_thickness) {
  // Pixels of 4 cm, with the edge between two of them.
  const View view = parallel(view_from({-0.6, 5, 0}, {-0.6, 0, 0}), 1.8);
  const auto near = [](const vec3& p) { return std::abs(p.x + 0.6f) < 0.05f && std::abs(p.z) < 0.3f; };
  for (const double thickness : {0.1, 0.4, 1.0}) {
    const auto exact = [&](const vec3& p) {
      return open_share([&](const dvec3& d) {
        // From the plateau's edge to its top and to the radius, at heights down to the thickness below the top.
        const double from = std::max(-double{p.x} / d.x, (plateau - thickness * radius_by_plateau) / d.y);
        return d.x > 0.0 && from <= std::min(plateau / d.y, radius_by_plateau);
      });
    };
    const Traced traced = trace(floor_and_plateau(), view, integral_of(marched_of(thickness)));
    const Mean mean = mean_over(traced, solid, near, exact);
    EXPECT_GT(mean.pixels, 20.0);
    EXPECT_LT(mean.exact, 0.9);
    EXPECT_NEAR(mean.value, mean.exact, 3.0 * mean.error + 2e-3) << thickness;
  }
}

TEST(AoIntegral, Beside_a_plateau_the_bitmask_takes_what_it_sees_for_as_thick_as_its_thickness) {
  const View above = view_from({0.8, 5, 0.3}, {-0.6, 0, 0});
  for (const View& view : {above, parallel(view_from({-0.6, 5, 0}, {-0.6, 0, 0}), 1.8)}) {
    const bool is_parallel = std::holds_alternative<OrthographicProjection>(view.camera.projection);
    const dvec3 eye(view.camera.world_from_camera[3]);
    const auto near = [](const vec3& p) { return std::abs(p.x + 0.6f) < 0.05f && std::abs(p.z) < 0.15f; };
    for (const double thickness : {0.25, 0.6}) {
      const auto exact = [&](const vec3& p) {
        const dvec3 viewer = is_parallel ? dvec3(0, 1, 0) : glm::normalize(eye - dvec3(p));
        return open_share([&](const dvec3& d) {
          // Some point of the top within the radius is at most the thickness above the ray, along the viewer's
          // direction.
          for (double s = 0.01; s < 2.5; s += 0.02) {
            const double behind = (plateau - s * d.y) / viewer.y;
            const dvec3 top = s * d + behind * viewer;
            if (behind >= 0.0 && behind <= thickness * radius_by_plateau && top.x >= -double{p.x} &&
                glm::length(top) < radius_by_plateau) {
              return true;
            }
          }
          return false;
        });
      };
      const Traced traced = trace(floor_and_plateau(), view, *integral_of(bitmask_of(thickness)));
      const Mean mean = mean_over(traced, solid, near, exact);
      EXPECT_GT(mean.pixels, 6.0);
      EXPECT_LT(mean.exact, 0.9);
      // The edge is known to half a pixel of 4 cm in perspective.
      EXPECT_NEAR(mean.value, mean.exact, 3.0 * mean.error + (is_parallel ? 2e-3 : 8e-3)) << thickness;
    }
  }
}

}  // namespace
}  // namespace umbrameter
