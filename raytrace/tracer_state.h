// The implementation of a Tracer, for raytrace/*.cpp alone.
#pragma once

#include <atomic>
#include <memory>
#include <type_traits>
#include <vector>

#include "raytrace/alpha_mask.h"
#include "raytrace/embree.h"
#include "raytrace/huge_geometry.h"
#include "raytrace/instance_error.h"
#include "raytrace/ray_lanes.h"
#include "raytrace/tracer.h"

namespace umbrameter {

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

struct InstanceInfo {
  bool is_shared = false;     ///< its mesh has a separate acceleration structure; otherwise it is stored in world space
  bool culls_back = false;    ///< primary rays pass through its back faces
  bool is_similar = true;     ///< the transform scales all directions alike
  double longest_edge = 0.0;  ///< of its triangles that are not huge, world, metres; for a shared mesh an upper bound
  OriginError origin_error;   ///< zero unless is_shared
  const HugeGeometry* huge = nullptr;  ///< its huge triangles; null without any
};

struct Tracer::State {
  explicit State(const Scene& traced) : scene(traced) {}
  const Scene& scene;
  std::atomic<std::int64_t> bytes{0};
  // Destroyed in reverse order: the scenes before their device, the device before the counter that it reports to.
  DevicePtr device;
  bool has_native_packets = false;                      ///< Embree traces packets of sixteen without splitting them
  std::vector<std::unique_ptr<AlphaMask>> alpha_masks;  ///< by material; null unless a mesh uses it as a mask
  std::vector<std::unique_ptr<MeshMask>> mesh_masks;    ///< by mesh; null unless its material is masked
  std::vector<std::unique_ptr<HugeGeometry>> huge;      ///< by mesh; null without huge triangles
  std::vector<ScenePtr> mesh_scenes;                    ///< by mesh; empty where the mesh is stored in world space
  /// Geometry id or instance id = index in Scene::instances. Geometries of huge triangles follow these.
  ScenePtr top;
  std::vector<InstanceInfo> instances;
  double longest_edge = 0.0;  ///< of all triangles that are not huge, world, metres; an upper bound
  BuildStatistics statistics;
  mutable std::atomic<std::uint64_t> rays_traced{0};
};

/// Throws Error (no_backend) when a call of this thread has failed since the last check.
void check(RTCDevice device, const char* step);

/// Fills mesh_scenes, top and instances. Throws Error when Embree fails or the user interrupts.
void build(Tracer::State& state, const Progress& progress);

/// A query for a packet of rays, with the data that its filter needs; ray.id is the lane.
struct RayQuery {
  embree::Query query;  // first: see embree.h
  const Tracer::State* state = nullptr;
  std::uint32_t own_instance[packet_width];
  std::uint32_t own_triangle[packet_width];
  bool is_primary = false;
  dvec3 primary_direction{0.0};
};

/// The filter callback, of a query and of masked geometries. A geometry's user data is its MeshMask, or null.
void filter_hit(const RTCFilterFunctionNArguments* arguments);

/// Sets a filter that rejects hits on the ray's own triangle, on transparent points of masked geometry, and on culled
/// back faces of primary rays.
void prepare(RayQuery& query, const Tracer::State& state, bool is_primary);

/// Whether a ray in this direction hits the back of the triangle.
bool is_back_facing(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, const dvec3& direction);

/// Whether a ray ignores a hit on this triangle: its own, or a culled back face of a primary ray.
inline bool is_ignored(const RayQuery& query, unsigned lane, std::uint32_t instance, std::uint32_t triangle) {
  if (query.is_primary) {
    return query.state->instances[instance].culls_back &&
           is_back_facing(query.state->scene, instance, triangle, query.primary_direction);
  }
  return instance == query.own_instance[lane] && triangle == query.own_triangle[lane];
}

/// Index into Scene::instances of a hit: the instance id for a shared mesh, otherwise the geometry id.
inline std::uint32_t instance_of(unsigned instance_id, unsigned geometry_id) {
  return instance_id != RTC_INVALID_GEOMETRY_ID ? instance_id : geometry_id;
}

struct NearestHit {
  std::uint32_t instance = no_id;  ///< no_id where nothing is hit
  std::uint32_t triangle = no_id;
  float distance = 0.0f;  ///< metres
};
/// Traces a single ray, with lane 0 of the query.
NearestHit nearest_hit(RayQuery& query, const vec3& origin, const vec3& direction, float reach);

/// Whether the filter is called for every hit, or only on masked geometry, for rays that cannot hit their own triangle.
/// The calls cost about half as much as the traversal.
inline void filter_every_hit(RayQuery& query, bool every) {
  embree::set_filter(query.query, every ? &filter_hit : nullptr);
}

}  // namespace umbrameter
