// Where a light is, which way it points, and which surfaces face it.
#pragma once

#include <string_view>

#include "scenes/scene.h"

namespace umbrameter {

/// "directional", "spot" or "point": the types of KHR_lights_punctual.
std::string_view kind_of(const Light& light);

/// The light's own x, y and z as columns, unit and at right angles: it shines along −z, and +y fixes the roll.
dmat3 axes_of(const Light& light);

/// Directional: the unit vector to the light, w = 0. Else the light's position, w = 1.
dvec4 homogeneous_position(const Light& light);

/// Unit vector from a world position to the light.
dvec3 to_light(const Light& light, const dvec3& position);

/// The light of a scene that has none: a sun from the direction (0.45, 1, 0.35).
Light default_sun();

/// Whether a surface of that place and normal faces the light: some part of it, where it has extent, however the light
/// is turned. Else visibility is 0 without asking what lies between, and the surfel counts as turned away.
bool faces(const Light& light, const dvec3& position, const dvec3& normal);

}  // namespace umbrameter
