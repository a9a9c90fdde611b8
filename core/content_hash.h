// A 128-bit hash that detects changed content: XXH3 (Collet, xxHash 0.8).
// It detects accidents, not forgery.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace umbrameter {

/// Types that can be hashed by their bytes: numbers, enums, and GLM's packed vectors and matrices.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> ||(std::is_trivially_copyable_v<T>&& requires {
  typename T::value_type;
  T::length();
});

/// Hashes content piece by piece, by its bits: 0.0 and -0.0 have different hashes.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  ContentHash& add_bytes(std::span<const std::byte> bytes);
  template <Plain T>
  ContentHash& add(const T& value) {
    return add_bytes(std::as_bytes(std::span(&value, 1)));
  }
  /// Includes the length, so that ("ab", "c") and ("a", "bc") have different hashes.
  ContentHash& add(std::string_view text);
  template <Plain T>
  ContentHash& add(const std::vector<T>& values) {
    return add(values.size()).add_bytes(std::as_bytes(std::span(values)));
  }

  /// 32 hexadecimal digits.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbrameter
