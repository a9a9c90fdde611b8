// How many bytes a scene takes, by part.
#pragma once

#include <cstdint>

#include "scenes/scene.h"

namespace umbrameter {

/// Bytes, computed from the numbers of elements and their sizes; what an allocator adds is not in it.
struct SceneBytes {
  std::uint64_t vertices = 0;  ///< positions, normals, texture coordinates
  std::uint64_t indices = 0;
  std::uint64_t instances = 0;
  std::uint64_t textures = 0;

  std::uint64_t total() const { return vertices + indices + instances + textures; }
};

/// In main memory, as a Scene holds it.
SceneBytes bytes_in_memory(const Scene& scene);

}  // namespace umbrameter
