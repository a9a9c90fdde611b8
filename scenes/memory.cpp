#include "scenes/memory.h"

namespace umbrameter {
namespace {

template <class T>
std::uint64_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

SceneBytes bytes_in_memory(const Scene& scene) {
  SceneBytes sum;
  for (const Mesh& mesh : scene.meshes) {
    sum.vertices += bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.texcoords);
    sum.indices += bytes(mesh.triangles);
  }
  sum.instances = bytes(scene.instances);
  for (const Texture& texture : scene.textures) sum.textures += bytes(texture.texels.pixels);
  return sum;
}

}  // namespace umbrameter
