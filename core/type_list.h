// A closed list of types, each with a static `name`. The choice among them, the table of their names and the dispatch
// derive from the list.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>
#include <variant>

namespace umbrameter {
namespace detail {
template <class Variant, class... Ts>
struct VariantWith {
  using Type = Variant;
};
template <class... Vs, class T, class... Ts>
struct VariantWith<std::variant<Vs...>, T, Ts...>
    : VariantWith<std::conditional_t<(std::is_same_v<T, Vs> || ...), std::variant<Vs...>, std::variant<Vs..., T>>,
                  Ts...> {};
}  // namespace detail

/// The variant with these alternatives added, each once.
template <class Variant, class... Ts>
using VariantWith = typename detail::VariantWith<Variant, Ts...>::Type;

template <class... Ts>
struct TypeList {
  /// Which type is chosen: its place in the list.
  enum class Choice : int {};

  template <class T>
  static constexpr Choice choice = [] {
    static_assert((std::is_same_v<T, Ts> || ...));
    int place = 0;
    static_cast<void>(((std::is_same_v<T, Ts> || (++place, false)) || ...));
    return Choice{place};
  }();

  static constexpr std::array<std::string_view, sizeof...(Ts)> names{Ts::name...};

  /// A variant of what Made gives for each type.
  template <template <class> class Made>
  using Variant = VariantWith<std::variant<>, Made<Ts>...>;

  /// What `function` returns for std::type_identity of the chosen type.
  template <class Result, class Function>
  static Result apply(Choice chosen, const Function& function) {
    using Call = Result (*)(const Function&);
    static constexpr Call calls[] = {[](const Function& each) -> Result { return each(std::type_identity<Ts>{}); }...};
    return calls[static_cast<std::size_t>(chosen)](function);
  }

  /// Calls `function` with std::type_identity of each type.
  template <class Function>
  static void for_each(const Function& function) {
    (function(std::type_identity<Ts>{}), ...);
  }
};

}  // namespace umbrameter
