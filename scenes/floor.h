// Whether a scene has a floor: something below its objects that receives their shadows.
#pragma once

#include "scenes/scene.h"

namespace umbrameter {

/// Whether the scene has a surface that faces up near its bottom at half or more of the places of its plan, the
/// bounding rectangle seen from above. Near is in the lower half of the height, and no higher than an eighth of the
/// plan's width. So has a plane, terrain or room with things in it; a figure, a vehicle, or a crate or table with
/// things on it by itself has not. A surface faces where the order of its vertices says, also if its material is
/// double-sided, because the underside of a body is no floor. The alpha of masks is ignored.
bool has_floor(const Scene& scene);

}  // namespace umbrameter
