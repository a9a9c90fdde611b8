// What a caller of the loader may set beside the scene itself.
#pragma once

#include <cstdint>
#include <optional>

namespace umbrameter {

struct LoadOptions {
  /// The most that the contents of a file may take in memory, bytes. Empty: 1 GiB and 64 times the bytes of the file
  /// and of the files that it refers to.
  std::optional<std::uint64_t> memory{};
  /// Whether the alpha of alpha-blended materials makes holes. Then a texture of theirs that cannot be decoded is an
  /// error, as it is with an alpha mask; otherwise such a material goes without its texture, with a note.
  bool blend_makes_holes = false;
  /// Whether the textures of metallic, roughness and specular reflection are decoded, which only shading reads.
  /// Otherwise materials have their factors alone.
  bool materials = false;
};

}  // namespace umbrameter
