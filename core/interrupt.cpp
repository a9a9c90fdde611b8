#include "core/interrupt.h"

#include <atomic>
#include <csignal>

#include "core/error.h"

namespace umbrameter {
namespace {

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int signal) {
  received_signal.store(signal);
  std::signal(signal, SIG_DFL);
}

}  // namespace

void install_interrupt_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool is_interrupted() { return received_signal.load() != 0; }

void throw_if_interrupted(std::string_view remedy) {
  const int signal = received_signal.load();
  if (signal == 0) return;
  const bool by_user = signal == SIGINT;
  throw Error(by_user ? ExitCode::interrupted : ExitCode::terminated, "stopped",
              by_user ? "interrupted by Ctrl-C" : "terminated by a signal", std::string(remedy));
}

}  // namespace umbrameter
