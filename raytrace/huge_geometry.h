// Huge triangles as an Embree user geometry, which our own code intersects. For raytrace/*.cpp alone.
#pragma once

#include "raytrace/embree.h"
#include "raytrace/huge_triangles.h"

namespace umbrameter {

struct MeshMask;

/// The huge triangles of a mesh. Hits report their instance and their triangle ids in the scene, as for other
/// triangles.
struct HugeGeometry {
  std::vector<HugeTriangle> triangles;  ///< sorted by id
  std::uint32_t instance = 0;           ///< reported by hits, unless the mesh is shared: then Embree reports it
  const MeshMask* mask = nullptr;       ///< null unless the material is masked
  bool has(std::uint32_t triangle) const;
};

/// Sets the triangles of a geometry of type RTC_GEOMETRY_TYPE_USER. They must outlive it.
void set_huge_triangles(RTCGeometry geometry, HugeGeometry& huge);

}  // namespace umbrameter
