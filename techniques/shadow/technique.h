// The shadow techniques and what each can do. Code asks a technique for its capabilities, never for its name.
//
// To add one: a file beside this one with its parameters and their describe(); here its name, a member of ShadowParams
// and an alternative of ShadowTechnique; its passes in raster/shadow/ and a line in raster/shadow/technique_passes.h.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "techniques/shadow/capabilities.h"
#include "techniques/shadow/esm.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// In the order of ShadowTechnique's alternatives.
enum class ShadowTechniqueName : int { pcf, esm };

/// The shadow.* parameters, by the stage that reads them.
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

/// The parameters from which a shadow map is filtered before it is looked up; all others act at the look-up.
Parameters filtered_map_parameters(ShadowParams& params);

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique);

}  // namespace umbrameter
