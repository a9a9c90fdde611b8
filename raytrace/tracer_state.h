// What a Tracer holds, for raytrace/*.cpp alone.
#pragma once

#include <atomic>
#include <memory>
#include <type_traits>
#include <vector>

#include "raytrace/alpha_mask.h"
#include "raytrace/embree.h"
#include "raytrace/huge_geometry.h"
#include "raytrace/placement.h"
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
  bool is_shared = false;     ///< its mesh has an acceleration structure of its own; else it is stored in world space
  bool culls_back = false;    ///< primary rays pass through its back faces
  bool is_similar = true;     ///< the mesh is scaled alike in every direction
  double longest_edge = 0.0;  ///< of its triangles that are not huge, world, metres; of a shared mesh an upper bound
  OriginError origin_error;   ///< zero unless is_shared
  const HugeGeometry* huge = nullptr;  ///< its huge triangles; null without any
};

struct Tracer::State {
  explicit State(const Scene& traced) : scene(traced) {}
  const Scene& scene;
  std::atomic<std::int64_t> bytes{0};
  // In this order: scenes go before their device, the device before the counter that it reports to.
  DevicePtr device;
  bool takes_16_lanes = false;                          ///< Embree traces packets of sixteen as they are, not in parts
  std::vector<std::unique_ptr<AlphaMask>> alpha_masks;  ///< by material; null unless it masks a mesh
  std::vector<std::unique_ptr<MeshMask>> mesh_masks;    ///< by mesh; likewise
  std::vector<std::unique_ptr<HugeGeometry>> huge;      ///< as HugeTriangles are stored; those without any are null
  std::vector<ScenePtr> mesh_scenes;                    ///< by mesh; empty where the mesh is stored in world space
  /// Geometry id or instance id = index in Scene::instances; huge triangles have geometries behind those.
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

/// A packet of rays and what its filter needs to know of them; ray.id is the lane.
struct RayQuery {
  embree::Query query;  // first: see embree.h
  const Tracer::State* state = nullptr;
  std::uint32_t own_instance[packet_width];
  std::uint32_t own_triangle[packet_width];
  bool is_primary = false;
  dvec3 primary_direction{0.0};
};

/// What prepare() sets, and what masked geometry runs for every ray. A masked geometry's user data is its MeshMask, any
/// other's is null.
void filter_hit(const RTCFilterFunctionNArguments* arguments);

/// Lets a hit count unless it is the ray's own triangle, a masked-out point, or a culled back face of a primary ray.
void prepare(RayQuery& query, const Tracer::State& state, bool is_primary);

/// Whether a front side is turned away from a ray.
bool shows_back(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, const dvec3& direction);

/// Whether a ray goes through a triangle that it meets: its own, or a culled back face of a primary ray.
inline bool is_passed(const RayQuery& query, unsigned lane, std::uint32_t instance, std::uint32_t triangle) {
  if (query.is_primary) {
    return query.state->instances[instance].culls_back &&
           shows_back(query.state->scene, instance, triangle, query.primary_direction);
  }
  return instance == query.own_instance[lane] && triangle == query.own_triangle[lane];
}

/// Index into Scene::instances by the two ids of a hit: a shared mesh is hit as an instance, any other as a geometry.
inline std::uint32_t instance_of(unsigned instance_id, unsigned geometry_id) {
  return instance_id != RTC_INVALID_GEOMETRY_ID ? instance_id : geometry_id;
}

struct NearestHit {
  std::uint32_t instance = no_id;  ///< no_id where nothing is hit
  std::uint32_t triangle = no_id;
  float distance = 0.0f;  ///< metres
};
/// Of one ray, as lane 0 of the query.
NearestHit nearest_hit(RayQuery& query, const vec3& origin, const vec3& direction, float reach);

/// Without, rays are asked about masked geometry alone: the caller knows that none meets its own triangle.
/// Calls back cost about as much as half the traversal.
inline void filter_every_hit(RayQuery& query, bool every) {
  embree::set_filter(query.query, every ? &filter_hit : nullptr);
}

}  // namespace umbrameter
