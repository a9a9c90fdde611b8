#include "experiments/cache_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "experiments/content_hash.h"
#include "reports/files/output.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".reference";
// A write takes moments; a temporary file as old as this is left from one that was killed.
constexpr auto abandoned_after = std::chrono::hours(24);
constexpr auto lock_patience = std::chrono::seconds(5);

class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string reason(int error) { return std::generic_category().message(error); }

std::string name_of(const std::string& key) { return ContentHash().add(std::string_view(key)).hex(); }

fs::path path_of(const CacheFolder& folder, const std::string& key) {
  return folder.path / (name_of(key) + std::string(extension));
}

bool is_entry(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.size() == 32 + extension.size() && name.ends_with(extension) &&
         std::all_of(name.begin(), name.begin() + 32,
                     [](char c) { return std::string_view("0123456789abcdef").find(c) != std::string_view::npos; });
}

bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') && name.ends_with(".tmp");
}

// Of open_regular(): a folder, a link or a socket.
bool is_no_file(int error) { return error == EISDIR || error == ELOOP || error == ENXIO; }

// Opens regular files only, and never waits for a pipe's other end.
File open_regular(const fs::path& path, std::uint64_t& bytes, int& error) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
  error = descriptor < 0 ? errno : 0;
  struct stat status {};
  if (descriptor >= 0 && fstat(descriptor, &status) != 0) error = errno;
  if (error == 0 && !S_ISREG(status.st_mode)) error = EISDIR;
  bytes = static_cast<std::uint64_t>(status.st_size);
  return File(descriptor);
}

// At most `bytes`; less where the file ends or cannot be read on.
std::string read_bytes(const File& file, std::uint64_t bytes) {
  std::string content(static_cast<std::size_t>(bytes), '\0');
  std::size_t filled = 0;
  while (filled < content.size()) {
    const ssize_t got = read(file.get(), content.data() + filled, content.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  content.resize(filled);
  return content;
}

// Held by the one process that makes room and writes. The system releases it when its process ends.
class Lock {
 public:
  explicit Lock(const fs::path& path) : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    const auto until = std::chrono::steady_clock::now() + lock_patience;
    error_ = file_.get() < 0 ? errno : 0;
    while (error_ == 0 && flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK && errno != EINTR) error_ = errno;
      if (std::chrono::steady_clock::now() > until) error_ = ETIMEDOUT;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  /// errno of the step that failed, or 0.
  int error() const { return error_; }

 private:
  File file_;
  int error_ = 0;
};

struct Item {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

// Files that another process removes meanwhile are left out.
std::vector<Item> items(const CacheFolder& folder, bool (*wanted)(const fs::path&)) {
  std::vector<Item> found;
  std::error_code end;
  for (fs::directory_iterator i(folder.path, end); !end && i != fs::directory_iterator(); i.increment(end)) {
    std::error_code error;
    if (!wanted(i->path()) || !fs::is_regular_file(i->symlink_status(error)) || error) continue;
    Item item{i->path(), i->file_size(error), {}};
    if (!error) item.used = i->last_write_time(error);
    if (!error) found.push_back(std::move(item));
  }
  std::sort(found.begin(), found.end(),
            [](const Item& a, const Item& b) { return a.used != b.used ? a.used > b.used : a.path < b.path; });
  return found;
}

bool remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  return !error;
}

// So that `bytes` more, which replace what is at `path`, stay within the limit. Called under the lock.
void make_room(const CacheFolder& folder, const fs::path& path, std::uint64_t bytes) {
  for (const Item& item : items(folder, is_temporary)) {
    if (fs::file_time_type::clock::now() - item.used > abandoned_after) remove_file(item.path);
  }
  std::vector<Item> entries = items(folder, is_entry);
  std::uint64_t total = bytes;
  for (const Item& item : entries) total += item.path == path ? 0 : item.bytes;
  while (total > folder.limit && !entries.empty()) {
    const Item least = std::move(entries.back());
    entries.pop_back();
    if (least.path != path && remove_file(least.path)) total -= least.bytes;
  }
}

// With the rights that the specification asks for. Returns errno of the step that failed, or 0.
int make_folder(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return 0;
  if (path.has_relative_path()) {
    if (const int failed = make_folder(path.parent_path()); failed != 0) return failed;
  }
  if (mkdir(path.c_str(), 0700) == 0) return 0;
  if (errno != EEXIST) return errno;
  // Another process may have been faster.
  return fs::is_directory(path, error) ? 0 : ENOTDIR;
}

}  // namespace

std::optional<fs::path> xdg_cache_folder(const char* xdg_cache_home, const char* home) {
  for (const auto& [base, below] : {std::pair{xdg_cache_home, ""}, std::pair{home, ".cache"}}) {
    if (base == nullptr || !fs::path(base).is_absolute()) continue;
    return (fs::path(base) / below / "umbrameter").lexically_normal();
  }
  return {};
}

CacheRead load_entry(const CacheFolder& folder, const std::string& key) {
  const fs::path path = path_of(folder, key);
  std::uint64_t bytes = 0;
  int error = 0;
  const File file = open_regular(path, bytes, error);
  if (error == ENOENT || error == ENOTDIR) return {};
  if (error != 0 && !is_no_file(error)) return {{}, path.string() + ": " + reason(error)};
  CacheRead read{{}, "it is not a file"};
  if (error == 0) read = from_cache_file(key, read_bytes(file, bytes));
  if (read.entry) {
    // Where the folder cannot be written to, entries do not age.
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  } else {
    read.problem = path.string() + ": " + read.problem + (remove_file(path) ? "" : ", and cannot be removed");
  }
  return read;
}

std::string store_entry(const CacheFolder& folder, const std::string& key, const CacheEntry& entry) {
  const std::string bytes = to_cache_file(key, entry);
  if (bytes.size() > folder.limit) return "it is larger than the limit of the cache";
  if (const int error = make_folder(folder.path); error != 0) return folder.path.string() + ": " + reason(error);
  const Lock lock(folder.path / "lock");
  if (lock.error() != 0) return (folder.path / "lock").string() + ": " + reason(lock.error());
  const fs::path path = path_of(folder, key);
  make_room(folder, path, bytes.size());
  try {
    write_text(path, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::vector<CacheListing> list_entries(const CacheFolder& folder) {
  std::vector<CacheListing> listings;
  for (const Item& item : items(folder, is_entry)) {
    std::uint64_t bytes = 0;
    int error = 0;
    const File file = open_regular(item.path, bytes, error);
    CacheListing listing{item.path.stem().string(), item.bytes, item.used, {}};
    if (error == 0) listing.entry = peek_cache_file(read_bytes(file, std::min<std::uint64_t>(bytes, cache_head_bytes)));
    listings.push_back(std::move(listing));
  }
  return listings;
}

ClearedCache clear_entries(const CacheFolder& folder) {
  ClearedCache cleared;
  const Lock lock(folder.path / "lock");
  for (const Item& item : items(folder, is_entry)) {
    if (remove_file(item.path)) {
      ++cleared.entries;
      cleared.bytes += item.bytes;
    } else {
      ++cleared.left;
    }
  }
  if (lock.error() == 0) {
    for (const Item& item : items(folder, is_temporary)) remove_file(item.path);
  }
  return cleared;
}

}  // namespace umbrameter
