// Scenes far from their origin, which single precision cannot hold.
#pragma once

#include "scenes/scene.h"

namespace umbrameter {

/// How many times farther than the scene's radius a coordinate may reach before it is moved. Single precision rounds a
/// coordinate of 64 radii by 64 · 2^-24 radii, 1/32 of a texel (2/16384 radii) of the largest shadow map. Nearer scenes
/// stay as they are, to the last bit.
inline constexpr double max_radii_from_origin = 64.0;

/// Moves the scene to its origin, in double precision, along each axis on which its centre is more than
/// max_radii_from_origin radii away: instances, cameras and lights. Scene::origin says by how much. A mesh whose own
/// vertices are that far from the mesh's origin is moved there, and its instances the other way.
/// Notes the way, and the steps in which positions were stored where these cannot be undone: vertices that are far away
/// by themselves are single-precision numbers.
void move_to_centre(Scene& scene);

}  // namespace umbrameter
