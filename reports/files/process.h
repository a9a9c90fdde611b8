// Runs helper programs as filters: bytes in, bytes out. No shell, no files, nothing left running.
#pragma once

#include <string>
#include <vector>

namespace umbrameter {

struct Filter {
  std::vector<std::string> arguments;    ///< the program first, looked up in PATH
  std::vector<std::string> environment;  ///< "NAME=value", in place of the caller's value
  std::string input;                     ///< what the program reads on stdin
};

struct FilterResult {
  std::string output;   ///< what it wrote to stdout
  std::string problem;  ///< one line; empty when the program ended with status 0
};

/// Runs all, at most `at_once` at a time; the results are in the order of the filters.
/// Throws Error when the user interrupts; programs still running are ended first.
std::vector<FilterResult> run_filters(const std::vector<Filter>& filters, std::size_t at_once);

}  // namespace umbrameter
