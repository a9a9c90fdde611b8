// The shadow techniques. This list is the only one: choice, names, dispatch and build follow from it. Other code
// depends on a technique's capabilities, never on its name.
//
// A technique is a struct with its name, its capabilities and the functions make() and reads(), in a header of this
// folder that is included here; the source, the shared text (.glsl), the pass (raster/shadow/*_pass.cpp) and the shader
// (raster/shaders/*.comp) of the same name are built with it. Its own parameters become a member of ShadowParams,
// also in groups().
// make() returns what the passes need:
//   Prefiltered   for a technique that filters values of the depth before the look-up: prefiltered.h says what its text
//                 holds. Instead of reads() it lists map_parameters() and lookup_parameters(). No pass.
//   itself        for a technique of a new kind, whose passes raster/shadow/technique_passes.h declares. With filter()
//                 it lists map_parameters(), too.
#pragma once

#include <tuple>
#include <utility>
#include <variant>

#include "core/type_list.h"
#include "techniques/shadow/capabilities.h"
#include "techniques/shadow/csm.h"
#include "techniques/shadow/esm.h"
#include "techniques/shadow/evsm.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/map_fit.h"
#include "techniques/shadow/msm.h"
#include "techniques/shadow/parameters.h"
#include "techniques/shadow/pcf.h"
#include "techniques/shadow/screen_space.h"
#include "techniques/shadow/vsm.h"

namespace umbrameter {

using ShadowTechniques = TypeList<Pcf, Esm, Vsm, Evsm2, Evsm4, Msm, Csm, Pcss, Dpcf, ScreenSpace>;

/// The shadow.* parameters, grouped by the stage that reads them.
struct ShadowParams {
  ShadowMapParams map;
  MapFitParams fit;
  MapDepthParams map_depth;
  BiasParams bias;
  ShadowTechniques::Choice technique = ShadowTechniques::choice<Pcf>;
  PcfParams pcf;
  PcssParams pcss;
  EsmParams esm;
  MomentMapParams moment_map;
  EvsmParams evsm;
  CsmMapParams csm_map;
  MapSamplingParams map_sampling;
  MomentBoundParams moment_bound;
  MsmParams msm;
  CsmLookupParams csm_lookup;
  ScreenSpaceParams screen_space;

  /// All members, in the order of the documentation.
  auto groups() {
    return std::tie(map, fit, map_depth, bias, technique, pcf, pcss, esm, moment_map, evsm, csm_map, map_sampling,
                    moment_bound, msm, csm_lookup, screen_space);
  }
};
Parameters describe(ShadowParams& params);

/// What the techniques of the list make, each kind once.
template <class T>
using MadeBy = decltype(T::make(std::declval<const ShadowParams&>(), 0.0));
using MapTechnique = ShadowTechniques::Variant<MadeBy>;

/// Screen-space shadows combined with a technique that reads a map.
struct ContactShadows {
  static constexpr TechniqueCapabilities capabilities{};
  MapTechnique of_map;
  ScreenSpace march;
};

using ShadowTechnique = VariantWith<MapTechnique, ContactShadows>;

/// light_extent: half the size of the light, as BlockerSearch::extent; 0 for a light without extent. Throws Error
/// (usage) for parameters that exclude each other.
ShadowTechnique make_technique(const ShadowParams& params, double light_extent = 0.0);

/// The kernel of a technique that compares taps with a map; nullptr for others.
const FilterKernel* kernel_of(const ShadowTechnique& technique);

/// The technique that looks up a filtered map, alone or combined with screen-space shadows; nullptr for others.
const Prefiltered* prefiltered_of(const ShadowTechnique& technique);

/// The parameters of the pass that filters the shadow map before the look-up, of any technique. The others affect only
/// the look-up.
Parameters filtered_map_parameters(ShadowParams& params);

/// The parameters that only the look-up reads, of which one pass over the pixels can take many values
/// (draw_lookups() in raster/shadow/prefiltered_pass.h). Empty if the technique has no filtered map.
Parameters lookup_parameters(ShadowParams& params);

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique);

}  // namespace umbrameter
