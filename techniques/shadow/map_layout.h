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

/// One image of a shadow map: a layer of its texture.
struct MapView {
  dvec2 center{0.0};         ///< orthographic: of the image in light space, metres
  double half_extent = 1.0;  ///< orthographic: metres; perspective and cube: tangent of half the opening
};

/// At most so many views; as many as shaders hold.
inline constexpr std::size_t max_map_views = 8;

/// A view that others follow serves only positions so many texels inside its border, so that the taps of a kernel stay
/// on it.
inline constexpr int map_view_margin = 16;

/// How one light's map lies over a scene.
///
/// Light space: origin at the light (orthographic: at the centre of the fitted box's near face), x right, y up,
/// −z the way the light travels. Depth is metres: along −z for orthographic and perspective maps, the radial
/// distance for cube maps. Map coordinates (u, v) of a view run from 0 to 1 with v up.
///
/// Views: of a perspective map one; of a cube its six faces, whose axes are cube_face(); of an orthographic map one or
/// more (cascades), of which the first that contains a position serves it.
struct MapLayout {
  MapKind kind = MapKind::orthographic;
  int resolution = 1024;        ///< texels along one side of a view
  dmat4 light_from_world{1.0};  ///< rigid
  double far_depth = 1.0;       ///< metres; every surface is nearer. What the stored depth is divided by.
  std::vector<MapView> views{MapView{}};
};

/// A shadow map in memory, one image a view, top row (v = 1) first.
struct ShadowMapImages {
  std::vector<Image<float>> depth;  ///< as stored: a share of MapLayout::far_depth; 1 where the light meets nothing
  std::vector<Image<std::uint32_t>> instance;
  std::vector<Image<std::uint32_t>> triangle;
};

/// Right, up and forward, as columns, of a cube map's face 0 to 5 (+x −x +y −y +z −z), light space.
dmat3 cube_face(int face);

/// Directional: the smallest square about the bounds along the light's own x and y. Spot: the outer cone.
/// Point: six faces about the light. One texel of margin keeps every receiver inside orthographic maps.
MapLayout fit_light(const Light& light, const Bounds& bounds, int resolution);

/// Index of the view that serves a position in light space. Of a cube always 0: its faces are alike.
std::size_t view_of(const MapLayout& layout, const dvec3& local);

/// Depth of a world position, metres.
double depth_of(const MapLayout& frame, const dvec3& position);

/// Length of one texel's side at a world position, metres.
double texel_at(const MapLayout& frame, const dvec3& position);

/// Whether the position falls on the map.
bool is_inside(const MapLayout& frame, const dvec3& position);

/// Why shadow statistics leave a pixel out; none where they count it.
enum class PixelExclusion : std::uint8_t { none, background, back_facing, outside_map, outside_cone, outside_range };

/// Of one surfel: whether it faces() the light by its geometric normal, then by map, cone and range,
/// which the middle of the light decides.
PixelExclusion exclusion_of(const Light& light, const MapLayout& frame, const dvec3& position,
                            const dvec3& geometric_normal);

}  // namespace umbrameter
