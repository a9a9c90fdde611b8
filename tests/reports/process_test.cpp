#include "reports/files/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/error.h"
#include "core/interrupt.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

FilterResult run(const std::vector<std::string>& arguments, const std::string& input = {}) {
  return run_filter(arguments, input);
}

TEST(Process, Bytes_come_back_as_they_went_in) {
  std::string bytes;
  for (int i = 0; i < 3'000'000; ++i) bytes += static_cast<char>(i * 7 % 256);
  const FilterResult result = run({"cat"}, bytes);
  EXPECT_EQ(result.problem, "");
  EXPECT_TRUE(result.output == bytes);
}

TEST(Process, A_program_that_reads_nothing_does_no_harm) {
  const FilterResult result = run({"true"}, std::string(1'000'000, 'x'));
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.output, "");
}

TEST(Process, A_missing_program_is_a_problem_that_names_it) {
  const FilterResult result = run({"umbrameter-no-such-program"});
  EXPECT_EQ(result.problem, "cannot run umbrameter-no-such-program: No such file or directory");
}

TEST(Process, A_failing_program_is_quoted_with_the_first_line_it_said) {
  EXPECT_EQ(run({"sh", "-c", "echo bad input >&2; echo more >&2; exit 3"}).problem, "sh failed: bad input");
  EXPECT_EQ(run({"sh", "-c", "exit 1"}).problem, "sh failed: no message");
}

TEST(Process, A_killed_program_is_a_problem_with_its_signal) {
  EXPECT_EQ(run({"sh", "-c", "kill -9 $$"}).problem, "sh was ended by signal 9");
}

TEST(Process, Output_of_a_failed_program_is_not_used) { EXPECT_EQ(run({"sh", "-c", "echo half; exit 1"}).output, ""); }

TEST(Process, Arguments_meet_no_shell) {
  EXPECT_EQ(run({"printf", "%s", "$(id); `id` 'x' \"y\""}).output, "$(id); `id` 'x' \"y\"");
}

// In a process of its own: the flag that a signal sets stays set.
[[noreturn]] void run_until_interrupted(const std::filesystem::path& pid_file) {
  install_interrupt_handlers();
  std::thread interrupter([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGINT);
  });
  int code = 0;
  try {
    run({"sh", "-c", "echo $$ > '" + pid_file.string() + "'; exec sleep 60"});
  } catch (const Error& error) {
    code = static_cast<int>(error.code());
  }
  interrupter.join();
  std::_Exit(code);
}

TEST(ProcessDeathTest, Ctrl_c_ends_the_running_program) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EXIT(run_until_interrupted(folder / "pid"), testing::ExitedWithCode(130), "");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  const int pid = std::stoi(text_of(folder / "pid"));
  EXPECT_NE(kill(pid, 0), 0);
}

}  // namespace
}  // namespace umbrameter
