// Just enough JSON to write: every value is its text. Internal to scenes/gltf*.cpp.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace umbrameter::gltf {

using Json = std::string;
using Members = std::vector<std::pair<std::string_view, Json>>;

inline Json to_json(std::size_t value) { return std::to_string(value); }

/// The shortest text that reads back to the same bits; always a floating-point number, so that −0 keeps its sign.
inline Json to_json(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  Json json(text, result.ptr);
  if (json.find_first_of(".e") == Json::npos) json += ".0";
  return json;
}

inline Json to_json(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  Json json = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      json.append("\\u00").append(1, digits[byte >> 4u]).append(1, digits[byte & 15u]);
    } else {
      if (c == '"' || c == '\\') json += '\\';
      json += c;
    }
  }
  json += '"';
  return json;
}

inline Json object(const Members& members) {
  Json json = "{";
  for (const auto& [key, value] : members) {
    if (json.size() > 1) json += ',';
    json.append(to_json(key)).append(1, ':').append(value);
  }
  return json + "}";
}

inline Json array(const std::vector<Json>& items) {
  Json json = "[";
  for (const Json& item : items) {
    if (json.size() > 1) json += ',';
    json += item;
  }
  return json + "]";
}

}  // namespace umbrameter::gltf
