#include "experiments/engine/child_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "core/interrupt.h"

extern char** environ;

namespace umbrameter {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds pause_of_polls{50};
constexpr milliseconds patience_at_end{5000};
constexpr std::size_t most_said = 4096;

void close_if_open(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

std::string last_line(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string_view::npos) return {};
  text = text.substr(0, end + 1);
  const std::size_t begin = text.find_last_of("\r\n");
  return std::string(begin == std::string_view::npos ? text : text.substr(begin + 1));
}

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> arguments) : program_(arguments.front()) {
  // Sockets, because a write to one can be kept from raising SIGPIPE.
  std::array<int, 2> input{}, output{}, messages{};
  for (auto* pair : {&input, &output, &messages}) {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair->data()) != 0) {
      throw Error(ExitCode::partial, program_, "cannot start: " + std::generic_category().message(errno),
                  "close other programs");
    }
  }
  to_child_ = input[0], from_child_ = output[0], messages_ = messages[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages[1], STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);  // so that what it starts can be ended with it
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const int error = posix_spawnp(&pid_, program_.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  for (const int end : {input[1], output[1], messages[1]}) close(end);
  if (error == 0) return;
  pid_ = 0;
  for (int* end : {&to_child_, &from_child_, &messages_}) close_if_open(*end);
  throw Error(error == ENOENT || error == EACCES ? ExitCode::usage : ExitCode::partial, program_,
              "cannot start: " + std::generic_category().message(error),
              "check the command; 'umbrameter engine list' shows the adapters that are installed");
}

ChildProcess::~ChildProcess() {
  end();
  close_if_open(from_child_);
  close_if_open(messages_);
}

bool ChildProcess::end() {
  close_if_open(to_child_);
  if (pid_ == 0) return true;
  const auto deadline = Clock::now() + (is_stuck_ ? milliseconds(0) : patience_at_end);
  while (!has_ended() && Clock::now() < deadline) {
    if (is_interrupted()) kill(-pid_, SIGTERM);
    std::this_thread::sleep_for(milliseconds(5));
  }
  const bool by_itself = has_ended();
  kill(-pid_, SIGKILL);
  if (!by_itself) waitpid(pid_, nullptr, 0);
  pid_ = 0;
  return by_itself;
}

bool ChildProcess::has_ended() {
  if (status_ == 0) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) status_ = status + 1;
  }
  return status_ != 0;
}

void ChildProcess::fail(const std::string& why) {
  is_stuck_ = true;
  const std::string said = last_line(said_);
  problem_ = said.empty() ? why : fmt::format("{} ({})", why, said);
}

bool ChildProcess::pump(milliseconds pause) {
  std::array<pollfd, 2> ends{pollfd{from_child_, POLLIN, 0}, pollfd{messages_, POLLIN, 0}};
  if (poll(ends.data(), ends.size(), static_cast<int>(pause.count())) <= 0) return true;
  std::array<char, 65536> buffer;
  if ((ends[1].revents & (POLLIN | POLLHUP)) != 0) {
    const ssize_t count = read(messages_, buffer.data(), buffer.size());
    if (count > 0) said_.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0) close_if_open(messages_);
    if (said_.size() > most_said) said_.erase(0, said_.size() - most_said);
  }
  if ((ends[0].revents & (POLLIN | POLLHUP)) == 0) return true;
  const ssize_t count = read(from_child_, buffer.data(), buffer.size());
  if (count > 0) read_.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

std::optional<std::string> ChildProcess::read_line(milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  while (true) {
    const std::size_t end = read_.find('\n');
    if (end != std::string::npos && end <= max_line) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    if (read_.size() > max_line) {
      fail(fmt::format("it wrote a line of more than {} bytes", max_line));
      return std::nullopt;
    }
    throw_if_interrupted();
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) {
      fail(
          fmt::format("it did not reply within {} s", std::chrono::duration_cast<std::chrono::seconds>(limit).count()));
      return std::nullopt;
    }
    if (pump(std::min(left, pause_of_polls))) continue;
    // What it said last may still be under way.
    for (const auto until = Clock::now() + milliseconds(500); !has_ended() && Clock::now() < until;) {
      std::this_thread::sleep_for(milliseconds(5));
    }
    while (messages_ >= 0) {
      const std::size_t before = said_.size();
      pollfd more{messages_, POLLIN, 0};
      std::array<char, 4096> buffer;
      if (poll(&more, 1, 0) <= 0) break;
      const ssize_t count = read(messages_, buffer.data(), buffer.size());
      if (count <= 0) break;
      said_.append(buffer.data(), static_cast<std::size_t>(count));
      if (said_.size() == before) break;
    }
    if (!has_ended()) {
      fail("it closed its stdout");
    } else if (const int status = status_ - 1; WIFSIGNALED(status)) {
      fail(fmt::format("it was ended by signal {}", WTERMSIG(status)));
    } else {
      fail(fmt::format("it ended with code {}", WEXITSTATUS(status)));
    }
    return std::nullopt;
  }
}

bool ChildProcess::write_line(std::string_view text) {
  const std::string line = std::string(text) + "\n";
  std::string_view left = line;
  while (!left.empty()) {
    const ssize_t count = send(to_child_, left.data(), left.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace umbrameter
