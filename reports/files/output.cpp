#include "reports/files/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

bool is_out_of_space(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

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
  return path.parent_path() / fmt::format(".{:.160}.{}.{}.tmp", path.filename().string(), host_name(), getpid());
}

// The process on this host that a temporary file is of; nothing for other files.
std::optional<pid_t> writer_of(const fs::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with('.') || !name.ends_with(".tmp")) return {};
  const std::string stem = name.substr(0, name.size() - 4);
  if (!stem.substr(0, stem.rfind('.')).ends_with("." + host_name())) return {};
  const std::optional<pid_t> process = parsed<pid_t>(stem.substr(stem.rfind('.') + 1));
  return process && *process > 0 ? process : std::nullopt;
}

// A file that is written from its beginning. Remembers errno of the first step that failed, and does nothing then.
class OutputFile {
 public:
  explicit OutputFile(const fs::path& path)
      : file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)), error_(file_ < 0 ? errno : 0) {}
  ~OutputFile() { finish(); }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  int write(std::string_view bytes) {
    while (error_ == 0 && !bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    return error_;
  }

  int finish() {
    if (file_ >= 0 && close(file_) != 0 && error_ == 0) error_ = errno;
    file_ = -1;
    return error_;
  }

 private:
  int file_;
  int error_;
};

// errno of the first step that failed, or 0.
int write_bytes(const fs::path& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  return file.finish();
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

std::optional<std::string> text_of_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? fmt::format("{:.60}", name.data()) : "";
}

void throw_write_error(const fs::path& path, int error) {
  throw Error(ExitCode::partial, "cannot write " + path.string(), std::generic_category().message(error),
              is_out_of_space(error) ? "free some space or choose another folder" : "check the folder");
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

void prepare_output_folder(const fs::path& folder) {
  const auto refuse = [&](int error) {
    if (is_out_of_space(error)) throw_write_error(folder, error);
    throw Error(ExitCode::usage, "cannot use " + folder.string() + " as output folder",
                std::generic_category().message(error), "choose another folder with -o");
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

void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to) {
  write_whole(to, [&](const std::filesystem::path& temporary) {
    std::error_code error;
    std::filesystem::copy_file(from, temporary, std::filesystem::copy_options::overwrite_existing, error);
    if (error) throw_write_error(to, error.value());
  });
}

void write_text(const fs::path& path, std::string_view text) {
  write_whole(path, [&](const fs::path& temporary) {
    const int error = write_bytes(temporary, text);
    if (error != 0) throw_write_error(path, error);
  });
}

void write_pieces(const fs::path& path, const std::function<void(const std::function<void(std::string_view)>&)>& fill) {
  write_whole(path, [&](const fs::path& temporary) {
    OutputFile file(temporary);
    fill([&](std::string_view text) {
      if (const int error = file.write(text); error != 0) throw_write_error(path, error);
    });
    if (const int error = file.finish(); error != 0) throw_write_error(path, error);
  });
}

void remove_abandoned(const fs::path& folder) {
  std::error_code end;
  for (fs::directory_iterator i(folder, end); !end && i != fs::directory_iterator(); i.increment(end)) {
    const std::optional<pid_t> writer = writer_of(i->path());
    std::error_code ignored;
    if (writer && kill(*writer, 0) != 0 && errno == ESRCH) fs::remove(i->path(), ignored);
  }
}

}  // namespace umbrameter
