#include "core/error.h"

#include <algorithm>

namespace umbrameter {
namespace {

// Text from files and drivers may hold line breaks; the promise is one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

// A name or a value may come from a file and be of any length; then a message shows its beginning and its end.
// Components of paths have at most 255 bytes.
constexpr std::size_t longest_word = 255;
constexpr std::size_t longest_part = 1000;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80; }

std::string without_middle(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t begin = longest * 2 / 3;
  std::size_t end = text.size() - longest / 3;
  while (begin > 0 && continues_character(text[begin])) --begin;
  while (end < text.size() && continues_character(text[end])) ++end;
  return text.substr(0, begin) + "\u2026" + text.substr(end);
}

// Each word, then the whole.
std::string readable(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size() - 1) + 1;
    result += without_middle(text.substr(at, end - at), longest_word);
    at = end;
  }
  return without_middle(result, longest_part);
}

}  // namespace

Error::Error(ExitCode code, const std::string& what_failed, const std::string& why, const std::string& remedy)
    : std::runtime_error(
          one_line(readable(what_failed) + ": " + readable(why) + (remedy.empty() ? "" : "; " + readable(remedy)))),
      code_(code) {}

}  // namespace umbrameter
