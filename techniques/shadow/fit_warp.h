// Light-space perspective shadow maps: the warp that spreads a directional light's texels as the camera sees them.
#pragma once

#include "techniques/shadow/cascades.h"

namespace umbrameter {

/// Turns the layout's light space about the light until y points along the camera's view, and warps its only view
/// around the surfels. (M. Wimmer, D. Scherzer and W. Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004, with
/// the near plane of Filament's applyLISPSM(), ShadowMap.cpp at 0362f36.) The layout stays as it is if the camera is
/// orthographic, if it looks within about a degree along the light, or if fit.warp_near is two thirds of the range of
/// depths or more. `nearest`: the depth at which those start that the map may store over w, metres; the farthest surfel
/// ends them.
void warp_map(MapLayout& layout, const SeenPart& seen, const MapFitParams& fit, double nearest);

}  // namespace umbrameter
