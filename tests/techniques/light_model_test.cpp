#include "techniques/shading/light_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace umbrameter {
namespace {

using shared::LightModel;
using shared::LightSource;
using shared::Reflection;
using shared::SurfacePoint;

Light point_light(const dvec3& position, double candela, double range = 0.0) {
  Light light;
  light.shape = PointLight{range};
  light.intensity = candela;
  light.color = {1.0f, 0.5f, 0.25f};
  light.world_from_light[3] = dvec4(position, 1.0);
  return light;
}

/// What a normalised integer with this many steps stores for a number from 0 to 1.
float quantized(float x, float steps) { return std::floor(x * steps + 0.5f) / steps; }

// Shines straight down.
Light down(Light light, decltype(Light::shape) shape) {
  light.shape = shape;
  const dvec4 position = light.world_from_light[3];
  light.world_from_light = dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, position);
  return light;
}

// A point of the floor, seen from above and aside.
SurfacePoint floor_point(const dvec3& position, const dvec3& eye) {
  SurfacePoint point{};
  point.position = vec3(position);
  point.normal = {0.0f, 1.0f, 0.0f};
  point.to_viewer = vec3(glm::normalize(eye - position));
  point.diffuse = {0.6f, 0.5f, 0.4f};
  point.specular = {0.2f, 0.3f, 0.4f};
  point.shininess = 40.0f;
  return point;
}

struct Terms {
  double diffuse, specular;
};

// The formulas of docs/shading.md for the floor, written again in double precision; red channel, light of red 1.
Terms expected(const SurfacePoint& p, const Light& light, const ShadingParams& params) {
  const dvec3 position(p.position);
  const bool is_sun = std::holds_alternative<DirectionalLight>(light.shape);
  const dvec3 offset = light.position() - position;
  const double d = glm::length(offset);
  const dvec3 to_light = is_sun ? -light.axis() : offset / d;
  double strength = light.intensity;
  double range = 0.0;
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    range = spot->range;
    const double cosine = glm::dot(-to_light, light.axis());
    if (params.spot_falloff == SpotFalloff::linear) {
      strength *= std::max(1.0 - std::acos(cosine) / spot->outer_cone_angle, 0.0);
    } else {
      const double scale = 1.0 / std::max(0.001, std::cos(spot->inner_cone_angle) - std::cos(spot->outer_cone_angle));
      const double edge = std::clamp((cosine - std::cos(spot->outer_cone_angle)) * scale, 0.0, 1.0);
      strength *= edge * edge;
    }
  } else if (const auto* point = std::get_if<PointLight>(&light.shape)) {
    range = point->range;
  }
  if (!is_sun && params.attenuation == Attenuation::inverse_square) {
    strength /= d * d;
    if (range > 0.0) strength *= std::clamp(1.0 - std::pow(d / range, 4.0), 0.0, 1.0);
  } else if (!is_sun) {
    strength *=
        range > 0.0 && d >= range ? 0.0 : 1.0 / (params.constant + params.linear * d + params.quadratic * d * d);
  }
  const dvec3 n(0.0, 1.0, 0.0);
  const dvec3 v(p.to_viewer);
  const double cosine = std::max(glm::dot(n, to_light), 0.0);
  if (cosine == 0.0) return {0.0, 0.0};
  const bool is_blinn = params.specular == SpecularModel::blinn_phong;
  const double exponent = is_blinn ? 40.0 : 10.0;
  const double lobe_cosine =
      is_blinn ? glm::dot(n, glm::normalize(to_light + v)) : glm::dot(2.0 * cosine * n - to_light, v);
  const double lobe = std::pow(std::max(lobe_cosine, 0.0), exponent);
  if (params.normalization == ShadingNormalization::none) {
    return {0.6 * strength * cosine, 0.2 * strength * lobe};
  }
  const double scale = is_blinn
                           ? (exponent + 2.0) * (exponent + 4.0) / (8.0 * pi * (std::exp2(-0.5 * exponent) + exponent))
                           : (exponent + 2.0) / (2.0 * pi);
  return {0.6 / pi * strength * cosine, 0.2 * scale * lobe * strength * cosine};
}

