// A program that runs beside this one and is talked to line by line.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

class ChildProcess {
 public:
  /// Starts the program, whose name is looked up in PATH. Throws Error (partial) if it cannot be started.
  explicit ChildProcess(std::vector<std::string> arguments);
  /// As end().
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Closes the program's stdin, gives it five seconds, and kills whatever is left of it and of what it has started.
  /// Whether the program ended by itself.
  bool end();

  /// A line from the program's stdout, without its end; nothing at the limit, at the end of stdout, and for a line
  /// above max_line: problem() then says why. Throws Error when the user interrupts.
  std::optional<std::string> read_line(std::chrono::milliseconds limit);
  /// Writes the text and a line break to the program's stdin; false if it no longer reads.
  bool write_line(std::string_view text);

  /// One line: why the last call gave nothing, with the last line of the program's stderr.
  const std::string& problem() const { return problem_; }

  static constexpr std::size_t max_line = std::size_t{1} << 20;  ///< bytes

 private:
  void fail(const std::string& why);
  /// Reads what is there within the pause; false at the end of stdout.
  bool pump(std::chrono::milliseconds pause);
  bool has_ended();

  std::string program_;
  pid_t pid_ = 0;
  int to_child_ = -1;
  int from_child_ = -1;
  int messages_ = -1;
  bool is_stuck_ = false;  // it does not talk as it should: there is no use in waiting for its end
  int status_ = 0;
  std::string read_;  // from stdout, not yet taken
  std::string said_;  // the end of stderr
  std::string problem_;
};

}  // namespace umbrameter
