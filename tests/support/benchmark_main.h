// What the benchmarks' main functions do: [SCENE] [--quick], and one line for an Error. They measure, and are no tests.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "core/error.h"

namespace umbrameter {

/// Calls `run` for the scene that is named, or courtyard, with `quick` where that is asked for. Returns the exit code.
template <class Setup>
int benchmark_main(int argc, char** argv, const Setup& quick, void (*run)(const std::string&, const Setup&)) {
  std::string scene = "courtyard";
  Setup setup;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      setup = quick;
    } else {
      scene = argv[i];
    }
  }
  try {
    run(scene, setup);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}

}  // namespace umbrameter
