#include "reports/files/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/standard_streams.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

constexpr auto first_shown_after = std::chrono::milliseconds(400);
constexpr auto shown_every = std::chrono::milliseconds(100);
constexpr int bar_cells = 24;

// TERM=dumb is a terminal without escape sequences, such as that of an editor.
bool understands_escapes() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

}  // namespace

void print_line(const Console& console, const std::string& line) {
  if (!console.json) write_to(stdout, plain_text(line) + "\n");
}

void add_line(const Console& console, const std::string& line) {
  if (!console.quiet) print_line(console, line);
}

void diagnostic(const Console& console, const std::string& line) {
  if (console.verbose) write_to(stderr, plain_text(line) + "\n");
}

void note(const Console& console, const std::string& line) {
  if (!console.quiet) write_to(stderr, "note: " + plain_text(line) + "\n");
}

bool use_color() {
  const char* no_color = std::getenv("NO_COLOR");
  return understands_escapes() && (no_color == nullptr || *no_color == '\0');
}

std::string progress_text(const std::string& label, const ProgressState& state, bool color) {
  const auto& [share, first_share, seconds, rays] = state;
  const int filled = std::clamp(static_cast<int>(share * bar_cells), 0, bar_cells);
  std::string text = fmt::format(
      "{} {}{}{}{} {:3.0f} %", label, color ? "\x1b[36m" : "", std::string(static_cast<std::size_t>(filled), '#'),
      std::string(static_cast<std::size_t>(bar_cells - filled), '.'), color ? "\x1b[0m" : "", 100.0 * share);
  if (rays > 0 && seconds > 0.0) text += fmt::format(", {:.3g} Mray/s", static_cast<double>(rays) / seconds * 1e-6);
  if (share - first_share > 0.02) {
    const double left = seconds * (1.0 - share) / (share - first_share);
    text += left < 90.0 ? fmt::format(", {:.0f} s left", left) : fmt::format(", {:.0f} min left", left / 60.0);
  }
  return text;
}

ProgressBar::ProgressBar(const Console& console, std::string label, std::function<std::uint64_t()> count_rays)
    : label_(std::move(label)),
      count_rays_(std::move(count_rays)),
      visible_(!console.quiet && understands_escapes()),
      start_(Clock::now()),
      shown_(start_ + first_shown_after - shown_every) {}

ProgressBar::ProgressBar(Progress pass_on) : pass_on_(std::move(pass_on)) {}

ProgressBar::~ProgressBar() {
  if (visible_) write_to(stderr, "\r\x1b[K");
}

void ProgressBar::show(double share, const std::string& counted) {
  if (pass_on_) pass_on_(share);
  const auto now = Clock::now();
  if (!first_share_) {
    first_share_ = share;
    start_ = now;
    rays_before_ = count_rays_ ? count_rays_() : 0;
  }
  if (!visible_ || now - shown_ < shown_every) return;
  shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::uint64_t rays = count_rays_ ? count_rays_() - rays_before_ : 0;
  const std::string label = counted.empty() ? label_ : label_ + " " + counted;
  write_to(stderr, "\r\x1b[K" + progress_text(label, {share, *first_share_, seconds, rays}, use_color()));
  std::fflush(stderr);
}

Progress ProgressBar::callback() {
  return [this](double share) { show(share); };
}

}  // namespace umbrameter
