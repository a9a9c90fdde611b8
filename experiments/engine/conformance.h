// Holds an adapter against the engine protocol, step by step.
#pragma once

#include <string>
#include <vector>

namespace umbrameter {

struct ConformanceCheck {
  std::string title;    ///< "describes its parameters"
  std::string problem;  ///< one line; empty if all is well
};

/// Describe, load and render of a built-in scene with each kind of light that the adapter names, at the defaults and at
/// other values of its numbers; alignment of its surfaces; equal images for equal requests; and that it ends at the end
/// of its stdin. Stops at a failure after which nothing can follow.
std::vector<ConformanceCheck> check_conformance(const std::string& adapter);

}  // namespace umbrameter
