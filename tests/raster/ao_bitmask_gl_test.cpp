// The visibility bitmask and ray-marched SSAO: an open plane, a wall of known occlusion, thin surfaces, and the shader
// against the processor.
#include <cmath>

#include "ao_fixture.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

AoParams bitmask(BitmaskWeight weight, BitmaskRounding rounding) {
  AoParams params = method(AoTechniques::choice<Bitmask>);
  params.bitmask.weight = weight;
  params.bitmask.rounding = rounding;
  return params;
}

TEST_F(AoMethodsGl, An_open_plane_is_open_for_the_bitmask_but_at_grazing_angles) {
  for (const auto weight : {BitmaskWeight::angle, BitmaskWeight::cosine}) {
    for (const auto rounding : {BitmaskRounding::up, BitmaskRounding::nearest}) {
      AoParams params = bitmask(weight, rounding);
      params.blur.kind = AoBlur::box;
      params.slices.spacing = AoSliceSpacing::angle;
      // Rounded up, a sample that lies above the plane by a rounding error covers a whole sector of 32.
      const double sector = rounding == BitmaskRounding::up ? 2.0 / 32.0 : 0.0;
      expect_open_plane(params, {{10, 0.01 + sector}, {30, 0.012 + sector}, {60, 0.02 + sector}, {85, 0.07 + sector}});
    }
  }
}

TEST_F(AoMethodsGl, The_bitmask_meets_its_integrals_beside_a_step) {
  AoParams params = bitmask(BitmaskWeight::cosine, BitmaskRounding::nearest);
  params.sampling.radius = 4.0;
  params.bitmask.thickness = 100.0;
  params.slices.slices = 8;
  params.slices.steps = 48;
  // ½(1 − d/√(d² + h²)), weighted by the cosine.
  EXPECT_NEAR(beside_step(params, 1.0), 0.853553, 0.012);
  EXPECT_NEAR(beside_step(params, 0.25), 0.621268, 0.012);
  // The mean over the azimuth of the elevation of the step's edge within the radius of 4 m, as a share of 180 degrees.
  params.bitmask.weight = BitmaskWeight::angle;
  {
    const double distance = 1.0;
    double blocked = 0.0;
    constexpr int parts = 10000;
    for (int i = 0; i < parts; ++i) {
      const double cosine = std::cos(pi * ((i + 0.5) / parts - 0.5));
      if (std::hypot(distance / cosine, 1.0) < 4.0) blocked += std::atan(cosine / distance) / parts;
    }
    EXPECT_NEAR(beside_step(params, distance), 1.0 - blocked / pi, 0.012);
  }
}

TEST_F(AoMethodsGl, Light_passes_behind_a_thin_surface_of_the_bitmask) {
  AoParams params = bitmask(BitmaskWeight::cosine, BitmaskRounding::nearest);
  params.sampling.radius = 4.0;
  params.slices.slices = 8;
  params.slices.steps = 24;
  double before = 2.0;
  for (const double thickness : {0.0, 0.05, 0.25}) {
    params.bitmask.thickness = thickness;
    const double ao = beside_step(params, 0.25);
    EXPECT_LT(ao, before - (thickness > 0.0 ? 0.01 : 0.0)) << thickness;
    before = ao;
  }
}

TEST_F(AoMethodsGl, An_open_plane_is_open_for_ray_marching_at_every_angle) {
  AoParams params = method(AoTechniques::choice<Marched>);
  params.sampling.samples = 8;
  expect_open_plane(params, {{10, 1e-6}, {30, 1e-6}, {60, 1e-6}, {85, 1e-6}});
}

TEST_F(AoMethodsGl, Ray_marching_meets_the_closed_form_beside_a_step) {
  AoParams params = method(AoTechniques::choice<Marched>);
  params.sampling.radius = 4.0;
  params.sampling.samples = 16;  // in each of the 16 pixels of the noise tile
  params.marched.steps = 256;
  const auto segment = [](double c) { return std::acos(c) - c * std::sqrt(1.0 - c * c); };
  for (const double distance : {0.25, 1.0}) {
    // Rays of length D beside a wall of height 1 at the distance d: c = d/D, a = d/√(d² + 1); O = (S(c) − a S(c/a))/π.
    const double c = distance / 4.0;
    const double a = distance / std::sqrt(distance * distance + 1.0);
    params.marched.weight = MarchedWeight::cosine;
    EXPECT_NEAR(beside_step(params, distance), 1.0 - (segment(c) - a * segment(c / a)) / pi, 0.012) << distance;
    // Without a limit, atan(h/d)/π; the limit of 4 m hides at most the lowest 0.015 of it.
    params.marched.weight = MarchedWeight::uniform;
    EXPECT_NEAR(beside_step(params, distance), 1.0 - std::atan(1.0 / distance) / pi + 0.005, 0.02) << distance;
  }
}

TEST_F(AoMethodsGl, The_bitmask_and_ray_marching_are_those_of_the_processor) {
  for (const auto weight : {BitmaskWeight::angle, BitmaskWeight::cosine}) {
    for (const auto rounding : {BitmaskRounding::up, BitmaskRounding::nearest}) {
      AoParams params = bitmask(weight, rounding);
      params.sampling.radius = 1.0;
      // Rounded up, the last bit of a plane's angle decides on a whole sector.
      expect_as_on_cpu(params, shared::BitmaskMethod{}, settings_of(std::get<Bitmask>(make_technique(params))),
                       rounding == BitmaskRounding::up ? 12 : 200);
    }
  }
  AoParams params = method(AoTechniques::choice<Marched>);
  params.sampling.radius = 1.0;
  for (const auto weight : {MarchedWeight::cosine, MarchedWeight::uniform}) {
    params.marched.weight = weight;
    for (const int steps : {3, 64}) {
      params.marched.steps = steps;
      expect_as_on_cpu(params, shared::MarchedMethod{}, settings_of(std::get<Marched>(make_technique(params))));
    }
  }
}

}  // namespace
}  // namespace umbrameter
