// How a shadow map is drawn and what its texels store. Look-ups read the linear depth that the stored number stands
// for, so nothing here concerns them. docs/techniques/map-depth.md has the formulas and papers.
#pragma once

#include "core/math.h"
#include "core/parameters.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/normal_offset.h"

namespace umbrameter {
namespace shared {

using glm::floatBitsToUint;
using glm::floor;
using glm::frexp;
using glm::ldexp;
using glm::max;
using glm::roundEven;
using glm::uint;
using glm::uintBitsToFloat;

// Which number stands for a depth. The first two are linear.
inline constexpr int DEPTH_LINEAR = 0;
inline constexpr int DEPTH_REVERSED_LINEAR = 1;
inline constexpr int DEPTH_PERSPECTIVE = 2;
inline constexpr int DEPTH_REVERSED_PERSPECTIVE = 3;
// Of a warped map.
inline constexpr int DEPTH_OVER_W = 4;
inline constexpr int DEPTH_REVERSED_OVER_W = 5;

#define SHARED inline
#define PRECISE
#include "techniques/shadow/map_depth.glsl"
#undef PRECISE
#undef SHARED

}  // namespace shared

/// OpenGL has no depth texture of 16-bit floats: f16 and f16_down are drawn as f32 and rounded by nearest_half() and
/// half_below() when they are read.
enum class MapDepthFormat : int { f32, f16, f16_down, fixed24, fixed16 };
inline bool stores_floats(MapDepthFormat format) { return format <= MapDepthFormat::f16_down; }

/// perspective and reversed are those of a projection matrix: of an orthographic one, perspective is linear, too, and
/// of a warped one the depth over w.
enum class DepthEncoding : int { linear, perspective, reversed };
/// The faces that cast, seen from the light. Both faces of double-sided materials always cast.
enum class CasterFaces : int { all, front, back };
/// The surface whose depth the map holds; from the first two layers that the light's ray through a texel meets.
enum class StoredSurface : int { nearest, midpoint, second, dual };

/// How look-ups compute the depth of a receiver in a spot light's map with the perspective encoding. full: in double
/// precision. single: as engines do it, by a matrix and a division in 32-bit floats, whose error grows with the square
/// of the depth over the near plane.
enum class ReceiverPrecision : int { full, single };

/// Of a receiver in single precision and a stored depth that are the same number: less_equal is lit, less is not.
enum class DepthComparison : int { less_equal, less };

/// The map of a point light.
enum class PointMap : int { cube, paraboloid };

/// The nearest and the farthest depth in a map, metres.
struct DepthRange {
  double nearest = 0.0;
  double farthest = 0.0;
};

struct MapDepthParams {
  MapDepthFormat format = MapDepthFormat::f32;
  DepthEncoding encoding = DepthEncoding::linear;
  double near_depth = 0.1;  ///< metres; of perspective encodings
  double far_depth = 0.0;   ///< metres; of perspective encodings; 0: MapLayout::far_depth
  ReceiverPrecision receiver_precision = ReceiverPrecision::full;
  DepthComparison comparison = DepthComparison::less_equal;
  CasterFaces faces = CasterFaces::all;
  StoredSurface surface = StoredSurface::nearest;
  double dual_offset = 0.02;           ///< metres
  double polygon_offset_factor = 0.0;  ///< times the largest slope of the stored depth per texel
  double polygon_offset_units = 0.0;   ///< times the format's unit
  NormalOffset caster_offset;
  PointMap point_map = PointMap::cube;
  bool cube_passes = false;
};
Parameters describe(MapDepthParams& params);
/// Those that have an effect; some only for some kinds of light.
Parameters read_parameters(MapDepthParams& params);

/// The layout of a point light's map of that kind, from that of its cube map. Others stay as they are.
MapLayout with_point_map(MapLayout layout, PointMap point_map);

/// The layout of a map that stores its depth so.
MapLayout with_depth_encoding(MapLayout layout, const MapDepthParams& params);

/// The last two rows of the matrix from the world to the clip space of a spot light's map, whose depth is from 0 to 1.
struct ClipRows {
  vec4 z{0.0f};
  vec4 w{0.0f};
};
ClipRows clip_rows(const MapLayout& layout);

/// One of the constants in `shared`.
int depth_mapping(const MapDepthParams& params, const MapLayout& layout);

/// Whether the map stores the depth as look-ups read it: linear, in 32-bit floats.
bool stores_linear_floats(const MapDepthParams& params, const MapLayout& layout);

bool has_polygon_offset(const MapDepthParams& params);

/// The difference between neighbouring depths that the map can store at this depth, metres; in cube maps that store a
/// perspective depth, at the centre of a face, and in warped maps that store it over w, in the middle row.
double depth_step(const MapDepthParams& params, const MapLayout& layout, double depth);

/// Throws Error (usage) naming a parameter if the parameters do not fit the map or one another.
void require_sense(const MapDepthParams& params, const MapLayout& layout);

}  // namespace umbrameter
