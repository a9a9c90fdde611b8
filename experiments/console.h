// What the program says: results on stdout, notes and progress on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/parallel.h"

namespace umbrameter {

struct Console {
  bool quiet = false;    ///< the answer alone: no progress, no notes, no further lines
  bool json = false;     ///< stdout carries the JSON summary and nothing else
  bool verbose = false;  ///< diagnostics too
};

/// A line of the answer, on stdout; nothing with --json.
void say(const Console& console, const std::string& line);

/// More of the result than the answer, on stdout; nothing with --json or --quiet.
void add_line(const Console& console, const std::string& line);

/// A diagnostic for --verbose, on stderr.
void diagnostic(const Console& console, const std::string& line);

/// What was assumed or left out, on stderr as "note: …"; nothing with --quiet.
void note(const Console& console, const std::string& line);

/// Whether stderr may carry colours: a terminal, and NO_COLOR unset or empty (no-color.org).
bool use_color();

/// How far some work is.
struct Advance {
  double share = 0.0;        ///< done of it all
  double first_share = 0.0;  ///< was done before these seconds began, by an earlier run perhaps
  double seconds = 0.0;
  std::uint64_t rays = 0;  ///< traced in these seconds; 0 where none are counted
};

/// "shadow rays ####.... 42 %, 12.3 Mray/s, 8 s left": the rate where rays are counted, the time left once it can be
/// told.
std::string progress_text(const std::string& label, const Advance& advance, bool color);

/// A bar with percentage, rate and time left on stderr while it lives; silent where stderr is no terminal, and with
/// --quiet.
class ProgressBar {
 public:
  /// count_rays(), where given, tells a growing number of rays, from any start and on any thread.
  ProgressBar(const Console& console, std::string label, std::function<std::uint64_t()> count_rays = {});
  /// Shows nothing and passes every share on; to nobody where `pass_on` is empty.
  explicit ProgressBar(Progress pass_on);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `counted` follows the label: "7 of 19".
  void show(double share, const std::string& counted = {});
  /// show() as a callable that must not outlive the bar.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::function<std::uint64_t()> count_rays_;
  Progress pass_on_;
  std::uint64_t rays_before_ = 0;
  bool visible_ = false;
  Clock::time_point start_;  ///< when the first share was told
  std::optional<double> first_share_;
  Clock::time_point shown_;
};

}  // namespace umbrameter
