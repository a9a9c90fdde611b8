#include "raster/gl/api.h"
#include "raster/uploaded_scene.h"
#include "tests/raster/test_scenes.h"

namespace umbrameter::testing_scenes {
namespace {

std::uint64_t size_of(const gl::Buffer& buffer) {
  GLint64 bytes = 0;
  glGetNamedBufferParameteri64v(buffer.name(), GL_BUFFER_SIZE, &bytes);
  return static_cast<std::uint64_t>(bytes);
}

using UploadedSceneGl = GlTest;

TEST_F(UploadedSceneGl, The_bytes_that_are_told_are_those_of_the_buffers) {
  Scene scene;
  add_mesh(scene, box(vec3(-1), vec3(1)));
  Mesh smooth = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  smooth.normals.assign(smooth.positions.size(), vec3(0, 0, 1));
  smooth.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::uint32_t placed = add_mesh(scene, smooth);
  // Five instances: no buffer is so short that it is padded.
  for (int i = 0; i < 3; ++i) scene.instances.push_back(scene.instances[placed]);
  scene.textures.push_back({"white", Image<glm::u8vec4>(2, 3, glm::u8vec4(255)), Wrap::repeat, Wrap::repeat});
  for (Material& material : scene.materials) material.base_color_texture = 0;
  const UploadedScene uploaded = upload(context(), scene);
  const SceneBytes told = bytes_when_uploaded(scene);
  EXPECT_EQ(told.vertices, size_of(uploaded.positions) + size_of(uploaded.normals) + size_of(uploaded.texcoords));
  EXPECT_EQ(told.indices, size_of(uploaded.triangles));
  EXPECT_EQ(told.instances, size_of(uploaded.instances) + size_of(uploaded.drawn_instances));
  EXPECT_EQ(told.textures, 24u);  // 2 · 3 texels of four bytes
}

}  // namespace
}  // namespace umbrameter::testing_scenes
