// Runs a helper program as a filter: bytes in, bytes out. No shell, no files, nothing left running.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

struct FilterResult {
  std::string output;   ///< what it wrote to stdout
  std::string problem;  ///< one line; empty when the program ended with status 0
};

/// `arguments`: the program first, looked up in PATH. `input` is what it reads on stdin.
/// Throws Error when the user interrupts; the program is ended first.
FilterResult run_filter(const std::vector<std::string>& arguments, std::string_view input);

}  // namespace umbrameter
