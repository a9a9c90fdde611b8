// The shadow techniques and their capabilities. Other code depends on a technique's capabilities, never on its name.
//
// To add a technique: (1) put its parameters and their describe() in a new file in this folder; (2) here, add its name,
// a member of ShadowParams and an alternative of ShadowTechnique; (3) put its passes in raster/shadow/ and add a line
// to raster/shadow/technique_passes.h.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "techniques/shadow/capabilities.h"
#include "techniques/shadow/esm.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// Names of the techniques, in the order of ShadowTechnique's alternatives.
enum class ShadowTechniqueName : int { pcf, esm };

/// The shadow.* parameters, grouped by the stage that reads them.
struct ShadowParams {
  ShadowMapParams map;
  BiasParams bias;
  ShadowTechniqueName technique = ShadowTechniqueName::pcf;
  PcfParams pcf;
  EsmParams esm;
};
Parameters describe(ShadowParams& params);

/// Percentage-closer filtering: a weighted sum of depth comparisons.
struct Pcf {
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .taps_independent_of_bias = true};
  FilterKernel kernel;
};

using ShadowTechnique = std::variant<Pcf, Esm>;

ShadowTechnique make_technique(const ShadowParams& params);

/// The parameters of the pass that filters the shadow map before the look-up. The others affect only the look-up.
Parameters filtered_map_parameters(ShadowParams& params);

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique);

}  // namespace umbrameter
