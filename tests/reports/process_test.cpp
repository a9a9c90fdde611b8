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

FilterResult run(std::vector<std::string> arguments, std::string input = {}) {
  return run_filters({{std::move(arguments), {}, std::move(input)}}, 1).front();
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

TEST(Process, Results_are_in_the_order_of_the_filters_whoever_ends_first) {
  const std::vector<FilterResult> results = run_filters({{{"sh", "-c", "sleep 0.2; echo first"}, {}, {}},
                                                         {{"sh", "-c", "echo second"}, {}, {}},
                                                         {{"sh", "-c", "echo third"}, {}, {}}},
                                                        2);
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[0].output, "first\n");
  EXPECT_EQ(results[1].output, "second\n");
  EXPECT_EQ(results[2].output, "third\n");
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

TEST(Process, Given_variables_replace_the_callers) {
  setenv("UMBRAMETER_TEST", "outer", 1);
  const std::vector<FilterResult> results =
      run_filters({{{"sh", "-c", "echo $UMBRAMETER_TEST"}, {"UMBRAMETER_TEST=inner"}, {}},
                   {{"sh", "-c", "echo $UMBRAMETER_TEST"}, {}, {}}},
                  2);
  unsetenv("UMBRAMETER_TEST");
  EXPECT_EQ(results[0].output, "inner\n");
  EXPECT_EQ(results[1].output, "outer\n");
}

TEST(Process, Arguments_meet_no_shell) {
  EXPECT_EQ(run({"printf", "%s", "$(id); `id` 'x' \"y\""}).output, "$(id); `id` 'x' \"y\"");
}

TEST(Process, Nothing_to_run_gives_nothing) { EXPECT_TRUE(run_filters({}, 2).empty()); }

// In a process of its own: the flag that a signal sets stays set.
[[noreturn]] void run_until_interrupted(const std::filesystem::path& pid_file) {
  install_interrupt_handlers();
  std::thread interrupter([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGINT);
  });
  int code = 0;
  try {
    run_filters({{{"sh", "-c", "echo $$ > '" + pid_file.string() + "'; exec sleep 60"}, {}, {}}}, 1);
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
