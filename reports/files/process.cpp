#include "reports/files/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

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

// "NAME=value" of the caller, those of `own` in place of the caller's.
std::vector<std::string> environment_with(const std::vector<std::string>& own) {
  std::vector<std::string> all = own;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('=') + 1);
    const bool is_replaced =
        std::any_of(own.begin(), own.end(), [&](const std::string& mine) { return mine.rfind(name, 0) == 0; });
    if (!is_replaced) all.emplace_back(text);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

// One running program; ended by force when it is destroyed before it has ended by itself.
class Child {
 public:
  Child(const Filter& filter, std::size_t index)
      : index_(index), program_(filter.arguments.front()), input_(filter.input), deadline_(Clock::now() + patience) {
    std::vector<std::string> arguments = filter.arguments;
    std::vector<std::string> environment = environment_with(filter.environment);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input_.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output_.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages_.descriptor(), STDERR_FILENO);
    const int error = posix_spawnp(&pid_, program_.c_str(), &actions, nullptr, pointers(arguments).data(),
                                   pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      pid_ = 0;
      problem_ = fmt::format("cannot run {}: {}", program_, std::generic_category().message(error));
    }
  }
  ~Child() {
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::size_t index() const { return index_; }

  // The result, once the program has ended.
  std::optional<FilterResult> poll() {
    if (pid_ == 0) return FilterResult{{}, problem_};
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, WNOHANG);
    if (ended == 0 && Clock::now() > deadline_) {
      return FilterResult{{}, fmt::format("{} did not finish within {} s", program_, patience.count())};
    }
    if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
    pid_ = 0;
    if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return FilterResult{output_.content(), {}};
    if (ended > 0 && WIFSIGNALED(status)) {
      return FilterResult{{}, fmt::format("{} was ended by signal {}", program_, WTERMSIG(status))};
    }
    const std::string message = first_line(messages_.content());
    return FilterResult{{}, fmt::format("{} failed: {}", program_, message.empty() ? "no message" : message)};
  }

 private:
  std::size_t index_;
  std::string program_;
  MemoryFile input_;
  MemoryFile output_;
  MemoryFile messages_;
  Clock::time_point deadline_;
  pid_t pid_ = 0;
  std::string problem_;
};

}  // namespace

std::vector<FilterResult> run_filters(const std::vector<Filter>& filters, std::size_t at_once) {
  std::vector<FilterResult> results(filters.size());
  std::vector<std::unique_ptr<Child>> running;
  std::size_t next = 0;
  while (next < filters.size() || !running.empty()) {
    throw_if_interrupted();
    while (next < filters.size() && running.size() < at_once) {
      try {
        running.push_back(std::make_unique<Child>(filters[next], next));
      } catch (const std::system_error& error) {
        results[next].problem = error.what();
      }
      ++next;
    }
    std::erase_if(running, [&](const std::unique_ptr<Child>& child) {
      std::optional<FilterResult> result = child->poll();
      if (result) results[child->index()] = std::move(*result);
      return result.has_value();
    });
    if (!running.empty()) std::this_thread::sleep_for(pause);
  }
  return results;
}

}  // namespace umbrameter
