// What the bias of a configuration depends on besides the scene: by how much the depth of the counted surfaces changes
// from texel to texel, the reach of the filter, and the steps of the stored depth.
#pragma once

#include <limits>

#include "compare/visibility.h"
#include "techniques/shadow/filter.h"
#include "techniques/shadow/map_depth.h"

namespace umbrameter {

/// NaN where a fact is not known.
struct BiasFacts {
  static constexpr double tolerance = 1e-3;  ///< relative difference of facts that count as equal

  /// |∂z/∂u| + |∂z/∂v| of the surface's depth z over the texel coordinates, metres per texel, that 90 % of the counted
  /// pixels do not exceed. On an orthographic map texel size · tan θ · (|cos ψ| + |sin ψ|), where ψ is the azimuth of
  /// the slope on the map.
  double depth_per_texel = std::numeric_limits<double>::quiet_NaN();
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< of the filter: reach_of(), texels
  double depth_step = 0.0;                                   ///< mean step of the stored depth at the receivers, metres
};

/// Texels from the centre of a kernel to its farthest tap: of a grid with n texels along a side (n − 1) / 2, of a disk
/// the radius times the largest distance of a point. NaN where a search finds the radius of each pixel.
double reach_of(const FilterKernel& kernel);

/// Change of the depth of a plane from texel to texel, as in BiasFacts; infinite if neighbouring texels do not see the
/// front of the plane. The normal and the position are in world space.
double depth_per_texel_at(const MapLayout& layout, const dvec3& position, const dvec3& normal);

/// Facts of a light's map at the counted pixels, of which at most 65,536, evenly spaced, are read. NaN without counted
/// pixels.
BiasFacts measure_facts(const GBuffer& gbuffer, const MapLayout& layout, const CountedPixels& counted,
                        const MapDepthParams& depth, const FilterKernel& kernel);

}  // namespace umbrameter
