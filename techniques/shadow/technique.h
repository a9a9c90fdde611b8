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
#include "techniques/shadow/cascades.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/parameters.h"
#include "techniques/shadow/prefiltered.h"
#include "techniques/shadow/screen_space.h"

namespace umbrameter {

enum class ShadowTechniqueName : int { pcf, esm, vsm, evsm2, evsm4, msm, csm, pcss, dpcf, screen_space };

/// The shadow.* parameters, grouped by the stage that reads them.
struct ShadowParams {
  ShadowMapParams map;
  MapFitParams fit;
  MapDepthParams map_depth;
  BiasParams bias;
  ShadowTechniqueName technique = ShadowTechniqueName::pcf;
  PcfParams pcf;
  PcssParams pcss;
  EsmParams esm;
  MomentMapParams moment_map;
  MomentLookupParams moment_lookup;
  ScreenSpaceParams screen_space;
};
Parameters describe(ShadowParams& params);

/// Percentage-closer filtering: a weighted sum of depth comparisons.
struct Pcf {
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .taps_independent_of_bias = true};
  FilterKernel kernel;
};

/// Percentage-closer soft shadows: PCF whose kernel grows with the distance of the blockers. Which texels block depends
/// on the bias.
struct Pcss : Pcf {
  static constexpr TechniqueCapabilities capabilities{.sums_comparisons = true, .reads_light_extent = true};
};

/// Contact-hardening PCF: the visibility is no sum, because the share of lit taps is sharpened.
struct Dpcf : Pcf {
  static constexpr TechniqueCapabilities capabilities{.reads_light_extent = true};
};

/// A technique that reads a map.
using MapTechnique = std::variant<Pcf, Pcss, Dpcf, Prefiltered>;

/// Screen-space shadows combined with a technique that reads a map.
struct ContactShadows {
  static constexpr TechniqueCapabilities capabilities{};
  MapTechnique of_map;
  ScreenSpace march;
};

using ShadowTechnique = std::variant<Pcf, Pcss, Dpcf, Prefiltered, ScreenSpace, ContactShadows>;

/// light_extent: half the size of the light, as BlockerSearch::extent; 0 for a light without extent. Throws Error
/// (usage) for parameters that exclude each other.
ShadowTechnique make_technique(const ShadowParams& params, double light_extent = 0.0);

/// The kernel of a technique that compares taps with a map; nullptr for others.
const FilterKernel* kernel_of(const ShadowTechnique& technique);

/// The technique that looks up a filtered map, alone or combined with screen-space shadows; nullptr for others.
const Prefiltered* prefiltered_of(const ShadowTechnique& technique);

/// The parameters of the pass that filters the shadow map before the look-up. The others affect only the look-up.
Parameters filtered_map_parameters(ShadowParams& params);

/// The parameters that only the look-up reads, of which one pass over the pixels can take many values
/// (draw_lookups() in raster/shadow/prefiltered_pass.h). Empty if the technique has no filtered map.
Parameters lookup_parameters(ShadowParams& params);

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique);

}  // namespace umbrameter
