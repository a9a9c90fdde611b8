// Where the values of a JSON text stand in it, so that a test can put others in their place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace umbrameter::test {

/// One value of a JSON text. Members and items are listed after the object or list that holds them.
struct JsonValue {
  enum class Kind { object, list, text, number, word };
  Kind kind = Kind::word;
  std::size_t begin = 0;
  std::size_t end = 0;    ///< one past its last character
  std::size_t start = 0;  ///< where its key starts, or the value itself where it has none
};

/// Every value, in the order of the text. Of a text that is no JSON: some of what looks like values.
std::vector<JsonValue> json_values(std::string_view text);

/// The text with one value replaced.
std::string with_value(std::string_view text, const JsonValue& value, std::string_view replacement);

/// The text without one member or item, and without the comma that goes with it.
std::string without_value(std::string_view text, const JsonValue& value);

}  // namespace umbrameter::test
