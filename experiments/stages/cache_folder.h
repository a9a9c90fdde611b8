// A folder of cached results with a size limit. Each entry is one file with a checksum, written to a temporary name and
// renamed. Processes, and machines with a common home folder, may share it without a lock. The program works without a
// cache, so failures are returned as text, not thrown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

struct CacheFolder {
  std::filesystem::path path;
  std::uint64_t limit = 2'000'000'000;  ///< bytes, of all entries together
};

/// The program's cache folder by the XDG base directory specification (0.8): in $XDG_CACHE_HOME if that is an absolute
/// path, otherwise in $HOME/.cache. Either argument may be nullptr. Empty if there is no home folder.
std::optional<std::filesystem::path> xdg_cache_folder(const char* xdg_cache_home, const char* home);

/// Description of an entry in listings.
struct CacheTitle {
  std::string scene;
  std::string what;  ///< "hard shadow of sun, camera arcade"
};

struct CacheRead {
  std::optional<std::string> content;
  std::string problem;  ///< why there is no content; empty if there is no entry
};

/// Loads the bytes stored under the key and marks the entry as just used. Removes a damaged entry.
CacheRead load_entry(const CacheFolder& folder, const std::string& key);

/// A function that passes content piece by piece to `write`.
using PiecesOfContent = std::function<void(const std::function<void(std::string_view)>& write)>;

/// Compresses and stores content under the key, and removes the least recently used entries beyond the limit. Returns
/// the reason if the content could not be stored, otherwise an empty text.
std::string store_entry(const CacheFolder& folder, const std::string& key, const CacheTitle& title,
                        const PiecesOfContent& content);

struct CacheListing {
  std::string name;  ///< 32 hexadecimal digits: the hash of the key
  std::uint64_t bytes = 0;
  std::filesystem::file_time_type used;  ///< last written or read
  std::optional<CacheTitle> title;       ///< empty if the file is damaged; its content is not checked
};

/// All entries, most recently used first.
std::vector<CacheListing> list_entries(const CacheFolder& folder);

struct ClearedCache {
  std::size_t entries = 0;
  std::uint64_t bytes = 0;
  std::size_t left = 0;  ///< number of entries that could not be removed
};

/// Removes all entries and the unfinished files of killed processes. Other files stay.
ClearedCache clear_entries(const CacheFolder& folder);

}  // namespace umbrameter
