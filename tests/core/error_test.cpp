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

TEST(Error, Shows_the_beginning_and_the_end_of_what_is_long) {
  const std::string word = Error(ExitCode::usage, "shadow.filter", std::string(5000, 'x') + " is not allowed").what();
  EXPECT_EQ(word, "shadow.filter: " + std::string(170, 'x') + "\u2026" + std::string(84, 'x') + " is not allowed");
  std::string words;
  for (int i = 0; i < 2500; ++i) words += "x ";
  EXPECT_LT(std::string(Error(ExitCode::usage, "flag", words).what()).size(), 1020u);
  const std::string path = "/" + std::string(200, 'p');
  EXPECT_EQ(std::string(Error(ExitCode::usage, path, "no").what()), path + ": no");
  // The cut lies within a letter of two bytes, which goes as a whole.
  const std::string letters =
      Error(ExitCode::usage, std::string(169, 'a') + "\u00e4" + std::string(200, 'a'), "no").what();
  EXPECT_TRUE(letters.starts_with(std::string(169, 'a') + "\u2026a")) << letters;
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
