// What to_glb() writes, load_gltf() reads back bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "gltf_files.h"
#include "scenes/gltf_emitter.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

using test::Bytes;
using test::load;
using test::TemporaryFolder;

template <class T>
bool equal_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class T>
void expect_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    EXPECT_EQ(a.textures[i].texels, b.textures[i].texels);
    EXPECT_EQ(a.textures[i].wrap_u, b.textures[i].wrap_u);
    EXPECT_EQ(a.textures[i].wrap_v, b.textures[i].wrap_v);
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_TRUE(equal_bits(a.materials[i].base_color, b.materials[i].base_color));
    for (const auto texture : texture_members) EXPECT_EQ(a.materials[i].*texture, b.materials[i].*texture);
    EXPECT_EQ(a.materials[i].alpha_mode, b.materials[i].alpha_mode);
    EXPECT_EQ(a.materials[i].alpha_cutoff, b.materials[i].alpha_cutoff);
    EXPECT_EQ(a.materials[i].double_sided, b.materials[i].double_sided);
    EXPECT_EQ(a.materials[i].metallic, b.materials[i].metallic);
    EXPECT_EQ(a.materials[i].roughness, b.materials[i].roughness);
    EXPECT_EQ(a.materials[i].specular, b.materials[i].specular);
    EXPECT_EQ(a.materials[i].specular_color, b.materials[i].specular_color);
  }
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
    EXPECT_EQ(a.meshes[i].material, b.meshes[i].material);
    expect_same_bits(a.meshes[i].positions, b.meshes[i].positions);
    expect_same_bits(a.meshes[i].normals, b.meshes[i].normals);
    expect_same_bits(a.meshes[i].texcoords, b.meshes[i].texcoords);
    expect_same_bits(a.meshes[i].triangles, b.meshes[i].triangles);
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) EXPECT_EQ(a.objects[i].name, b.objects[i].name);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].object, b.instances[i].object);
    EXPECT_TRUE(equal_bits(a.instances[i].world_from_mesh, b.instances[i].world_from_mesh));
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
    EXPECT_TRUE(equal_bits(a.cameras[i].world_from_camera, b.cameras[i].world_from_camera));
    ASSERT_EQ(a.cameras[i].projection.index(), b.cameras[i].projection.index());
    if (const auto* lens = std::get_if<PerspectiveProjection>(&a.cameras[i].projection)) {
      EXPECT_TRUE(equal_bits(*lens, std::get<PerspectiveProjection>(b.cameras[i].projection)));
    } else {
      EXPECT_TRUE(equal_bits(std::get<OrthographicProjection>(a.cameras[i].projection),
                             std::get<OrthographicProjection>(b.cameras[i].projection)));
    }
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].name, b.lights[i].name);
    EXPECT_TRUE(equal_bits(a.lights[i].world_from_light, b.lights[i].world_from_light));
    EXPECT_TRUE(equal_bits(a.lights[i].color, b.lights[i].color));
    EXPECT_EQ(a.lights[i].intensity, b.lights[i].intensity);
    EXPECT_EQ(gltf::emitter_extras(a.lights[i]), gltf::emitter_extras(b.lights[i]));
    ASSERT_EQ(a.lights[i].shape.index(), b.lights[i].shape.index());
    if (const auto* spot = std::get_if<SpotLight>(&a.lights[i].shape)) {
      EXPECT_TRUE(equal_bits(*spot, std::get<SpotLight>(b.lights[i].shape)));
    }
    if (const auto* point = std::get_if<PointLight>(&a.lights[i].shape)) {
      EXPECT_EQ(point->range, std::get<PointLight>(b.lights[i].shape).range);
    }
  }
  EXPECT_TRUE(b.notes.empty());
}

dmat4 awkward_pose(double seed) {
  return glm::rotate(glm::translate(dmat4(1.0), dvec3(seed / 3, -1e-7 * seed, 1e5 + seed / 7)), seed,
                     glm::normalize(dvec3(1, seed, -0.3)));
}

Mesh triangle(const std::string& name, std::uint32_t material, float size) {
  Mesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.positions = {{0.1f, -0.0f, 1e-30f}, {size / 3, 0, 0}, {0, size, 1.0f / 7}};
  mesh.triangles = {{2, 0, 1}};
  return mesh;
}

