#include "reports/files/markup.h"

#include <glib.h>

#include <algorithm>
#include <memory>

namespace umbrameter {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";
constexpr gunichar last_character = 0x10FFFF;

// The character at the start of a text that is not empty; above the last one where the bytes are no UTF-8.
gunichar first_character(std::string_view text) {
  return text.front() == '\0' ? 0 : g_utf8_get_char_validated(text.data(), static_cast<gssize>(text.size()));
}

// Characters that break lines, have no width, or change the direction of what follows, so that a text is not what it
// seems. The joiners U+200C and U+200D spell words and emoji.
bool is_invisible(gunichar c) {
  return c == 0x061C || c == 0x200B || c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF;
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const gunichar c = first_character(text);
    const bool is_valid = c <= last_character;
    const std::size_t length = is_valid ? static_cast<std::size_t>(g_unichar_to_utf8(c, nullptr)) : 1;
    const bool is_control = c < 0x20 || (c >= 0x7F && c < 0xA0);
    result += !is_valid || is_invisible(c) ? replacement : is_control ? " " : text.substr(0, length);
    text.remove_prefix(length);
  }
  return result;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const gunichar c = first_character(text);
    if (c > last_character) return false;
    text.remove_prefix(static_cast<std::size_t>(g_unichar_to_utf8(c, nullptr)));
  }
  return true;
}

std::string replace_all(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

std::string escape_markup(std::string_view text) {
  std::string result;
  for (const char c : plain_text(text)) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (c == '\'') {
      result += "&#39;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string to_base64(std::string_view bytes) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(
      g_base64_encode(reinterpret_cast<const guchar*>(bytes.data()), bytes.size()), &g_free);
  return text.get();
}

std::string from_base64(const std::string& text) {
  gsize size = 0;
  const std::unique_ptr<guchar, decltype(&g_free)> bytes(g_base64_decode(text.c_str(), &size), &g_free);
  return {reinterpret_cast<const char*>(bytes.get()), size};
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + to_base64(bytes);
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80; }));
}

double text_width(std::string_view text) {
  double width = 0.0;
  for (const char c : text) {
    const bool is_continuation = (static_cast<unsigned char>(c) & 0xC0u) == 0x80;
    if (is_continuation) continue;
    width += std::string_view("fijlrt .,:;|!'()[]-").find(c) != std::string_view::npos ? 0.36
             : std::string_view("mwMW@%").find(c) != std::string_view::npos            ? 0.95
                                                                                       : 0.63;
  }
  return width;
}

}  // namespace umbrameter
