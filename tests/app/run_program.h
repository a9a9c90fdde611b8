// Starts the built program and keeps what it says.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace umbrameter {

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal number when a signal ended it
  std::string out;
  std::string err;
};

struct ProgramOptions {
  std::vector<std::string>
      environment;  ///< "NAME=value", added to the test's own, in which XDG_CACHE_HOME is an empty folder
  /// Words put before the program's own: {"sh", "-c", "ulimit -f 16; exec \"$@\"", "sh"}.
  std::vector<std::string> wrapper;
  /// Signal sent this long after the start; 0 for none.
  int signal = 0;
  double signal_after_seconds = 0.0;
  /// Where given, the seconds count from when this holds.
  std::function<bool()> signal_counts_from{};
};

ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramOptions& options = {});

/// Whether text is exactly one line that ends with a line break.
bool is_one_line(const std::string& text);

}  // namespace umbrameter
