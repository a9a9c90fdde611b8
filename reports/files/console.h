// Console output: results on stdout, notes and progress on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/parallel.h"

namespace umbrameter {

struct Console {
  bool quiet = false;    ///< only the main result: no progress, no notes, no further lines
  bool json = false;     ///< stdout carries only the JSON summary
  bool verbose = false;  ///< also print diagnostics
};

/// Prints a line of the main result on stdout; nothing with --json.
void print_line(const Console& console, const std::string& line);

/// Prints a further line of the result on stdout; nothing with --json or --quiet.
void add_line(const Console& console, const std::string& line);

/// Prints a diagnostic on stderr, only with --verbose.
void diagnostic(const Console& console, const std::string& line);

/// Prints an assumption or omission on stderr as "note: …"; nothing with --quiet.
void note(const Console& console, const std::string& line);

/// Whether stderr may carry colours: a terminal other than "dumb", and NO_COLOR unset or empty (no-color.org).
bool use_color();

/// Progress of a task.
struct ProgressState {
  double share = 0.0;        ///< share of the task that is done, 0 to 1
  double first_share = 0.0;  ///< share that was done at the start of `seconds`, for example by an earlier run
  double seconds = 0.0;
  std::uint64_t rays = 0;  ///< rays traced during `seconds`; 0 if they are not counted
};

/// "shadow rays ####.... 42 %, 12.3 Mray/s, 8 s left". The rate is omitted if no rays are counted, the time left until
/// it can be estimated.
std::string progress_text(const std::string& label, const ProgressState& state, bool color);

/// Shows a bar with percentage, rate and time left on stderr while the object lives. Shows nothing if stderr is not a
/// terminal that can erase a line, or with --quiet.
class ProgressBar {
 public:
  /// count_rays(), if given, returns the number of rays so far. It may start at any number and must be callable on any
  /// thread.
  ProgressBar(const Console& console, std::string label, std::function<std::uint64_t()> count_rays = {});
  /// Shows nothing and passes every share to `pass_on`, which may be empty.
  explicit ProgressBar(Progress pass_on);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `counted` is printed after the label: "7 of 19".
  void show(double share, const std::string& counted = {});
  /// A callable that calls show(). It must not outlive the bar.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::function<std::uint64_t()> count_rays_;
  Progress pass_on_;
  std::uint64_t rays_before_ = 0;
  bool visible_ = false;
  Clock::time_point start_;  ///< time of the first show()
  std::optional<double> first_share_;
  Clock::time_point shown_;
};

}  // namespace umbrameter
