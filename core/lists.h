// Lists: what is made of each item, and lists, counts and numbers as text.
#pragma once

#include <charconv>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace umbrameter {

/// What `each` gives for every item, in order; `each` may be a member: mapped(curves, &BiasCurve::error).
template <typename Items, typename Each>
auto mapped(Items&& items, Each&& each) {
  std::vector<std::decay_t<decltype(std::invoke(each, *std::begin(items)))>> result;
  result.reserve(static_cast<std::size_t>(std::distance(std::begin(items), std::end(items))));
  for (auto&& item : items) result.push_back(std::invoke(each, item));
  return result;
}

/// "a, b, c": the texts that `each` gives for the items.
template <typename Items, typename Each = std::identity>
std::string joined(const Items& items, std::string_view separator, Each&& each = {}) {
  std::string text;
  bool is_first = true;
  for (const auto& item : items) {
    if (!std::exchange(is_first, false)) text += separator;
    text += std::invoke(each, item);
  }
  return text;
}

/// The parts between separators; one, the text itself, where there is no separator.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// The number that the whole text is, as std::from_chars reads it; nothing for any other text.
template <typename Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The numbers of "1,2,3"; nothing if a part is no number.
template <typename Number>
std::optional<std::vector<Number>> parsed_list(std::string_view text, char separator) {
  std::vector<Number> numbers;
  for (const std::string& part : split(text, separator)) {
    const std::optional<Number> number = parsed<Number>(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// "1 cell" or "2 cells".
inline std::string count_text(std::size_t number, std::string_view noun) {
  return std::to_string(number).append(" ").append(noun).append(number == 1 ? "" : "s");
}

}  // namespace umbrameter
