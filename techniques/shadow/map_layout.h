// The projection of a light's shadow map. It defines "depth", "texel" and "inside the map".
// The rasteriser draws with it; statistics and reports take lengths from it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/bounds.h"
#include "core/image.h"
#include "core/parameters.h"
#include "scenes/light.h"
#include "techniques/shadow/map_warp.h"
#include "techniques/shadow/normal_offset.h"

namespace umbrameter {

enum class MapKind : int { orthographic, perspective, cube, paraboloid };

/// Whether the map surrounds the light, so that depth is radial distance.
inline bool is_omnidirectional(MapKind kind) { return kind == MapKind::cube || kind == MapKind::paraboloid; }

/// Whether the map has a projection with a centre, for which perspective encodings differ from linear ones.
inline bool is_projective(MapKind kind) { return kind == MapKind::perspective || kind == MapKind::cube; }

/// One image of a shadow map: a layer of its texture.
struct MapView {
  dvec2 center{0.0};  ///< orthographic: centre of the image in light space, metres
  /// orthographic: metres; perspective and cube: tangent of half the opening angle; paraboloid: 1
  double half_extent = 1.0;
  double farthest = std::numeric_limits<double>::infinity();  ///< CascadeSelection::depth: largest view depth, metres
  double bias_factor = 1.0;                                   ///< of the constant bias; orthographic
  double range_share =
      1.0;  ///< depth range of which a bias in the map's depth is a share, over far_depth; orthographic
};

/// The cascade in which a position is looked up. map: the first that contains it. depth: the first whose farthest view
/// depth is no nearer.
enum class CascadeSelection : int { map, depth };

/// Maximum number of views: the size of the array in the shaders.
inline constexpr std::size_t max_map_views = 8;

/// Margin of a cascade in texels. With CascadeSelection::map, a cascade, except the last, is used only for positions at
/// least this far inside its border, so that all taps of a kernel lie on it.
inline constexpr int map_view_margin = 16;

/// Projection of one light's map.
///
/// Light space: origin at the light (orthographic: at the centre of the fitted box's near face), x right, y up,
/// −z the direction in which the light travels. Depth is in metres: along −z for orthographic and perspective maps,
/// radial distance for cube and paraboloid maps. Map coordinates (u, v) of a view run from 0 to 1 with v up.
///
/// Views: a perspective map has one; a cube map has six, its faces, whose axes are cube_face(); an orthographic map has
/// one or more (cascades). A paraboloid map has two: view 0 sees the hemisphere about −z, view 1 that about z, turned
/// about y. A direction at an angle θ to the axis of its hemisphere lies tan(θ/2) from the middle of the view, so that
/// the hemisphere fills the circle in the square.
///
/// Cascades can be blended over a share of their extent, by dithering: in this zone each pixel looks up one cascade,
/// its own or the next, so that taps stay comparisons with one map each. The pixel's threshold is dither_at().
struct MapLayout {
  MapKind kind = MapKind::orthographic;
  int resolution = 1024;        ///< texels along one side of a view
  dmat4 light_from_world{1.0};  ///< rigid
  double far_depth = 1.0;       ///< metres; every surface is nearer. Stored depth = depth / far_depth, at least 0.
  /// Near plane if the map stores the depth of a perspective projection, metres; 0: it stores a linear depth.
  double encoded_near = 0.0;
  double encoded_far = 0.0;       ///< far plane of that projection, metres; 0: far_depth
  bool rounds_receivers = false;  ///< the depth of receivers is that of depth_in_floats(), map_depth.glsl
  bool equal_is_lit = true;       ///< then: whether a receiver is lit whose number is the stored one
  std::vector<MapView> views = std::vector<MapView>(1);
  /// Of the only view of an orthographic map, whose centre and extent are then those of the square around its area.
  std::optional<MapWarp> warp;
  CascadeSelection selection = CascadeSelection::map;
  double blend = 0.0;  ///< share of a cascade's extent, 0 to 1
  /// CascadeSelection::depth: the view depth from which shadows fade until that of the last view, metres. By
  /// dithering, as cascades blend: a pixel is lit, or looks up the map.
  double fade_start = std::numeric_limits<double>::infinity();
  dvec4 view_depth_plane{0.0};      ///< the camera's view depth is xyz · position in light space + w, metres
  double nearest_view_depth = 0.0;  ///< where the range of the first cascade starts, metres
  /// The centres of the views are whole texels from the origin of light space, and vertices are drawn at whole 1/256
  /// texels, so that a view which moves with the camera samples exactly the same points.
  bool is_stable = false;
  /// Looks up the view beside the selected one instead: the next cascade, or the cube face across the nearest edge.
  bool uses_neighbour = false;
};

/// A shadow map in memory, one image per view, top row (v = 1) first.
struct ShadowMapImages {
  std::vector<Image<float>> depth;  ///< as stored: depth / MapLayout::far_depth; 1 where the light hits nothing
  std::vector<Image<std::uint32_t>> instance;
  std::vector<Image<std::uint32_t>> triangle;
};

/// Right, up and forward vector (the columns) of a cube map's face, 0 to 5 (+x −x +y −y +z −z), in light space.
dmat3 cube_face(int face);

/// "face +x" of a cube, "cascade 1", a paraboloid's "front" or "back"; empty where the map has one view only.
std::string view_name(const MapLayout& layout, std::size_t view);

/// How far surfaces stay from the ends of a map's depth range, metres, so that the shaders' single precision does not
/// round them out of it.
double rounding_room(const Bounds& bounds);

/// Directional: the smallest square around the bounds, aligned with the light's x and y. Spot: the outer cone.
/// Point: six faces around the light. One texel of margin keeps every receiver inside orthographic maps.
MapLayout fit_light(const Light& light, const Bounds& bounds, int resolution);

/// Threshold of a pixel for the blend of cascades, above 0 and below 1; row 0 is the top row. An 8×8 Bayer matrix, so
/// that 64 adjacent pixels take evenly spaced values. (B. E. Bayer, An Optimum Method for Two-Level Rendition of
/// Continuous-Tone Pictures, ICC 1973.)
double dither_at(std::uint32_t column, std::uint32_t row);

/// Index of the view in which a position (light space) is looked up by a pixel with this threshold; 0: no blending.
/// Always 0 for a cube or a paraboloid: all views have the same extent.
std::size_t view_of(const MapLayout& layout, const dvec3& local, double dither = 0.0);

/// The camera's view depth of a position (light space), metres.
double view_depth(const MapLayout& layout, const dvec3& local);

/// Whether a position (light space) belongs to a cascade other than the last. `inset` moves the cascade's border
/// inwards by this share of its extent.
bool is_in_cascade(const MapLayout& layout, std::size_t view, const dvec3& local, double inset);

/// Whether the shadow of a position (light space) has faded for a pixel with this threshold: beyond the share of the
/// fading range whose smoothstep is 1 − dither. Never with 0.
bool is_faded(const MapLayout& layout, const dvec3& local, double dither);

/// Depth of a world position, metres.
double depth_of(const MapLayout& layout, const dvec3& position);

/// Where the depth that the map stores is 1 or, reversed, 0: metres. Nothing beyond casts.
double far_end_of(const MapLayout& layout);

/// The change of a depth when the number that the map stores for it changes by one, metres.
double metres_per_map_depth(const MapLayout& layout, double depth);

/// Factor of a constant bias of this unit in an orthographic view.
double bias_factor(const MapView& view, LengthUnit unit);

/// Whether depths are compared as the map stores them, and not in metres.
bool compares_encoded(const MapLayout& layout, LengthUnit bias_unit);

/// Whether a constant bias can have this unit: not the map's depth in a cube whose faces store the depth of a
/// perspective projection, because a face's depth is not the distance from the light, nor in a map that stores it over
/// w.
bool takes_bias_unit(const MapLayout& layout, LengthUnit unit);
/// Throws Error (usage) unless it can.
void require_bias_unit(const MapLayout& layout, LengthUnit unit);

/// Whether all texels of a view have one size.
inline bool has_equal_texels(const MapLayout& layout) { return layout.kind == MapKind::orthographic && !layout.warp; }
/// Whether the size of a texel differs from pixel to pixel, so that texels are metres only on average.
inline bool texels_differ(const MapLayout& layout) { return !has_equal_texels(layout) || layout.views.size() > 1; }

/// Depth of a position in light space along the axis of the view that sees it, metres; not of a paraboloid map.
double axis_depth(const MapLayout& layout, const dvec3& local);

/// Side length of a texel at a world position, metres, without blending; of a warped map its longer side.
double texel_at(const MapLayout& layout, const dvec3& position);

/// The offset with the texels of OffsetTexel::middle in metres, where a map has texels of several sizes by its warp.
NormalOffset placed_offset(const MapLayout& layout, NormalOffset offset, OffsetTexel texel);

/// Whether the position falls on the map.
bool is_inside(const MapLayout& layout, const dvec3& position);

/// Why shadow statistics exclude a pixel; none for counted pixels.
enum class PixelExclusion : std::uint8_t { none, background, back_facing, outside_map, outside_cone, outside_range };

/// Why a surfel is excluded, or none. Tests first whether the geometric normal faces the light, then map, cone and
/// range; these refer to the centre of the light.
PixelExclusion exclusion_of(const Light& light, const MapLayout& layout, const dvec3& position,
                            const dvec3& geometric_normal);

}  // namespace umbrameter
