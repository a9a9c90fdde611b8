// One cached result as one file: images, compressed, numbers, and a checksum over all of it.
#pragma once

#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/image.h"

namespace umbrameter {

/// The bits of an image of any plain pixel.
struct CachedImage {
  std::string name;
  int width = 0;
  int height = 0;
  int pixel_bytes = 0;
  std::vector<std::byte> pixels;  ///< width · height · pixel_bytes
};

template <class T>
CachedImage to_cached(const std::string& name, const Image<T>& image) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* bytes = reinterpret_cast<const std::byte*>(image.pixels.data());
  return {name, image.width, image.height, static_cast<int>(sizeof(T)), {bytes, bytes + image.size() * sizeof(T)}};
}

/// The image again; nothing where its pixels are of another size.
template <class T>
std::optional<Image<T>> from_cached(const CachedImage& cached) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (cached.pixel_bytes != static_cast<int>(sizeof(T))) return {};
  Image<T> image(cached.width, cached.height);
  if (!cached.pixels.empty()) std::memcpy(image.pixels.data(), cached.pixels.data(), cached.pixels.size());
  return image;
}

struct CacheEntry {
  std::string scene;  ///< for people
  std::string what;   ///< for people: "visibility of sun"
  std::vector<CachedImage> images;
  std::map<std::string, double> numbers;
};

/// The file's bytes. The key is kept in full, so that another key of equal hash is no hit.
std::string to_cache_file(const std::string& key, const CacheEntry& entry);

/// What reading gave: the entry, or why there is none.
struct CacheRead {
  std::optional<CacheEntry> entry;
  std::string problem;
};

/// Any byte that is not as written, a byte too many or too few, another version or another key is a problem.
CacheRead from_cache_file(const std::string& key, std::string_view bytes);

/// The most bytes at the head of a file that peek_cache_file() looks at.
inline constexpr std::size_t cache_head_bytes = 65536;

/// Scene and description from the head of a file, unchecked and without images; for lists.
std::optional<CacheEntry> peek_cache_file(std::string_view head);

}  // namespace umbrameter
