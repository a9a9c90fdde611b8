// What the built-in scenes of alpha-masked things promise.
#include <gtest/gtest.h>

#include <map>
#include <variant>

#include "scenes/builtin.h"

namespace umbrameter {
namespace {

std::map<std::string, Bounds> object_bounds(const Scene& scene) {
  std::map<std::string, Bounds> bounds;
  for (const Instance& instance : scene.instances) {
    for (const vec3& position : scene.meshes[instance.mesh].positions) {
      bounds[scene.objects[instance.object].name].include(
          dvec3(instance.world_from_mesh * dvec4(dvec3(position), 1.0)));
    }
  }
  return bounds;
}

TEST(Fence, Has_a_mask_and_a_geometric_twin_of_one_size_and_every_kind_of_light) {
  const auto bounds = object_bounds(load_scene("fence"));
  const Bounds& mask = bounds.at("fence mask");
  const Bounds& geometry = bounds.at("fence geometry");
  // 320 × 192 texels of 1/128 m; the heads of the pickets stay 5 texels below the upper edge.
  EXPECT_NEAR(mask.extent().x, 2.5, 1e-6);
  EXPECT_NEAR(mask.extent().y, 1.5, 1e-6);
  EXPECT_NEAR(geometry.extent().x, 2.5, 1e-6);
  EXPECT_NEAR(geometry.extent().y, 187.0 / 128.0, 1e-6);
  EXPECT_EQ(mask.min.y, geometry.min.y);
  const Scene scene = load_scene("fence");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(scene.lights[0].shape));
  EXPECT_TRUE(std::holds_alternative<SpotLight>(scene.lights[1].shape));
  EXPECT_TRUE(std::holds_alternative<PointLight>(scene.lights[2].shape));
}

TEST(Fence, Has_as_much_area_of_bars_as_its_mask_has_opaque_texels) {
  const Scene scene = load_scene("fence");
  std::size_t opaque = 0;
  for (const glm::u8vec4& texel : scene.textures.at(0).texels.pixels) {
    ASSERT_TRUE(texel.w == 0 || texel.w == 255);
    if (texel.w == 255) ++opaque;
  }
  double area = 0.0;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.name != "fence geometry") continue;
    for (const uvec3& t : mesh.triangles) {
      const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
  }
  EXPECT_NEAR(area, static_cast<double>(opaque) / (128.0 * 128.0), 1e-9);
}

TEST(Foliage, Casts_through_masked_leaves_on_a_plain_wall) {
  const Scene scene = load_scene("foliage");
  std::uint64_t cards = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode == AlphaMode::mask) cards += mesh.triangles.size() / 2;
  }
  EXPECT_GE(cards, 1000u);
  EXPECT_EQ(object_bounds(scene).at("wall").max.z, 0.0);
}

}  // namespace
}  // namespace umbrameter
