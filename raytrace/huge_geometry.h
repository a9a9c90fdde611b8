// Huge triangles as Embree sees them: a geometry whose test is ours. For raytrace/*.cpp alone.
#pragma once

#include "raytrace/embree.h"
#include "raytrace/huge_triangles.h"

namespace umbrameter {

class MeshMask;

/// Huge triangles that are stored together. Hits on them report the instance and the triangle that they are in the
/// scene, like hits on any other.
struct HugeGeometry {
  std::vector<HugeTriangle> triangles;  ///< by id
  std::uint32_t instance = 0;           ///< that hits report; of a shared mesh Embree knows it
  const MeshMask* mask = nullptr;       ///< null unless the material is masked
  bool has(std::uint32_t triangle) const;
};

/// Gives the geometry, which must be of type RTC_GEOMETRY_TYPE_USER, its triangles, which must outlive it.
void set_huge_triangles(RTCGeometry geometry, HugeGeometry& huge);

}  // namespace umbrameter