Scene everything() {
  Scene scene;
  scene.name = "every \"thing\" \\ \x01 ünï";
  scene.textures.resize(3);
  scene.textures[0] = {"holes", Image<glm::u8vec4>(7, 5), Wrap::clamp_to_edge, Wrap::mirrored_repeat};
  for (std::size_t i = 0; i < 35; ++i) {
    scene.textures[0].texels[i] = glm::u8vec4(i * 7, 255 - i, i * i % 256, i % 2 == 0 ? 0 : i * 3);
  }
  scene.textures[1] = {"", Image<glm::u8vec4>(1, 1, {1, 2, 3, 4}), Wrap::repeat, Wrap::repeat};
  scene.textures[2] = {"gloss", Image<glm::u8vec4>(2, 1, {5, 6, 7, 8}), Wrap::repeat, Wrap::clamp_to_edge};
  scene.materials.resize(3);
  scene.materials[0] = {"leaf",      {0.1f, 0.2f, 1.0f / 3, 1}, 1, AlphaMode::mask, 0.3f, true, 0.25f, 0.7f, 0.9f,
                        {1, 1.5f, 0}};
  scene.materials[1].alpha_mode = AlphaMode::blend;
  scene.materials[1].base_color_texture = 0;
  scene.materials[2].name = "plain";
  scene.materials[0].metallic_roughness_texture = 0;
  scene.materials[0].specular_texture = 2;
  scene.materials[2].specular_color_texture = 1;

  scene.meshes = {triangle("column", 2, 3), triangle("cap", 0, 1), triangle("", 1, 9), triangle("spare", 2, 2)};
  Mesh& rich = scene.meshes[1];
  rich.normals = std::vector<vec3>(3, glm::normalize(vec3(1, 2, 3)));
  rich.texcoords = {{-0.5f, 17.25f}, {0.1f, 0.2f}, {1, 1}};
  scene.objects = {{"pillar"}, {"pillar"}, {"sheet"}};
  scene.instances = {{0, 0, awkward_pose(1)},
                     {1, 0, awkward_pose(1)},
                     {0, 1, glm::scale(awkward_pose(2), dvec3(-1, 2, 0.1))},
                     {2, 2, dmat4(1.0)}};
  scene.instances[3].world_from_mesh[3][0] = -0.0;

  scene.cameras.resize(2);
  scene.cameras[0] = {"main", awkward_pose(3), PerspectiveProjection{0.7, 0.013, 1234.5}};
  scene.cameras[1] = {"", awkward_pose(4), OrthographicProjection{1.0 / 3, 2.0 / 3, 0, 17}};
  scene.lights.resize(3);
  scene.lights[0].world_from_light = awkward_pose(5);
  scene.lights[0].intensity = 1e5 / 3;
  scene.lights[1] = {"lamp", awkward_pose(6), {1, 0.5f, 0.1f}, 40, SpotLight{0, 0.1, pi / 4}};
  scene.lights[2] = {"lamp", awkward_pose(7), {0, 0, 0}, 0, PointLight{2.0 / 3}};
  scene.lights[0].emitter = DistantEmitter{1.0 / 97};
  scene.lights[2].emitter = RectangleEmitter{1.0 / 3, 17};
  return scene;
}

TEST(GltfRoundTrip, A_scene_with_everything_comes_back_bit_for_bit) {
  const TemporaryFolder folder;
  const Scene scene = everything();
  const Scene again = load(folder, to_glb(scene));
  expect_same(scene, again);
  EXPECT_EQ(to_glb(again), to_glb(scene));
}

TEST(GltfRoundTrip, An_infinite_far_plane_and_a_scene_of_lights_only_survive) {
  const TemporaryFolder folder;
  Scene scene;
  scene.name = "empty";
  scene.cameras.resize(1);
  scene.lights.resize(1);
  scene.lights[0].shape = PointLight{};
  const Scene again = load(folder, to_glb(scene));
  expect_same(scene, again);
  EXPECT_TRUE(std::isinf(std::get<PerspectiveProjection>(again.cameras.at(0).projection).far_plane));
}

TEST(GltfRoundTrip, Meshes_keep_their_numbers_when_objects_mix_them) {
  const TemporaryFolder folder;
  Scene scene;
  scene.name = "mixed";
  scene.materials.resize(1);
  for (int i = 0; i < 4; ++i)
    scene.meshes.push_back(triangle("m" + std::to_string(i), 0, 1.0f + static_cast<float>(i)));
  scene.objects = {{"a"}, {"b"}, {"c"}};
  for (const auto& [mesh, object] : {std::pair{3u, 0u}, {1u, 0u}, {1u, 1u}, {2u, 1u}, {2u, 2u}, {2u, 2u}}) {
    scene.instances.push_back({mesh, object, awkward_pose(object)});
  }
  expect_same(scene, load(folder, to_glb(scene)));
}

TEST(GltfRoundTrip, Meshes_with_more_than_65535_vertices_survive) {
  const TemporaryFolder folder;
  for (const std::uint32_t vertices : {65534u, 65535u, 65536u, 70000u}) {
    Scene scene;
    scene.name = "large";
    scene.materials.resize(1);
    Mesh mesh;
    // Squares modulo 11: no three in a row lie on a line.
    for (std::uint32_t i = 0; i < vertices; ++i) {
      mesh.positions.emplace_back(static_cast<float>(i), static_cast<float>((i % 11) * (i % 11) % 11), 0.0f);
    }
    mesh.triangles = {{0, 1, 2}, {vertices - 3, vertices - 2, vertices - 1}};
    scene.meshes.push_back(mesh);
    scene.objects = {{"one"}};
    scene.instances.push_back({});
    expect_same(scene, load(folder, to_glb(scene)));
  }
}

TEST(GltfWriter, The_file_is_laid_out_as_the_format_asks) {
  const Bytes bytes = to_glb(everything());
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(word(0), 0x46546C67u);
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), bytes.size());
  EXPECT_EQ(bytes.size() % 4, 0u);
  EXPECT_EQ(word(12) % 4, 0u);
  EXPECT_EQ(word(20 + word(12) + 4), 0x004E4942u);
  const std::string json(bytes.begin() + 20, bytes.begin() + 20 + word(12));
  EXPECT_NE(json.find(R"("min":[)"), std::string::npos);
  EXPECT_NE(json.find(R"("target":34963)"), std::string::npos);
  EXPECT_EQ(json.find("nan"), std::string::npos);
  EXPECT_EQ(json.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
