// The passes of every kind of shadow technique: draw() computes the visibility; filter(), where there is one, draws
// before that what the look-ups read besides the shadow map.
#pragma once

#include <variant>

#include "raster/shadow/shadow_lookup.h"
#include "raster/shadow/shadow_map.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

/// A map, and what it was drawn from.
struct DrawnMap {
  const gl::Context& context;
  const UploadedScene& scene;
  const Light& light;
  const ShadowMap& map;
  MapDepthParams depth{};
};

/// The values of each texel, blurred along both axes: Prefiltered::groups layers per view.
struct FilteredMap {
  gl::Texture values;
};
FilteredMap filter(const DrawnMap& drawn, const Prefiltered& technique);

/// What filter() draws for a technique's look-ups; monostate for a technique without filter().
struct TechniqueMap {
  std::variant<std::monostate, FilteredMap> of_technique;
};

/// Depends only on the technique's parameters that filtered_map_parameters() lists.
TechniqueMap filter_map(const DrawnMap& drawn, const ShadowTechnique& technique);

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Pcf& technique);
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Prefiltered& technique);
/// lookup.view must be the view that the surfels belong to.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ScreenSpace& technique);
/// The smaller of both visibilities. Since that of the march is 0 or 1, it is their product too.
RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const ContactShadows& technique);

/// Looks up the shadow map at every surfel, and classifies each wrong tap by cause.
RasterVisibility draw_visibility(const gl::Context& context, const ShadowLookup& lookup);

}  // namespace umbrameter
