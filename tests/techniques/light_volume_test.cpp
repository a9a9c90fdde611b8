#include "techniques/shading/light_volume.h"

#include <gtest/gtest.h>

#include <map>

#include "techniques/shading/light_model.h"

namespace umbrameter {
namespace {

Light light_of(decltype(Light::shape) shape) {
  Light light;
  light.shape = shape;
  const dvec3 z = glm::normalize(dvec3(0.6, -0.4, 0.7));
  const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  light.world_from_light = dmat4(dmat3(x, glm::cross(z, x), z));
  light.world_from_light[3] = dvec4(3.0, 1.0, -2.0, 1.0);
  return light;
}

bool contains(const LightVolume& volume, const dvec3& p) {
  for (const uvec3& t : volume.triangles) {
    const dvec3 a(volume.positions[t.x]);
    const dvec3 normal = glm::cross(dvec3(volume.positions[t.y]) - a, dvec3(volume.positions[t.z]) - a);
    if (glm::dot(normal, p - a) > 0.0) return false;
  }
  return true;
}

double volume_of(const LightVolume& volume) {
  double sum = 0.0;
  const dvec3 origin(volume.positions.front());
  for (const uvec3& t : volume.triangles) {
    sum += glm::dot(dvec3(volume.positions[t.x]) - origin,
                    glm::cross(dvec3(volume.positions[t.y]) - origin, dvec3(volume.positions[t.z]) - origin)) /
           6.0;
  }
  return sum;
}

TEST(LightVolume, Encloses_all_that_the_light_reaches_and_little_more) {
  struct Case {
    Light light;
    double most_volume;  // of the exact shape's
  };
  const double range = 2.5;
  const double sphere = 4.0 / 3.0 * pi * range * range * range;
  const double angle = 0.5;
  const double cone = pi / 3.0 * std::pow(std::tan(angle) * range, 2.0) * range;
  for (const Case& c :
       {Case{light_of(PointLight{range}), 1.16 * sphere}, Case{light_of(SpotLight{range, 0.1, angle}), 1.02 * cone},
        Case{light_of(SpotLight{range, 0.1, 1.4}), 1.16 * sphere}}) {
    const std::optional<LightVolume> volume = light_volume(c.light);
    ASSERT_TRUE(volume);
    const shared::LightSource source = light_source(c.light);
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const dvec3 unit(std::fmod(i * 0.7548776662, 1.0), std::fmod(i * 0.5698402910, 1.0),
                       std::fmod(i * 0.3819660113, 1.0));
      const dvec3 p = c.light.position() + (unit * 2.0 - 1.0) * range;
      if (!shared::is_in_volume(vec3(p), source)) continue;
      ++inside;
      EXPECT_TRUE(contains(*volume, p));
    }
    EXPECT_GT(inside, 300);
    EXPECT_LT(volume_of(*volume), c.most_volume);
    EXPECT_GT(volume_of(*volume), 0.0);
  }
}

TEST(LightVolume, Is_closed) {
  for (const Light& light : {light_of(PointLight{1.0}), light_of(SpotLight{1.0, 0.0, 0.3})}) {
    std::map<std::pair<unsigned, unsigned>, int> edges;
    const std::optional<LightVolume> volume = light_volume(light);
    ASSERT_TRUE(volume);
    for (const uvec3& t : volume->triangles) {
      for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
  }
}

TEST(LightVolume, A_light_without_range_or_place_has_none) {
  EXPECT_FALSE(light_volume(light_of(DirectionalLight{})));
  EXPECT_FALSE(light_volume(light_of(PointLight{})));
  EXPECT_FALSE(light_volume(light_of(SpotLight{})));
}

}  // namespace
}  // namespace umbrameter
