// The properties of a shadow technique that decide how its error can be measured.
#pragma once

namespace umbrameter {

/// Properties that decide how a technique's error can be measured.
struct TechniqueCapabilities {
  /// Visibility is a weighted sum of depth comparisons, so that each wrong tap has one cause.
  bool sums_comparisons = false;
  /// The compared texels and their weights do not depend on the bias, so that one pass over the taps measures every
  /// bias.
  bool taps_independent_of_bias = false;
  /// The kernel follows the size of the light.
  bool reads_light_extent = false;
};

}  // namespace umbrameter
