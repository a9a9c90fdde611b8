#include "raster/gl/shader_cache.h"

#include <fcntl.h>
#include <pwd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace umbrameter::gl {
namespace {

namespace fs = std::filesystem;

// Where Mesa looks, in this order.
fs::path mesa_cache_folder() {
  for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"}) {
    if (const char* folder = std::getenv(name)) return folder;
  }
  const passwd* user = getpwuid(getuid());
  return user != nullptr && user->pw_dir != nullptr ? fs::path(user->pw_dir) / ".cache" : fs::path();
}

bool is_out_of_space(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

// False where there is no room. What cannot be opened for writing is no cache for Mesa either.
bool reserve_blocks(const fs::path& index) {
  const int file = open(index.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return true;
  const int error = posix_fallocate(file, 0, static_cast<off_t>(shader_cache_index_bytes));
  close(file);
  return !is_out_of_space(error);
}

// Of the nearest folder that exists; Mesa makes those below.
bool has_room(fs::path folder) {
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  const fs::space_info space = fs::space(folder, error);
  return error || space.available >= shader_cache_index_bytes;
}

}  // namespace

ShaderCacheGuard::ShaderCacheGuard() {
  const fs::path folder = mesa_cache_folder();
  const char* off = std::getenv("MESA_SHADER_CACHE_DISABLE");
  const bool is_off = off != nullptr && std::string_view(off) != "false" && std::string_view(off) != "0";
  if (folder.empty() || is_off) return;
  index_ = folder / "mesa_shader_cache" / "index";
  std::error_code error;
  if (fs::exists(index_, error) ? reserve_blocks(index_) : has_room(index_.parent_path())) return;
  note_ = "the driver's shader cache is not used, because there is no room for its index of 1.3 MB in " +
          folder.string() + ": shaders are compiled again";
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

void ShaderCacheGuard::reserve() const {
  if (!index_.empty() && note_.empty()) reserve_blocks(index_);
}

}  // namespace umbrameter::gl
