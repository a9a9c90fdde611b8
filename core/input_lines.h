// Lines of stdin or another descriptor, for processes that answer requests. A signal ends the wait for the next line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace umbrameter {

class InputLines {
 public:
  /// The descriptor stays open. A line has at most `max_line` bytes.
  InputLines(int descriptor, std::size_t max_line) : descriptor_(descriptor), max_line_(max_line) {}

  /// The next line without its end; nothing at the end of the input. Of a longer line its first max_line + 1 bytes.
  /// Throws Error when SIGINT or SIGTERM arrives.
  std::optional<std::string> next();

 private:
  int descriptor_;
  std::size_t max_line_;
  std::string read_;  // not yet returned
  bool is_at_end_ = false;
};

}  // namespace umbrameter