TEST(LightModel, A_plane_meets_the_formula_for_each_light_and_each_choice) {
  const dvec3 eye(3.0, 2.0, 4.0);
  Light sun = point_light({0, 3, 0}, 2.0);
  sun = down(sun, DirectionalLight{});
  const dvec3 z = glm::normalize(dvec3(0.3, 0.8, 0.5));  // against the way that the light travels
  const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  sun.world_from_light = dmat4(dmat3(x, glm::cross(z, x), z));
  const std::array<Light, 4> lights = {point_light({0.5, 2.0, -0.3}, 20.0), point_light({0.5, 2.0, -0.3}, 20.0, 5.0),
                                       down(point_light({0.2, 3.0, 0.1}, 30.0), SpotLight{8.0, 0.2, 0.6}), sun};
  int compared = 0;
  for (const Light& light : lights) {
    for (int choice = 0; choice < 16; ++choice) {
      ShadingParams params;
      params.specular = static_cast<SpecularModel>(choice & 1);
      params.normalization = static_cast<ShadingNormalization>(choice >> 1 & 1);
      params.attenuation = static_cast<Attenuation>(choice >> 2 & 1);
      params.spot_falloff = static_cast<SpotFalloff>(choice >> 3 & 1);
      params.linear = 0.3;
      for (int i = 0; i < 20; ++i) {
        const dvec3 position(-1.5 + 0.17 * i, 0.0, 0.9 * std::sin(1.7 * i));
        const SurfacePoint point = floor_point(position, eye);
        const Reflection found = reflect_light(point, light_source(light), light_model(params));
        const Terms terms = expected(point, light, params);
        EXPECT_NEAR(found.diffuse.x, terms.diffuse, 1e-5 * std::max(terms.diffuse, 1.0)) << choice << " " << i;
        EXPECT_NEAR(found.specular.x, terms.specular, 1e-5 * std::max(terms.specular, 1.0)) << choice << " " << i;
        if (terms.diffuse > 0.0) ++compared;
      }
    }
  }
  EXPECT_GT(compared, 900);
}

TEST(LightModel, A_normalised_lobe_reflects_all_light_at_normal_incidence) {
  // The reflected share of light from straight above, over all viewing directions.
  for (const SpecularModel specular : {SpecularModel::phong, SpecularModel::blinn_phong}) {
    for (const float shininess : {1.0f, 8.0f, 100.0f, 2048.0f}) {
      ShadingParams params;
      params.specular = specular;
      Light sun = down(point_light({0, 1, 0}, 1.0), DirectionalLight{});
      sun.color = vec3(1.0f);
      double sum = 0.0;
      constexpr int steps = 20000;
      for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) / steps * pi / 2;
        SurfacePoint point = floor_point({0, 0, 0}, {std::sin(theta), std::cos(theta), 0.0});
        point.shininess = shininess;
        point.specular = vec3(1.0f);
        const Reflection found = reflect_light(point, light_source(sun), light_model(params));
        sum += static_cast<double>(found.specular.x) * std::cos(theta) * std::sin(theta) * 2.0 * pi * (pi / 2) / steps;
      }
      EXPECT_NEAR(sum, 1.0, 2e-3) << shininess;
    }
  }
}

TEST(LightModel, The_power_and_the_arc_cosine_are_exact_to_floats) {
  double worst = 0.0;
  for (int i = 1; i <= 4000; ++i) {
    for (const float exponent : {1.0f, 2.5f, 40.0f, 512.0f, 2048.0f}) {
      const float base = static_cast<float>(i) / 4000.0f;
      const double exact = std::pow(static_cast<double>(base), static_cast<double>(exponent));
      if (exact < 1e-12) continue;
      worst = std::max(worst, std::abs(shared::power(base, exponent) - exact) / exact);
    }
  }
  EXPECT_LT(worst, 5e-6);
  EXPECT_EQ(shared::power(0.0f, 3.0f), 0.0f);
  EXPECT_EQ(shared::power(1.0f, 3.0f), 1.0f);
  for (int i = -1000; i <= 1000; ++i) {
    const float x = static_cast<float>(i) / 1000.0f;
    EXPECT_NEAR(shared::arc_cosine(x), std::acos(static_cast<double>(x)), 5e-7) << x;
  }
}

TEST(LightModel, Shininess_falls_with_roughness_and_reads_back) {
  EXPECT_FLOAT_EQ(shared::shininess_of(1.0f), 1.0f);
  EXPECT_FLOAT_EQ(shared::shininess_of(0.5f), 30.0f);
  EXPECT_FLOAT_EQ(shared::shininess_of(0.0f), 2048.0f);
  EXPECT_NEAR(shared::roughness_of(30.0f), 0.5f, 1e-6f);
  for (const float shininess : {1.0f, 3.0f, 200.0f, 2048.0f}) {
    const float code = quantized(shared::encoded_shininess(shininess), 255.0f);
    EXPECT_NEAR(shared::decoded_shininess(code) / shininess, 1.0f, 0.016f);
  }
}

TEST(GBufferEncoding, Octahedral_normals_read_back) {
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / 2000.0;
    const double angle = 2.39996 * i;
    const double r = std::sqrt(1.0 - z * z);
    const vec3 n(dvec3(r * std::cos(angle), r * std::sin(angle), z));
    const vec2 p = shared::octahedral_from_unit(n) * 0.5f + 0.5f;
    const vec2 stored(quantized(p.x, 65535.0f), quantized(p.y, 65535.0f));
    const vec3 back = shared::unit_from_octahedral(stored * 2.0f - 1.0f);
    worst = std::max(worst, static_cast<double>(glm::length(back - n)));
  }
  EXPECT_LT(worst, 6e-5);  // a step of 1/32768 along each axis, stretched by up to 2 at the edges
  EXPECT_GT(worst, 1e-6);
}

}  // namespace
}  // namespace umbrameter
