// Converts lengths across shadow edges from pixels of the image to texels of the light's map and to metres along the
// surface.
#pragma once

#include "compare/metrics/metric.h"
#include "core/gbuffer.h"
#include "scenes/light.h"
#include "scenes/view.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Exact where the surface is a plane around the pixel, at any angle of view and light. Texels are those at the
/// receiver, and lengths in texels are perpendicular to the light's direction, where the map samples the edge. Refers
/// to the G-buffer, which must outlive the result.
EdgeScale edge_scale(const GBuffer& gbuffer, const View& view, const Light& light, const MapLayout& layout);

}  // namespace umbrameter
