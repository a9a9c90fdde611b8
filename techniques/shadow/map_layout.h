// How a light's shadow map is laid over the world: what "depth", "texel" and "inside the map" mean.
// The rasteriser draws by it; statistics and reports read lengths from it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bounds.h"
#include "core/image.h"
#include "scenes/light.h"

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

/// A shadow map in memory, one image a face, top row (v = 1) first.
struct ShadowMapImages {
  std::vector<Image<float>> depth;  ///< as stored: a share of LightFrame::far_depth; 1 where the light meets nothing
  std::vector<Image<std::uint32_t>> instance;
  std::vector<Image<std::uint32_t>> triangle;
};

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

/// Why a pixel is counted in shadow statistics, or not.
enum class Counting : std::uint8_t { counted, background, turned_away, outside_map, outside_cone, outside_range };

/// The counting class of one surfel: whether it faces() the light by its geometric normal, then by map, cone and range,
/// which the middle of the light decides.
Counting counting_of(const Light& light, const LightFrame& frame, const dvec3& position, const dvec3& geometric_normal);

}  // namespace umbrameter
