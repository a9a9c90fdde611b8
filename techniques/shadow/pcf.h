// Techniques that sum depth comparisons with a PCF kernel: PCF itself, PCSS and DPCF.
#pragma once

#include <string_view>

#include "techniques/shadow/capabilities.h"
#include "techniques/shadow/filter.h"

namespace umbrameter {
struct ShadowParams;

/// Percentage-closer filtering: a weighted sum of depth comparisons.
struct Pcf {
  static constexpr std::string_view name = "pcf";
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .taps_independent_of_bias = true};
  static Pcf make(const ShadowParams& params, double light_extent);
  static Parameters reads(ShadowParams& params);
  FilterKernel kernel;
};

/// Percentage-closer soft shadows: PCF whose kernel grows with the distance of the blockers. Which texels block depends
/// on the bias.
struct Pcss : Pcf {
  static constexpr std::string_view name = "pcss";
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .reads_light_extent = true};
  static Pcss make(const ShadowParams& params, double light_extent);
  static Parameters reads(ShadowParams& params);
};

/// Contact-hardening PCF: the visibility is no sum, because the share of lit taps is sharpened.
struct Dpcf : Pcf {
  static constexpr std::string_view name = "dpcf";
  static constexpr TechniqueCapabilities capabilities{.reads_light_extent = true};
  static Dpcf make(const ShadowParams& params, double light_extent);
  static Parameters reads(ShadowParams& params);
};

}  // namespace umbrameter
