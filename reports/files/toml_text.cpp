#include "reports/files/toml_text.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/input_file.h"

namespace umbrameter {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

// toml++ limits nested values, but neither the parts of a dotted key nor those of a table's name; each part is a table
// in a table, and such a chain is released by recursion. As many as toml++ allows of the former are enough of all.
constexpr std::size_t max_depth = TOML_MAX_NESTED_VALUES;

// The end of a string that begins at `at`, behind its quotes (TOML 1.0, "String").
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool is_long = text.substr(at, 3) == std::string(3, quote);
  const std::string_view end = text.substr(at, is_long ? 3 : 1);
  std::size_t i = at + end.size();
  while (i < text.size() && text.substr(i, end.size()) != end && (is_long || text[i] != '\n')) {
    i += quote == '"' && text[i] == '\\' ? 2u : 1u;
  }
  i = std::min(i + end.size(), text.size());
  // Up to two quotes before the closing ones are content.
  for (int n = 0; is_long && n < 2 && i < text.size() && text[i] == quote; ++n) ++i;
  return i;
}

// The line in which names and brackets are nested too deep; 0 if there is none. A dot of a number counts as one of a
// name.
std::size_t line_too_deep(std::string_view text) {
  std::vector<std::size_t> dots = {0};  // of the name that is read last, in each open bracket
  std::size_t depth = 0;                // all dots and brackets
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                  text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '\n') ++line;
    if (c == '.') {
      ++dots.back();
      ++depth;
    } else if (c == '[' || c == '{') {
      dots.push_back(0);
      ++depth;
    } else if ((c == ']' || c == '}') && dots.size() > 1) {
      depth -= dots.back() + 1;
      dots.pop_back();
    } else if (c == ',' || (c == '\n' && dots.size() == 1)) {
      depth -= dots.back();
      dots.back() = 0;
    }
    if (depth > max_depth) return line;
    ++i;
  }
  return 0;
}

}  // namespace

// TOML 1.0, "String": basic strings escape quote, backslash and control characters.
std::string toml_string(std::string_view text) {
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      result += "\\u00";
      result += digits[byte >> 4];
      result += digits[byte & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

toml::table parse_toml_file(const std::filesystem::path& path, const std::string& kind) {
  const std::string file = path.string();
  const std::string text = read_input(path, largest_file, "give " + kind);
  if (const std::size_t line = line_too_deep(text); line > 0) {
    throw Error(ExitCode::usage, file + ":" + std::to_string(line),
                "names and values are nested more than " + std::to_string(max_depth) + " levels deep",
                "correct that line");
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& problem) {
    throw Error(
        ExitCode::usage,
        file + ":" + std::to_string(problem.source().begin.line) + ":" + std::to_string(problem.source().begin.column),
        std::string(problem.description()), "correct that line");
  }
}

std::string place_of(const std::filesystem::path& path, const toml::node& node) {
  return path.string() + ":" + std::to_string(node.source().begin.line);
}

}  // namespace umbrameter
