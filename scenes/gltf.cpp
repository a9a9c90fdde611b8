#include "scenes/gltf.h"

#include "core/error.h"

namespace umbrameter {

Scene load_gltf(const std::filesystem::path& path) {
  throw Error(ExitCode::unreadable_input, path.string(), "this build reads no glTF", "build it with the glTF reader");
}

std::vector<unsigned char> to_glb(const Scene&) { return {}; }

}  // namespace umbrameter
