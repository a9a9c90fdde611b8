#include "core/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/error.h"
#include "core/interrupt.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why, const std::string& remedy = {}) {
  throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), why, remedy);
}

[[noreturn]] void refuse(const fs::path& path, int error) { refuse(path, std::generic_category().message(error)); }

bool is_opened_by_shell(const fs::path& path) {
  const std::string text = path.lexically_normal().string();
  return text == "/dev/stdin" || text.starts_with("/dev/fd/") || text.starts_with("/proc/self/fd/");
}

// Of what may be read.
fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error) refuse(path, error.value());
  if (fs::is_directory(status)) refuse(path, EISDIR);
  const bool is_open_pipe = fs::is_fifo(status) && is_opened_by_shell(path);
  if (!fs::is_regular_file(status) && !is_open_pipe) {
    refuse(path, "it is not a regular file", "copy it to a file first");
  }
  return status.type();
}

class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : file_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~OpenFile() {
    if (file_ >= 0) close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int get() const { return file_; }

 private:
  int file_;
};

// The handlers of signals let system calls continue; therefore the flag is looked at between short waits.
void wait_for_data(int pipe) {
  constexpr int milliseconds = 100;
  pollfd waiting{pipe, POLLIN, 0};
  while (poll(&waiting, 1, milliseconds) <= 0) throw_if_interrupted();
}

}  // namespace

void require_regular_file(const fs::path& path) {
  if (type_of(path) != fs::file_type::regular) refuse(path, "it is not a regular file", "copy it to a file first");
}

std::string read_input(const fs::path& path, std::uintmax_t largest, const std::string& remedy) {
  const bool is_pipe = type_of(path) == fs::file_type::fifo;
  const OpenFile file(path);
  if (file.get() < 0) refuse(path, errno);
  std::error_code unknown_size;
  const std::uintmax_t size = is_pipe ? 0 : fs::file_size(path, unknown_size);
  // One byte more than expected, so that the end is seen without growing.
  constexpr std::size_t block = std::size_t{1} << 16;
  std::string bytes(unknown_size || is_pipe ? block : static_cast<std::size_t>(std::min(size, largest)) + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    throw_if_interrupted();
    const ssize_t count = ::read(file.get(), bytes.data() + used, bytes.size() - used);
    if (count < 0 && errno == EAGAIN) {
      wait_for_data(file.get());
    } else if (count < 0 && errno != EINTR) {
      refuse(path, errno);
    }
    if (count == 0) break;
    used += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    if (used > largest) {
      const std::string limit = std::to_string(largest >> 20u) + " MiB";
      refuse(path, "it is larger than " + limit, remedy);
    }
    if (used == bytes.size()) bytes.resize(2 * used);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace umbrameter
