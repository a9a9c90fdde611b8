// Plain values as bytes, and back: numbers, text, containers and structs, these field by field (Boost.PFR), so that no
// field can be forgotten. The bytes are those of this machine's numbers.
#pragma once

#include <array>
#include <boost/pfr.hpp>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/content_hash.h"
#include "core/image.h"

namespace umbrameter::archive {

/// A type whose value is not its fields gives, as a specialization, `Stored`, `to_stored(value)` and
/// `from_stored(stored)`.
template <class T>
struct StoredAs;

template <class T>
concept HasStored = requires {
  typename StoredAs<T>::Stored;
};

template <class T, template <class...> class Template>
inline constexpr bool is_a = false;
template <template <class...> class Template, class... Of>
inline constexpr bool is_a<Template<Of...>, Template> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t Count>
inline constexpr bool is_array<std::array<T, Count>> = true;
template <class T>
inline constexpr bool is_image = is_a<T, Image>;

template <class T>
concept Sequence = is_a<T, std::vector> || is_a<T, std::map> || is_a<T, std::set> || std::is_same_v<T, std::string>;
/// Values that stand one after the other, so that they can be copied at once.
template <class T>
concept PlainSequence = (is_a<T, std::vector> || std::is_same_v<T, std::string>)&&Plain<typename T::value_type> &&
                        !std::is_same_v<typename T::value_type, bool>;

class Writer {
 public:
  template <class T>
  Writer& put(const T& value) {
    if constexpr (HasStored<T>) {
      put(StoredAs<T>::to_stored(value));
    } else if constexpr (Plain<T>) {
      put_bytes(std::as_bytes(std::span(&value, 1)));
    } else if constexpr (PlainSequence<T>) {
      put(std::uint64_t{value.size()}).put_bytes(std::as_bytes(std::span(value)));
    } else if constexpr (Sequence<T>) {
      put(std::uint64_t{value.size()});
      for (const typename T::value_type& each : value) put(each);
    } else if constexpr (is_image<T>) {
      put(value.width).put(value.height).put(value.pixels);
    } else if constexpr (is_array<T>) {
      for (const auto& each : value) put(each);
    } else if constexpr (is_a<T, std::pair>) {
      put(value.first).put(value.second);
    } else if constexpr (is_a<T, std::optional>) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (is_a<T, std::variant>) {
      put(std::uint64_t{value.index()});
      std::visit([&](const auto& each) { put(each); }, value);
    } else {
      static_assert(std::is_aggregate_v<T>, "give it a specialization of StoredAs");
      boost::pfr::for_each_field(value, [&](const auto& field) { put(field); });
    }
    return *this;
  }
  std::string take() { return std::move(bytes_); }

