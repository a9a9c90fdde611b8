#include "reports/files/toml_text.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

std::string read_text(const std::filesystem::path& path, const std::string& kind) {
  const auto refuse = [&](int error) {
    throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), std::generic_category().message(error));
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(EISDIR);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(errno);
  // Devices and pipes may never end.
  std::string text(largest_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse(EIO);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest_file) {
    throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), "it is larger than 1 MiB", "give " + kind);
  }
  return text;
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
  const std::string text = read_text(path, kind);
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
