// Ctrl-C and SIGTERM: a flag that long loops look at, so that nothing is left half-written.
#pragma once

#include <string_view>

#include "core/error.h"

namespace umbrameter {

/// From now on SIGINT and SIGTERM set the flag; a second signal ends the process at once.
void install_interrupt_handlers();

/// Whether a signal has arrived.
bool is_interrupted();

/// Throws Error with ExitCode::interrupted or ExitCode::terminated when a signal has arrived; `remedy` says what is
/// kept and how to go on.
void throw_if_interrupted(std::string_view remedy = "rerun the command to start over");

/// The result of `work`. If a signal stops it, the error has the remedy that `remedy` returns: what is kept by then.
template <typename Work, typename Remedy>
auto resumable(const Work& work, const Remedy& remedy) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw_if_interrupted(remedy());
    throw;
  }
}

}  // namespace umbrameter
