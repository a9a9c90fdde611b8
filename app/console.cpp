#include "app/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "reports/markup.h"

namespace umbrameter {
namespace {

constexpr auto first_shown_after = std::chrono::milliseconds(400);
constexpr auto shown_every = std::chrono::milliseconds(100);
constexpr int bar_cells = 24;

}  // namespace

void say(const Console& console, const std::string& line) {
  if (!console.json) fmt::print("{}\n", plain_text(line));
}

void note(const Console& console, const std::string& line) {
  if (!console.quiet) fmt::print(stderr, "note: {}\n", plain_text(line));
}

bool use_color() {
  const char* no_color = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_color == nullptr || *no_color == '\0');
}

ProgressBar::ProgressBar(const Console& console, std::string label)
    : label_(std::move(label)),
      visible_(!console.quiet && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      shown_(start_ + first_shown_after - shown_every) {}

ProgressBar::~ProgressBar() {
  if (visible_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double share) {
  const auto now = Clock::now();
  if (!visible_ || now - shown_ < shown_every) return;
  shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const int filled = std::clamp(static_cast<int>(share * bar_cells), 0, bar_cells);
  const std::string left = share > 0.02 ? fmt::format(", {:.0f} s left", elapsed * (1.0 - share) / share) : "";
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(bar_cells - filled), '.');
  fmt::print(stderr, "\r\x1b[K{} {}{}{} {:3.0f} %{}", label_, use_color() ? "\x1b[36m" : "", bar,
             use_color() ? "\x1b[0m" : "", 100.0 * share, left);
  std::fflush(stderr);
}

Progress ProgressBar::callback() {
  return [this](double share) { show(share); };
}

}  // namespace umbrameter
