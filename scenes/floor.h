// Whether a scene has a floor: something below its objects that receives their shadows.
#pragma once

#include "scenes/scene.h"

namespace umbrameter {

/// Whether the scene has a surface that faces up in its lower half of height at half or more of the places of its plan,
/// the bounding rectangle seen from above. So has a plane, terrain or room with things in it; a figure, a helmet or a
/// vehicle by itself has not: below its upper half little faces up. A surface faces where the order of its vertices
/// says, also if its material is double-sided, because the underside of a body is no floor. The alpha of masks is
/// ignored.
bool has_floor(const Scene& scene);

}  // namespace umbrameter