 private:
  Writer& put_bytes(std::span<const std::byte> bytes) {
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return *this;
  }
  std::string bytes_;
};

/// Throws std::runtime_error where the bytes end too early.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    if constexpr (HasStored<T>) {
      return StoredAs<T>::from_stored(get<typename StoredAs<T>::Stored>());
    } else if constexpr (std::is_same_v<T, bool>) {
      return get<std::uint8_t>() != 0;
    } else {
      T value{};
      read(value);
      return value;
    }
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (HasStored<T> || std::is_same_v<T, bool>) {
      value = get<T>();
    } else if constexpr (Plain<T>) {
      std::memcpy(&value, take(sizeof value).data(), sizeof value);
    } else if constexpr (PlainSequence<T>) {
      const auto count = get<std::uint64_t>();
      constexpr std::size_t size = sizeof(typename T::value_type);
      if (count > bytes_.size() / size) throw_short();
      value.resize(count);
      const std::string_view from = take(count * size);
      if (count > 0) std::memcpy(value.data(), from.data(), from.size());
    } else if constexpr (is_a<T, std::vector>) {
      value.clear();  // a struct may come with some by default
      for (auto left = get<std::uint64_t>(); left > 0; --left) value.push_back(get<typename T::value_type>());
    } else if constexpr (is_a<T, std::set>) {
      for (auto left = get<std::uint64_t>(); left > 0; --left) value.insert(get<typename T::value_type>());
    } else if constexpr (is_a<T, std::map>) {
      for (auto left = get<std::uint64_t>(); left > 0; --left) {
        auto key = get<typename T::key_type>();
        value.insert_or_assign(std::move(key), get<typename T::mapped_type>());
      }
    } else if constexpr (is_image<T>) {
      read(value.width);
      read(value.height);
      read(value.pixels);
      const bool fits = value.width >= 0 && value.height >= 0 &&
                        value.size() == static_cast<std::size_t>(value.width) * static_cast<std::size_t>(value.height);
      if (!fits) throw std::runtime_error("an image has not as many pixels as its size says");
    } else if constexpr (is_array<T>) {
      for (auto& each : value) read(each);
    } else if constexpr (is_a<T, std::pair>) {
      read(value.first);
      read(value.second);
    } else if constexpr (is_a<T, std::optional>) {
      if (get<bool>()) value = get<typename T::value_type>();
    } else if constexpr (is_a<T, std::variant>) {
      read_alternative(value, get<std::uint64_t>(), std::make_index_sequence<std::variant_size_v<T>>());
    } else {
      boost::pfr::for_each_field(value, [&](auto& field) { read(field); });
    }
  }
  template <class T, std::size_t... Index>
  void read_alternative(T& value, std::uint64_t index, std::index_sequence<Index...>) {
    const bool is_known =
        ((index == Index && (value.template emplace<Index>(get<std::variant_alternative_t<Index, T>>()), true)) || ...);
    if (!is_known) throw std::runtime_error("a value is of no known kind");
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw_short();
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  [[noreturn]] static void throw_short() { throw std::runtime_error("it ends too early"); }

  std::string_view bytes_;
};

/// Adds what the bytes of a type depend on: the kinds and sizes of all its fields, in order. Of another version of a
/// struct the text differs.
template <class T>
void add_layout(std::string& layout) {
  if constexpr (HasStored<T>) {
    add_layout<typename StoredAs<T>::Stored>(layout);
  } else if constexpr (Plain<T>) {
    layout += std::is_enum_v<T> ? 'e' : std::is_floating_point_v<T> ? 'f' : std::is_arithmetic_v<T> ? 'i' : 'g';
    layout += std::to_string(sizeof(T));
  } else if constexpr (std::is_same_v<T, std::string>) {
    layout += 't';
  } else if constexpr (is_array<T>) {
    layout += 'a' + std::to_string(std::tuple_size_v<T>);
    add_layout<typename T::value_type>(layout);
  } else if constexpr (is_image<T>) {
    layout += 'p';
    add_layout<typename decltype(T::pixels)::value_type>(layout);
  } else if constexpr (is_a<T, std::map>) {
    layout += 'm';
    add_layout<typename T::key_type>(layout);
    add_layout<typename T::mapped_type>(layout);
  } else if constexpr (is_a<T, std::vector> || is_a<T, std::set> || is_a<T, std::optional>) {
    layout += is_a<T, std::optional> ? 'o' : 's';
    add_layout<typename T::value_type>(layout);
  } else if constexpr (is_a<T, std::pair>) {
    add_layout<typename T::first_type>(layout);
    add_layout<typename T::second_type>(layout);
  } else if constexpr (is_a<T, std::variant>) {
    layout += 'v';
    [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      (add_layout<std::variant_alternative_t<Index, T>>(layout), ...);
    }
    (std::make_index_sequence<std::variant_size_v<T>>());
  } else {
    layout += '{';
    [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      (add_layout<boost::pfr::tuple_element_t<Index, T>>(layout), ...);
    }
    (std::make_index_sequence<boost::pfr::tuple_size_v<T>>());
    layout += '}';
  }
}

}  // namespace umbrameter::archive
