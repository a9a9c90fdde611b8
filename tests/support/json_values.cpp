#include "tests/support/json_values.h"

#include <algorithm>

namespace umbrameter::test {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

std::size_t end_of_text(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && is_blank(text[at])) ++at;
  return at;
}

}  // namespace

std::vector<JsonValue> json_values(std::string_view text) {
  std::vector<JsonValue> values;
  std::vector<std::size_t> open;  // objects and lists without their end yet, as indices into values
  std::size_t key = text.size();  // of the value to come
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (is_blank(c) || c == ',' || c == ':') {
      ++at;
      continue;
    }
    if (c == '}' || c == ']') {
      ++at;
      if (open.empty()) continue;
      values[open.back()].end = at;
      open.pop_back();
      continue;
    }
    JsonValue value{JsonValue::Kind::word, at, at + 1, std::min(key, at)};
    if (c == '"') {
      value.kind = JsonValue::Kind::text;
      value.end = end_of_text(text, at);
      const std::size_t next = skip_blanks(text, value.end);
      if (next < text.size() && text[next] == ':' && key == text.size()) {
        key = at;
        at = next + 1;
        continue;
      }
    } else if (c == '{' || c == '[') {
      value.kind = c == '{' ? JsonValue::Kind::object : JsonValue::Kind::list;
      value.end = text.size();
      open.push_back(values.size());
    } else {
      if (c == '-' || (c >= '0' && c <= '9')) value.kind = JsonValue::Kind::number;
      constexpr std::string_view enders = ",:]}[{\" \n\t\r";
      value.end = std::min(text.find_first_of(enders, at), text.size());
    }
    values.push_back(value);
    key = text.size();
    at = c == '{' || c == '[' ? at + 1 : value.end;
  }
  return values;
}

std::string with_value(std::string_view text, const JsonValue& value, std::string_view replacement) {
  return std::string(text.substr(0, value.begin)).append(replacement).append(text.substr(value.end));
}

std::string without_value(std::string_view text, const JsonValue& value) {
  std::size_t start = value.start;
  std::size_t end = skip_blanks(text, value.end);
  if (end < text.size() && text[end] == ',') {
    ++end;
  } else {
    while (start > 0 && is_blank(text[start - 1])) --start;
    if (start > 0 && text[start - 1] == ',') --start;
  }
  return std::string(text.substr(0, start)).append(text.substr(end));
}

}  // namespace umbrameter::test
