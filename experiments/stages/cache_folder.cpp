#include "experiments/stages/cache_folder.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "core/content_hash.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"

// An entry is a gzip file: a line with the scene, a line with what it is, the key, the content. Gzip's checksum covers
// all of it, and `zcat FILE | head` shows what a person can read.

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* entry_extension = ".reference";
constexpr const char* temporary_extension = ".tmp";
// A write takes moments: a temporary file of this age is left from a process that was killed.
constexpr auto abandoned_after = std::chrono::hours(24);
constexpr std::size_t title_characters = 200;

using GzFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

GzFile open_gzip(const fs::path& path, const char* mode) {
  GzFile file(gzopen(path.c_str(), mode), gzclose);
  if (file) gzbuffer(file.get(), 1 << 17);
  return file;
}

// Regular files only: opening a pipe would wait for its other end.
GzFile open_entry(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return {nullptr, gzclose};
  return open_gzip(path, "rb");
}

// Nothing where the file ends before the line does.
std::optional<std::string> read_line(const GzFile& file) {
  std::array<char, 4 * title_characters + 8> line;  // UTF-8 takes at most four bytes
  if (gzgets(file.get(), line.data(), static_cast<int>(line.size())) == nullptr) return {};
  std::string text = line.data();
  if (!text.ends_with('\n')) return {};
  text.pop_back();
  return text;
}

std::optional<CacheTitle> read_title(const GzFile& file) {
  const std::optional<std::string> scene = read_line(file);
  const std::optional<std::string> what = read_line(file);
  if (!scene || !what) return {};
  return CacheTitle{*scene, *what};
}

// All that is left; nothing where gzip's checksum or the end of the file is wrong.
std::optional<std::string> read_rest(const GzFile& file) {
  std::string rest;
  std::vector<char> block(1 << 20);
  while (const std::size_t count = gzfread(block.data(), 1, block.size(), file.get())) rest.append(block.data(), count);
  int state = Z_OK;
  gzerror(file.get(), &state);
  if (state != Z_OK) return {};
  return rest;
}

fs::path path_of(const CacheFolder& folder, const std::string& key) {
  return folder.path / (ContentHash().add(std::string_view(key)).hex() + entry_extension);
}

struct Item {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

// The last used first. Files that another process removes meanwhile are left out.
std::vector<Item> items(const CacheFolder& folder, const char* extension) {
  std::vector<Item> found;
  std::error_code end;
  for (fs::directory_iterator i(folder.path, end); !end && i != fs::directory_iterator(); i.increment(end)) {
    std::error_code error;
    if (i->path().extension() != extension || !fs::is_regular_file(i->symlink_status(error))) continue;
    Item item{i->path(), i->file_size(error), {}};
    if (!error) item.used = i->last_write_time(error);
    if (!error) found.push_back(std::move(item));
  }
  std::ranges::sort(found,
                    [](const Item& a, const Item& b) { return a.used != b.used ? a.used > b.used : a.path < b.path; });
  return found;
}

bool remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  return !error;
}

// After the write, so that of processes that write at the same time the last one sees all entries.
void remove_least_recently_used(const CacheFolder& folder) {
  std::uint64_t total = 0;
  for (const Item& item : items(folder, entry_extension)) {
    total += item.bytes;
    if (total > folder.limit) remove_file(item.path);
  }
  for (const Item& item : items(folder, temporary_extension)) {
    if (fs::file_time_type::clock::now() - item.used > abandoned_after) remove_file(item.path);
  }
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
  const GzFile file = open_entry(path);
  if (!file) return {};
  std::string stored_key(key.size(), '\0');
  std::optional<std::string> content;
  // zlib also reads files that are not compressed, without a checksum.
  if (gzdirect(file.get()) == 0 && read_title(file) &&
      gzfread(stored_key.data(), 1, key.size(), file.get()) == key.size() && stored_key == key) {
    content = read_rest(file);
  }
  if (!content) return {{}, path.string() + (remove_file(path) ? "" : " (it cannot be removed)")};
  // Where the folder cannot be written to, entries do not age.
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return {std::move(content), {}};
}

std::string store_entry(const CacheFolder& folder, const std::string& key, const CacheTitle& title,
                        const PiecesOfContent& content) {
  const std::string head =
      fmt::format("{}\n{}\n{}", shortened(title.scene, title_characters), shortened(title.what, title_characters), key);
  try {
    // With the rights that the specification asks for.
    if (fs::create_directories(folder.path)) fs::permissions(folder.path, fs::perms::owner_all);
    const fs::path path = path_of(folder, key);
    write_whole(path, [&](const fs::path& temporary) {
      // zlib's fastest level: the noise of sampled images shrinks hardly more by slower ones.
      GzFile file = open_gzip(temporary, "wb1");
      const auto write = [&](std::string_view piece) {
        if (!file || gzfwrite(piece.data(), 1, piece.size(), file.get()) != piece.size())
          throw_write_error(path, errno);
      };
      write(head);
      content(write);
      if (gzclose(file.release()) != Z_OK) throw_write_error(path, errno);
      if (fs::file_size(temporary) > folder.limit) throw std::length_error("it is larger than the limit of the cache");
    });
  } catch (const std::exception& problem) {
    return problem.what();
  }
  remove_least_recently_used(folder);
  return {};
}

std::vector<CacheListing> list_entries(const CacheFolder& folder) {
  std::vector<CacheListing> listings;
  for (const Item& item : items(folder, entry_extension)) {
    const GzFile file = open_entry(item.path);
    listings.push_back(
        {item.path.stem().string(), item.bytes, item.used, file ? read_title(file) : std::optional<CacheTitle>()});
  }
  return listings;
}

ClearedCache clear_entries(const CacheFolder& folder) {
  ClearedCache cleared;
  for (const Item& item : items(folder, entry_extension)) {
    if (!remove_file(item.path)) {
      ++cleared.left;
      continue;
    }
    ++cleared.entries;
    cleared.bytes += item.bytes;
  }
  for (const Item& item : items(folder, temporary_extension)) remove_file(item.path);
  return cleared;
}

}  // namespace umbrameter
