#include "core/input_lines.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "core/interrupt.h"

namespace umbrameter {

std::optional<std::string> InputLines::next() {
  std::string line;
  const auto take = [&](std::size_t count) {
    line.append(read_, 0, count);
    if (line.size() > max_line_) line.resize(max_line_ + 1);
    read_.erase(0, count);
  };
  while (true) {
    throw_if_interrupted();
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      take(end);
      read_.erase(0, 1);
      return line;
    }
    take(read_.size());
    if (is_at_end_) return line.empty() ? std::nullopt : std::optional(std::move(line));
    // A signal between the check and the wait is seen after the pause.
    pollfd input{descriptor_, POLLIN, 0};
    constexpr int pause = 100;
    if (poll(&input, 1, pause) <= 0) continue;
    std::array<char, 65536> buffer;
    const ssize_t count = read(descriptor_, buffer.data(), buffer.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count > 0) read_.assign(buffer.data(), static_cast<std::size_t>(count));
    is_at_end_ = count <= 0;
  }
}

}  // namespace umbrameter
