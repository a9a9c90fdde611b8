// What a shadow technique can do, as far as measuring it depends on that.
#pragma once

namespace umbrameter {

/// What decides how a technique's error can be measured.
struct TechniqueCapabilities {
  /// Visibility is a weighted sum of depth comparisons. Then each wrong tap has one cause.
  bool sums_comparisons = false;
  /// Which texels are compared, and with what weight, does not depend on the bias. Then one pass over the taps measures
  /// every bias.
  bool taps_independent_of_bias = false;
};

}  // namespace umbrameter
