#include <string>

#include "core/error.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/api.h"
#include "tests/raster/test_scenes.h"

namespace umbrameter::testing_scenes {
namespace {

std::uint64_t size_of(const gl::Buffer& buffer) {
  GLint64 bytes = 0;
  glGetNamedBufferParameteri64v(buffer.name(), GL_BUFFER_SIZE, &bytes);
  return static_cast<std::uint64_t>(bytes);
}

using UploadedSceneGl = GlTest;

// A texture of one texel.
std::uint32_t add_textured_material(Scene& scene, glm::u8vec4 texel) {
  Texture texture;
  texture.texels = Image<glm::u8vec4>(1, 1, texel);
  scene.textures.push_back(texture);
  Material material;
  material.base_color_texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

TEST_F(UploadedSceneGl, The_bytes_that_are_told_are_those_of_the_buffers) {
  Scene scene;
  add_mesh(scene, box(vec3(-1), vec3(1)));
  Mesh smooth = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  smooth.normals.assign(smooth.positions.size(), vec3(0, 0, 1));
  smooth.texcoords.assign(smooth.positions.size(), vec2(0));
  const std::uint32_t placed = add_mesh(scene, smooth);
  scene.instances.resize(4, Instance(scene.instances[placed]));
  const std::uint32_t textured = add_textured_material(scene, {255, 255, 255, 255});
  scene.meshes.back().material = textured;
  const UploadedScene uploaded = upload(context(), scene);
  const SceneBytes told = bytes_when_uploaded(scene);
  EXPECT_EQ(told.vertices, size_of(uploaded.positions) + size_of(uploaded.normals) + size_of(uploaded.texcoords));
  EXPECT_EQ(told.indices, size_of(uploaded.triangles));
  EXPECT_EQ(told.instances, size_of(uploaded.instances) + size_of(uploaded.drawn_instances));
  EXPECT_EQ(told.textures, 4u);
}

TEST_F(UploadedSceneGl, Normals_and_texture_coordinates_stay_with_their_meshes) {
  // Three quads side by side in the plane z = 0: without either, with a tilted normal, with a texture of two texels.
  Scene scene;
  const vec3 tilted = glm::normalize(vec3(0.6f, 0.0f, 0.8f));
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(i);
    Mesh mesh = quad({x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0});
    if (i == 1) mesh.normals.assign(mesh.positions.size(), tilted);
    if (i > 0) mesh.texcoords.assign(mesh.positions.size(), vec2(0.75f, 0.5f));
    add_mesh(scene, mesh);
  }
  scene.meshes[2].material = add_textured_material(scene, {});
  scene.textures[0].texels = Image<glm::u8vec4>(2, 1, glm::u8vec4(255, 0, 0, 255));
  scene.textures[0].texels.at(1, 0) = {0, 255, 0, 255};
  const UploadedScene uploaded = upload(context(), scene);
  const View view = orthographic_view(90, 30, {1.5, 0.5, 5}, {1.5, 0.5, 0}, 0.5);
  const GBuffer gbuffer = read_back(context(), draw_gbuffer(context(), uploaded, view));
  const auto at = [&](int quad_index) { return gbuffer.instance.index(30 * quad_index + 15, 12); };
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(gbuffer.instance[at(static_cast<int>(i))], i);
  EXPECT_EQ(gbuffer.shading_normal[at(0)], vec3(0, 0, 1));
  EXPECT_LT(glm::length(gbuffer.shading_normal[at(1)] - tilted), 1e-6f);
  EXPECT_EQ(gbuffer.shading_normal[at(2)], vec3(0, 0, 1));
  EXPECT_EQ(gbuffer.albedo[at(1)], vec3(scene.materials[1].base_color));
  EXPECT_EQ(gbuffer.albedo[at(2)], vec3(0, 1, 0));
}

TEST_F(UploadedSceneGl, More_instances_than_a_buffer_holds_are_an_error_that_says_so) {
  const std::size_t most = context().max_storage_bytes() / 128;  // 96 bytes of matrix, three numbers, alignment
  if (most > 4'000'000) GTEST_SKIP() << "room for " << most;
  Scene scene;
  const std::uint32_t placed = add_mesh(scene, quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  scene.instances.assign(most + 1, Instance(scene.instances[placed]));
  try {
    upload(context(), scene);
    FAIL() << "uploaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_backend);
    EXPECT_NE(std::string(error.what()).find(std::to_string(most + 1) + " instances do not fit"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace umbrameter::testing_scenes
