#include "reports/files/markup.h"

#include <algorithm>
#include <cstdint>

namespace umbrameter {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

// Length of the UTF-8 sequence at the start of text, 0 when it is none (RFC 3629: no overlong forms, no surrogates).
std::size_t sequence_length(std::string_view text) {
  const unsigned first = byte_at(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xC0u) != 0x80) return 0;
  }
  const unsigned second = byte_at(text, 1);
  const bool is_valid = !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F) &&
                        !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
  return is_valid ? length : 0;
}

}  // namespace

namespace {

// Whether a valid sequence is one of the characters that break lines, have no width, or change the direction of what
// follows, so that a text is not what it seems: U+061C, U+200B, U+200E, U+200F, U+2028 to U+202E, U+2060 to U+206F and
// U+FEFF. The joiners U+200C and U+200D spell words and emoji.
bool is_invisible(std::string_view sequence) {
  if (sequence == "\u061c" || sequence == "\ufeff") return true;
  if (sequence.size() != 3 || byte_at(sequence, 0) != 0xE2) return false;
  const unsigned code = (byte_at(sequence, 1) & 0x3Fu) << 6u | (byte_at(sequence, 2) & 0x3Fu);  // of U+2000 + code
  return code == 0x0B || code == 0x0E || code == 0x0F || (code >= 0x28 && code <= 0x2E) ||
         (code >= 0x60 && code <= 0x6F);
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length == 0 || is_invisible(text.substr(0, length))) {
      result += replacement;
      text.remove_prefix(std::max<std::size_t>(length, 1));
      continue;
    }
    const bool is_control =
        byte_at(text, 0) < 0x20 || text.front() == '\x7f' || (byte_at(text, 0) == 0xC2 && byte_at(text, 1) < 0xA0);
    result += is_control ? std::string_view(" ") : text.substr(0, length);
    text.remove_prefix(length);
  }
  return result;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
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
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8u | (k < count ? byte_at(bytes, i + k) : 0u);
    for (std::size_t k = 0; k < 4; ++k) result += k <= count ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return result;
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + to_base64(bytes);
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80; }));
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
