#include "reports/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

bool is_out_of_space(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

[[noreturn]] void throw_write_error(const fs::path& path, int error) {
  throw Error(ExitCode::partial, "cannot write " + path.string(), reason(error),
              is_out_of_space(error) ? "free some space or choose another folder" : "check the folder");
}

// Removes the file unless it was renamed away.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Beside the file, so that the rename stays in one file system; short, so that the name fits wherever the file's does.
fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() / fmt::format(".{:.200}.{}.tmp", path.filename().string(), getpid());
}

// errno of the first step that failed, or 0.
int write_bytes(const fs::path& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int error = 0;
  while (error == 0 && !bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (close(file) != 0 && error == 0) error = errno;
  return error;
}

// A disk may say only now that it is full. Files that cannot be flushed (devices, pipes) say EINVAL.
int flush(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = fsync(file) == 0 || errno == EINVAL ? 0 : errno;
  close(file);
  return error;
}

}  // namespace

void prepare_output_folder(const fs::path& folder) {
  const auto refuse = [&](int error) {
    if (is_out_of_space(error)) throw_write_error(folder, error);
    throw Error(ExitCode::usage, "cannot use " + folder.string() + " as output folder", reason(error),
                "choose another folder with -o");
  };
  std::error_code error;
  if (folder.empty()) refuse(ENOENT);
  fs::create_directories(folder, error);
  if (error) refuse(error.value());
  if (!fs::is_directory(folder, error)) refuse(ENOTDIR);
  const TemporaryFile trial(temporary_beside(folder / "trial"));
  // A block's worth: file systems hold a few bytes in the inode even when they are full.
  const int write_error = write_bytes(trial.path(), std::string(4096, ' '));
  if (write_error != 0) refuse(write_error);
  const int flush_error = flush(trial.path());
  if (flush_error != 0) refuse(flush_error);
}

void write_whole(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const TemporaryFile temporary(temporary_beside(path));
  write(temporary.path());
  const int flush_error = flush(temporary.path());
  if (flush_error != 0) throw_write_error(path, flush_error);
  std::error_code error;
  fs::rename(temporary.path(), path, error);
  if (error) throw_write_error(path, error.value());
}

void write_text(const fs::path& path, std::string_view text) {
  write_whole(path, [&](const fs::path& temporary) {
    const int error = write_bytes(temporary, text);
    if (error != 0) throw_write_error(path, error);
  });
}

}  // namespace umbrameter
