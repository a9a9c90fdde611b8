#include "core/error.h"

#include <gtest/gtest.h>

#include <csignal>

#include "core/interrupt.h"

namespace umbrameter {
namespace {

TEST(Error, Says_what_why_and_what_to_do_in_one_line) {
  const Error error(ExitCode::unreadable_input, "scene.glb", "no such file", "check the path");
  EXPECT_STREQ(error.what(), "scene.glb: no such file; check the path");
  EXPECT_EQ(error.code(), ExitCode::unreadable_input);
}

TEST(Error, Stays_one_line_when_a_driver_or_file_name_holds_line_breaks) {
  const Error error(ExitCode::no_backend, "driver", "line one\nline two\r\n\tline three\n");
  EXPECT_EQ(std::string(error.what()).find_first_of("\r\n\t"), std::string::npos);
}

TEST(Interrupt, A_signal_becomes_an_error_with_its_own_exit_code) {
  EXPECT_EXIT(
      {
        install_interrupt_handlers();
        throw_if_interrupted();
        std::raise(SIGTERM);
        try {
          throw_if_interrupted();
        } catch (const Error& error) {
          std::exit(static_cast<int>(error.code()));
        }
        std::exit(0);
      },
      testing::ExitedWithCode(143), "");
  EXPECT_EXIT(
      {
        install_interrupt_handlers();
        std::raise(SIGINT);
        std::exit(is_interrupted() ? 130 : 0);
      },
      testing::ExitedWithCode(130), "");
}

TEST(Interrupt, A_second_signal_ends_the_process_at_once) {
  EXPECT_EXIT(
      {
        install_interrupt_handlers();
        std::raise(SIGINT);
        std::raise(SIGINT);
        std::exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace umbrameter
