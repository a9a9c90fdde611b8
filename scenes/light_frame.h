// How a light's shadow map is laid over the world: what "depth", "texel" and "inside the map" mean.
// The rasteriser draws by it; statistics and reports read lengths from it.
#pragma once

#include <cstdint>

#include "core/bounds.h"
#include "scenes/scene.h"

namespace umbrameter {

enum class MapKind : int { orthographic, perspective, cube };

/// The fit of one light's map to a scene.
///
/// Light space: origin at the light (orthographic: at the centre of the fitted box's near face), x right, y up,
/// −z the way the light travels. Depth is metres: along −z for orthographic and perspective maps, the radial
/// distance for cube maps. Map coordinates (u, v) run from 0 to 1 with v up.
struct LightFrame {
  MapKind kind = MapKind::orthographic;
  int resolution = 1024;        ///< texels along one side (of one face, for a cube)
  dmat4 light_from_world{1.0};  ///< rigid
  double half_extent = 1.0;     ///< orthographic: metres; perspective and cube: tangent of half the opening
  double far_depth = 1.0;       ///< metres; every surface is nearer. What the stored depth is divided by.
};

/// The light's own x, y and z as columns, unit and at right angles: it shines along −z, and +y fixes the roll.
dmat3 axes_of(const Light& light);

/// Right, up and forward, as columns, of a cube map's face 0 to 5 (+x −x +y −y +z −z), light space.
dmat3 cube_face(int face);

/// Directional: the smallest square about the bounds along the light's own x and y. Spot: the outer cone.
/// Point: six faces about the light. One texel of margin keeps every receiver inside orthographic maps.
LightFrame fit_light(const Light& light, const Bounds& bounds, int resolution);

/// Depth of a world position, metres.
double depth_of(const LightFrame& frame, const dvec3& position);

/// Length of one texel's side at a world position, metres.
double texel_at(const LightFrame& frame, const dvec3& position);

/// Whether the position falls on the map.
bool is_inside(const LightFrame& frame, const dvec3& position);

/// Directional: the unit vector to the light, w = 0. Else the light's position, w = 1.
dvec4 homogeneous_place(const Light& light);

/// Unit vector from a world position to the light.
dvec3 to_light(const Light& light, const dvec3& position);

/// Whether a surface of that place and normal faces the light: some part of it, where it has extent, however the light
/// is turned. Else visibility is 0 without asking what lies between, and the surfel counts as turned away.
bool faces(const Light& light, const dvec3& position, const dvec3& normal);

/// Why a pixel is counted in shadow statistics, or not.
enum class Counting : std::uint8_t { counted, background, turned_away, outside_map, outside_cone, outside_range };

/// The counting class of one surfel: whether it faces() the light by its geometric normal, then by map, cone and range,
/// which the middle of the light decides.
Counting counting_of(const Light& light, const LightFrame& frame, const dvec3& position, const dvec3& geometric_normal);

}  // namespace umbrameter
