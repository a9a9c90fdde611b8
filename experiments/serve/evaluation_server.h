// Replies to requests that name parameters with the statistics measured there (docs/serve.md). The scene stays loaded:
// only what the parameters change is drawn or traced again.
#pragma once

#include <cstddef>
#include <string>

#include "experiments/stages/stages.h"
#include "results/swept.h"

namespace umbrameter {

/// Most bytes of a request.
inline constexpr std::size_t max_request = std::size_t{1} << 20;

class EvaluationServer {
 public:
  /// Measures the experiment once, which draws and traces all that requests may share. The reference of ambient
  /// occlusion does not follow ao.radius, so that the error at one radius can be compared with that at another. Throws
  /// Error, also for shadows of several lights. `stages` must outlive the server.
  EvaluationServer(Stages& stages, Experiment experiment, SweptQuantity quantity);

  /// One line for one line. The reply to a wrong request, and to one that cannot be measured, says why. Throws only
  /// when SIGINT or SIGTERM arrives.
  std::string reply(const std::string& request);

 private:
  Table measure(const Experiment& experiment);

  Stages& stages_;
  Experiment given_;
  SweptQuantity quantity_;
};

}  // namespace umbrameter
