// A folder of cached results with a limit on its size. Several processes may use it at once: entries appear whole, by
// a rename, and only one process at a time makes room. It is never needed: what fails is told, not thrown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cache_file.h"

namespace umbrameter {

struct CacheFolder {
  std::filesystem::path path;
  std::uint64_t limit = 2'000'000'000;  ///< bytes, of all entries together
};

/// Where the XDG base directory specification (0.8) puts the program's cache: in $XDG_CACHE_HOME when that is an
/// absolute path, else in $HOME/.cache. Either may be nullptr. Nothing when there is no home either.
std::optional<std::filesystem::path> xdg_cache_folder(const char* xdg_cache_home, const char* home);

/// The entry of that key, which then counts as just used. A damaged one is removed and told of in `problem`; both are
/// empty when there is none.
CacheRead load_entry(const CacheFolder& folder, const std::string& key);

/// Keeps an entry; the least recently used ones go where the limit asks for it. Returns why it is not kept; empty when
/// it is.
std::string store_entry(const CacheFolder& folder, const std::string& key, const CacheEntry& entry);

struct CacheListing {
  std::string name;  ///< 32 hexadecimal digits: the hash of the key
  std::uint64_t bytes = 0;
  std::filesystem::file_time_type used;  ///< last written or read
  std::optional<CacheEntry> entry;       ///< without images; nothing where the file is damaged
};

/// All entries, the last used first.
std::vector<CacheListing> list_entries(const CacheFolder& folder);

struct ClearedCache {
  std::size_t entries = 0;
  std::uint64_t bytes = 0;
  std::size_t left = 0;  ///< that could not be removed
};

/// Removes all entries and what broken-off writes have left; other files stay.
ClearedCache clear_entries(const CacheFolder& folder);

}  // namespace umbrameter
