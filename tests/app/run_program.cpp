#include "tests/app/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace umbrameter {
namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  const TemporaryFolder folder;
  // Never the user's own cache of references.
  std::string command = "exec env " + quoted("XDG_CACHE_HOME=" + (folder / "cache").string()) + " ";
  // Compiled shaders are shared by all runs.
  command += quoted(std::string("MESA_SHADER_CACHE_DIR=") + UMBRAMETER_SHADER_CACHE) + " ";
  for (const std::string& setting : options.environment) command += quoted(setting) + " ";
  for (const std::string& word : options.wrapper) command += quoted(word) + " ";
  command += quoted(UMBRAMETER_PROGRAM);
  for (const std::string& argument : arguments) command.append(1, ' ').append(quoted(argument));
  command += " >" + quoted((folder / "out").string()) + " 2>" + quoted((folder / "err").string()) + " </dev/null";

  const char* words[] = {"sh", "-c", command.c_str(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, "/bin/sh", nullptr, nullptr, const_cast<char* const*>(words), environ) != 0) {
    throw std::runtime_error("cannot start a shell");
  }
  int status = 0;
  bool has_ended = false;
  while (options.signal_counts_from && !options.signal_counts_from() && !has_ended) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    has_ended = waitpid(child, &status, WNOHANG) != 0;
  }
  if (options.signal != 0 && !has_ended) {
    std::this_thread::sleep_for(std::chrono::duration<double>(options.signal_after_seconds));
    kill(child, options.signal);
  }
  if (!has_ended) waitpid(child, &status, 0);
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = text_of(folder.path() / "out");
  result.err = text_of(folder.path() / "err");
  return result;
}

bool is_one_line(const std::string& text) { return !text.empty() && text.find('\n') == text.size() - 1; }

}  // namespace umbrameter
