#include "reports/files/data_folder.h"

#include <cstdlib>
#include <system_error>

namespace umbrameter {

std::filesystem::path data_folder() {
  const char* given = std::getenv("UMBRAMETER_DATA");
  if (given != nullptr && *given != '\0') return given;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "umbrameter";
}

}  // namespace umbrameter
