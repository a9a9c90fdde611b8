// Mesa's cache of compiled shaders on a full disk. Mesa maps the index of that cache into memory, as a sparse file;
// where the disk has no room for a page of it, the write that touches the page ends the process by SIGBUS.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace umbrameter::gl {

/// Bytes of the index: a counter and 65536 keys of 20 bytes (Mesa 22.3, src/util/disk_cache.c).
inline constexpr std::uintmax_t shader_cache_index_bytes = 8 + 65536 * 20;

/// Keeps Mesa's index from ending the process. The constructor runs before a display is initialised: it allocates the
/// disk blocks of an existing index, or checks that a new one has room; without room it disables Mesa's cache.
/// reserve() runs after the display is initialised and allocates the blocks of a new index. Newer versions of Mesa,
/// whose cache has no such index, and other drivers are not affected.
class ShaderCacheGuard {
 public:
  ShaderCacheGuard();
  void reserve() const;
  /// Why Mesa does without its cache, one line; empty where it has it.
  const std::string& note() const { return note_; }

 private:
  std::filesystem::path index_;
  std::string note_;
};

}  // namespace umbrameter::gl
