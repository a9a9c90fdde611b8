#include "reports/files/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "core/interrupt.h"

extern char** environ;

namespace umbrameter {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds patience{300};
constexpr std::chrono::milliseconds pause{2};

// A file in memory. Unlike a pipe it never blocks and never raises SIGPIPE.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = {}) : descriptor_(memfd_create("umbrameter", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
    while (!content.empty()) {
      const ssize_t written = write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        const int error = errno;
        close(descriptor_);
        throw std::system_error(error, std::generic_category(), "memory for a helper program");
      }
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(descriptor_, 0, SEEK_SET);
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string content() const {
    std::string text;
    char buffer[65536];
    ssize_t count = 0;
    while ((count = pread(descriptor_, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0) {
      text.append(buffer, static_cast<std::size_t>(count));
    }
    return text;
  }

 private:
  int descriptor_;
};

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

// Ends a program by force that has not ended by itself.
struct KillGuard {
  pid_t pid = 0;  // 0: it has ended
  ~KillGuard() {
    if (pid == 0) return;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
};

FilterResult run_program(const std::vector<std::string>& arguments, std::string_view input_text) {
  const std::string& program = arguments.front();
  const MemoryFile input(input_text), output, messages;
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.descriptor(), STDERR_FILENO);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {{}, fmt::format("cannot run {}: {}", program, std::generic_category().message(error))};
  KillGuard child{pid};
  const Clock::time_point deadline = Clock::now() + patience;
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(pid, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
    throw_if_interrupted();
    if (Clock::now() > deadline) {
      return {{}, fmt::format("{} did not finish within {} s", program, patience.count())};
    }
    std::this_thread::sleep_for(pause);
  }
  child.pid = 0;
  if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {output.content(), {}};
  if (ended > 0 && WIFSIGNALED(status)) {
    return {{}, fmt::format("{} was ended by signal {}", program, WTERMSIG(status))};
  }
  const std::string message = first_line(messages.content());
  return {{}, fmt::format("{} failed: {}", program, message.empty() ? "no message" : message)};
}

}  // namespace

FilterResult run_filter(const std::vector<std::string>& arguments, std::string_view input) {
  throw_if_interrupted();
  try {
    return run_program(arguments, input);
  } catch (const std::system_error& error) {
    return {{}, error.what()};
  }
}

}  // namespace umbrameter
