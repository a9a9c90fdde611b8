#include "reports/files/console.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <thread>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

TEST(Progress, Tells_share_rate_and_time_left) {
  // A quarter in 10 s leaves 30 s; 50 million rays in 10 s are 5 Mray/s; 6 of the 24 cells are filled.
  EXPECT_EQ(progress_text("rays", {0.25, 0.0, 10.0, 50'000'000}, false),
            "rays ######..................  25 %, 5 Mray/s, 30 s left");
  // The same pace with a thousandth done cannot be told; half an hour is told in minutes.
  EXPECT_EQ(progress_text("rays", {0.001, 0.0, 10.0, 0}, false), "rays ........................   0 %");
  EXPECT_EQ(progress_text("rays", {0.5, 0.0, 1800.0, 0}, false), "rays ############............  50 %, 30 min left");
  // What an earlier run had done took none of these seconds: 9 % left, 3 % in 10 s.
  EXPECT_EQ(progress_text("cells", {0.91, 0.88, 10.0, 0}, false), "cells #####################...  91 %, 30 s left");
  EXPECT_EQ(progress_text("rays", {1.0, 0.0, 1.0, 0}, true),
            "rays \x1b[36m########################\x1b[0m 100 %, 0 s left");
}

// The test's end of a terminal, and what a program on the other end writes to it.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    name_ = ptsname(master_);
    // Kept open so that reading waits instead of failing while no program has it open.
    slave_ = open(name_.c_str(), O_RDWR | O_NOCTTY);
    reader_ = std::thread([this] { read_all(); });
  }
  ~Terminal() {
    finish();
    if (slave_ >= 0) close(slave_);
    if (master_ >= 0) close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  const std::string& name() const { return name_; }
  /// Everything that was written; called when the program has ended.
  const std::string& finish() {
    ended_ = true;
    if (reader_.joinable()) reader_.join();
    return text_;
  }

 private:
  void read_all() {
    for (;;) {
      pollfd state{master_, POLLIN, 0};
      const bool last = ended_;
      if (poll(&state, 1, 50) > 0) {
        char block[4096];
        const ssize_t got = read(master_, block, sizeof(block));
        if (got <= 0) return;
        text_.append(block, static_cast<std::size_t>(got));
      } else if (last) {
        return;
      }
    }
  }

  int master_ = -1;
  int slave_ = -1;
  std::string name_;
  std::string text_;
  std::atomic<bool> ended_{false};
  std::thread reader_;
};

TEST(Progress, Is_shown_on_a_terminal_only) {
  const TemporaryFolder folder;
  // Some 160 million rays on one thread: no processor is done before the bar has told how fast they are.
  const std::vector<std::string> words = {"trace",      "corner",    "-o",  folder / "out", "--size",
                                          "320x180",    "--light",   "sun", "--truth.spp",  "4096",
                                          "--no-cache", "--threads", "1",   "--force"};
  Terminal terminal;
  if (terminal.name().empty()) GTEST_SKIP() << "no terminal can be made here";
  ProgramOptions on_terminal;
  on_terminal.environment = {"TERM=xterm"};
  on_terminal.wrapper = {"sh", "-c", "exec \"$@\" 2>'" + terminal.name() + "'", "sh"};
  const ProgramResult shown = run_program(words, on_terminal);
  EXPECT_EQ(shown.exit_code, 0);
  const std::string& text = terminal.finish();
  EXPECT_NE(text.find("hemisphere rays"), std::string::npos) << text;
  EXPECT_NE(text.find("Mray/s, "), std::string::npos) << text;
  EXPECT_NE(text.find(" s left"), std::string::npos) << text;
  Terminal dumb;
  on_terminal.wrapper[2] = "exec \"$@\" 2>'" + dumb.name() + "'";
  on_terminal.environment = {"TERM=dumb"};
  std::vector<std::string> shorter = words;
  *std::find(shorter.begin(), shorter.end(), "4096") = "512";
  EXPECT_EQ(run_program(shorter, on_terminal).exit_code, 0);
  EXPECT_EQ(dumb.finish().find('\x1b'), std::string::npos) << dumb.finish();
  const ProgramResult piped = run_program(words);
  EXPECT_EQ(piped.err.find(" s left"), std::string::npos) << piped.err;
}

}  // namespace
}  // namespace umbrameter
