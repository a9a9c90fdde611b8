// The shadow techniques and their capabilities. Other code depends on a technique's capabilities, never on its name.
//
// To add a technique: (1) put its parameters and their describe() in a new file in this folder; (2) here, add its name,
// a member of ShadowParams and an alternative of ShadowTechnique; (3) put its passes in raster/shadow/ and add a line
// to raster/shadow/technique_passes.h. A technique that filters a map before the look-up needs only a case in
// prefiltered.glsl, its parameters in prefiltered.h and its name here.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "techniques/shadow/capabilities.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/parameters.h"
#include "techniques/shadow/prefiltered.h"

namespace umbrameter {

enum class ShadowTechniqueName : int { pcf, esm, vsm, evsm2, evsm4, msm };

/// The shadow.* parameters, grouped by the stage that reads them.
struct ShadowParams {
  ShadowMapParams map;
  BiasParams bias;
  ShadowTechniqueName technique = ShadowTechniqueName::pcf;
  PcfParams pcf;
  EsmParams esm;
  MomentMapParams moment_map;
  MomentLookupParams moment_lookup;
};
Parameters describe(ShadowParams& params);

/// Percentage-closer filtering: a weighted sum of depth comparisons.
struct Pcf {
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .taps_independent_of_bias = true};
  FilterKernel kernel;
};

using ShadowTechnique = std::variant<Pcf, Prefiltered>;

ShadowTechnique make_technique(const ShadowParams& params);

/// The parameters of the pass that filters the shadow map before the look-up. The others affect only the look-up.
Parameters filtered_map_parameters(ShadowParams& params);

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique);

}  // namespace umbrameter
