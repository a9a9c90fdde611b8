#include <algorithm>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

using GeometryPtr = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, decltype(&rtcReleaseGeometry)>;

// How far all commits are together, by the triangles that they hold.
struct BuildProgress {
  const Progress& report;
  double total = 0.0;
  double done = 0.0;
  std::mutex mutex;
};

struct CommitProgress {
  BuildProgress& all;
  double triangles = 0.0;
  double done = 0.0;
};

// With the mutex locked.
void advance(CommitProgress& own, double share) {
  const double done = std::max(own.done, std::min(share, 1.0) * own.triangles);
  own.all.done += done - own.done;
  own.done = done;
  if (own.all.report) own.all.report(own.all.total > 0.0 ? own.all.done / own.all.total : 1.0);
}

// Called by any of Embree's threads; false ends the build.
bool on_progress(void* user, double share) {
  if (is_interrupted()) return false;
  auto& own = *static_cast<CommitProgress*>(user);
  const std::unique_lock lock(own.all.mutex, std::try_to_lock);
  if (lock) advance(own, share);
  return true;
}

ScenePtr new_scene(RTCDevice device) {
  ScenePtr scene(rtcNewScene(device));
  // Robust: rays that pass through a shared edge hit one of the two triangles.
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | embree::query_filter_flag));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

void commit(RTCDevice device, RTCScene scene, BuildProgress& all, std::uint64_t triangles) {
  CommitProgress own{all, static_cast<double>(triangles), 0.0};
  rtcSetSceneProgressMonitorFunction(scene, on_progress, &own);
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  throw_if_interrupted();
  check(device, "build");
  const std::lock_guard lock(all.mutex);
  advance(own, 1.0);
}

// Vertices in mesh space, or moved to the world in double precision and rounded once.
void set_vertices(RTCDevice device, RTCGeometry geometry, const std::vector<vec3>& positions,
                  const dmat4& world_from_mesh) {
  static_assert(sizeof(vec3) == 3 * sizeof(float) && sizeof(uvec3) == 3 * sizeof(unsigned), "as Embree reads them");
  const bool is_moved = world_from_mesh != dmat4(1.0);
  // Embree reads sixteen bytes at the last vertex.
  const bool has_padding = positions.capacity() > positions.size();
  if (!is_moved && has_padding) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(vec3), positions.size());
    return;
  }
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), positions.size()));
  check(device, "vertices");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const vec3 position = is_moved ? vec3(world_from_mesh * dvec4(dvec3(positions[i]), 1.0)) : positions[i];
    for (int c = 0; c < 3; ++c) vertices[3 * i + static_cast<std::size_t>(c)] = position[c];
  }
}

void attach(RTCDevice device, RTCScene target, unsigned id, RTCGeometry geometry) {
  rtcSetGeometryMask(geometry, 0xffffffffu);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, id);
  check(device, "geometry");
}

bool is_masked(const Scene& scene, const Mesh& mesh) {
  return scene.materials[mesh.material].alpha_mode == AlphaMode::mask;
}

void make_masks(Tracer::State& state) {
  const Scene& scene = state.scene;
  state.alpha_masks.resize(scene.materials.size());
  state.mesh_masks.resize(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) {
    std::unique_ptr<AlphaMask>& mask = state.alpha_masks[mesh.material];
    if (mask == nullptr && is_masked(scene, mesh)) {
      mask = std::make_unique<AlphaMask>(scene, scene.materials[mesh.material]);
    }
  }
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    const Mesh& mesh = scene.meshes[m];
    const AlphaMask* const mask = state.alpha_masks[mesh.material].get();
    if (mask != nullptr) state.mesh_masks[m] = std::make_unique<MeshMask>(mesh, *mask);
  });
}

void attach_mesh(const Tracer::State& state, RTCScene target, unsigned id, std::size_t index,
                 const dmat4& world_from_mesh) {
  const RTCDevice device = state.device.get();
  const Mesh& mesh = state.scene.meshes[index];
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
  set_vertices(device, geometry.get(), mesh.positions, world_from_mesh);
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(uvec3), mesh.triangles.size());
  if (MeshMask* const mask = state.mesh_masks[index].get(); mask != nullptr) {
    rtcSetGeometryUserData(geometry.get(), mask);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_hit);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_hit);
  }
  attach(device, target, id, geometry.get());
}

void attach_instance(RTCDevice device, RTCScene target, unsigned id, RTCScene mesh_scene,
                     const dmat4& world_from_mesh) {
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE), &rtcReleaseGeometry);
  rtcSetGeometryInstancedScene(geometry.get(), mesh_scene);
  const mat4 transform(world_from_mesh);
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
  attach(device, target, id, geometry.get());
}

double longest_edge(const Mesh& mesh, const dmat4& world_from_mesh) {
  double longest = 0.0;
  for (const uvec3& triangle : mesh.triangles) {
    dvec3 corners[3];
    for (int c = 0; c < 3; ++c) {
      corners[c] = dvec3(world_from_mesh * dvec4(dvec3(mesh.positions[triangle[c]]), 1.0));
    }
    longest = std::max({longest, glm::length(corners[1] - corners[0]), glm::length(corners[2] - corners[1]),
                        glm::length(corners[0] - corners[2])});
  }
  return longest;
}

}  // namespace

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ExitCode::no_backend, std::string("Embree, ") + step, "out of memory", "use a smaller scene");
  }
  throw Error(ExitCode::no_backend, std::string("Embree, ") + step, "error " + std::to_string(static_cast<int>(error)),
              "check that Embree fits this processor");
}

void build(Tracer::State& state, const Progress& progress) {
  const Scene& scene = state.scene;
  const RTCDevice device = state.device.get();
  make_masks(state);
  std::vector<std::uint32_t> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  BuildProgress all{progress, 0.0, 0.0, {}};
  std::uint64_t in_world = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (uses[m] == 1) in_world += scene.meshes[m].triangles.size();
    if (uses[m] > 0) all.total += static_cast<double>(scene.meshes[m].triangles.size());
  }

  state.mesh_scenes.resize(scene.meshes.size());
  std::vector<double> edges(scene.meshes.size(), 0.0);
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    const Mesh& mesh = scene.meshes[m];
    if (uses[m] < 2 || mesh.triangles.empty()) return;
    edges[m] = longest_edge(mesh, dmat4(1.0));
    state.mesh_scenes[m] = new_scene(device);
    attach_mesh(state, state.mesh_scenes[m].get(), 0, m, dmat4(1.0));
    commit(device, state.mesh_scenes[m].get(), all, mesh.triangles.size());
  });

  state.top = new_scene(device);
  state.instances.resize(scene.instances.size());
  parallel_for(scene.instances.size(), [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.triangles.empty()) return;
    const RTCScene shared = state.mesh_scenes[instance.mesh].get();
    const auto id = static_cast<unsigned>(i);
    InstanceInfo& info = state.instances[i];
    info.is_shared = shared != nullptr;
    info.culls_back = !scene.materials[mesh.material].double_sided;
    if (shared != nullptr) {
      info.is_similar = is_similarity(instance.world_from_mesh);
      info.origin_error = origin_error(instance.world_from_mesh);
      info.longest_edge = edges[instance.mesh] * largest_stretch(instance.world_from_mesh);
      attach_instance(device, state.top.get(), id, shared, instance.world_from_mesh);
    } else {
      info.longest_edge = longest_edge(mesh, instance.world_from_mesh);
      attach_mesh(state, state.top.get(), id, instance.mesh, instance.world_from_mesh);
    }
  });
  commit(device, state.top.get(), all, in_world);
}

}  // namespace umbrameter
