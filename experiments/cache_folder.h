// A folder of cached results with a limit on its size: one file per entry, which appears whole by a rename and carries
// a checksum. Processes, and machines with a common home folder, may share it without a lock. A cache is never
// needed: what fails is returned as text, not thrown.
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

/// Where the XDG base directory specification (0.8) puts the program's cache: in $XDG_CACHE_HOME if that is an
/// absolute path, else in $HOME/.cache. Either may be nullptr. Nothing without a home folder.
std::optional<std::filesystem::path> xdg_cache_folder(const char* xdg_cache_home, const char* home);

/// What an entry is, for people.
struct CacheTitle {
  std::string scene;
  std::string what;  ///< "visibility of sun"
};

struct CacheRead {
  std::optional<std::string> content;
  std::string problem;  ///< why there is no content; empty if there is no entry
};

/// The bytes stored under that key; the entry then counts as just used. A damaged entry is removed.
CacheRead load_entry(const CacheFolder& folder, const std::string& key);

/// Gives content piece by piece to the function in its argument.
using PiecesOfContent = std::function<void(const std::function<void(std::string_view)>& write)>;

/// Stores content, compressed, under that key, and removes the least recently used entries beyond the limit. Returns
/// why they are not stored; empty if they are.
std::string store_entry(const CacheFolder& folder, const std::string& key, const CacheTitle& title,
                        const PiecesOfContent& content);

struct CacheListing {
  std::string name;  ///< 32 hexadecimal digits: the hash of the key
  std::uint64_t bytes = 0;
  std::filesystem::file_time_type used;  ///< last written or read
  std::optional<CacheTitle> title;       ///< nothing if the file is damaged; its content is not checked
};

/// All entries, the last used first.
std::vector<CacheListing> list_entries(const CacheFolder& folder);

struct ClearedCache {
  std::size_t entries = 0;
  std::uint64_t bytes = 0;
  std::size_t left = 0;  ///< that could not be removed
};

/// Removes all entries and what killed processes left half-written; other files stay.
ClearedCache clear_entries(const CacheFolder& folder);

}  // namespace umbrameter
