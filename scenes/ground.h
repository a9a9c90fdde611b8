// The floor that scene.ground adds, for a scene that has nothing on which its shadow falls.
#pragma once

#include "scenes/scene.h"

namespace umbrameter {

/// Side of the ground, in diagonals of the scene's bounds. Its edge is 2.5 of them from its middle and the scene
/// reaches at most 0.5, so that the shadow of a sun has 2 diagonals: enough where the sun is atan(1/2), 27 degrees, or
/// more above the horizon, since no scene is higher than its diagonal.
inline constexpr double ground_diagonals = 5.0;

/// Adds a horizontal square that faces up, at the height of the scene's lowest point and below the middle of its
/// bounds, as its last instance, and a note with its size. It takes part in everything but bounds_of(). A scene of no
/// size gets none.
void add_ground(Scene& scene);

/// Bounds of the ground alone, flat; empty for a scene without one.
Bounds ground_of(const Scene& scene);

}  // namespace umbrameter
