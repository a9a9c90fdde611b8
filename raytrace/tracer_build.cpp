#include <algorithm>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "raytrace/huge_triangles.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

using GeometryPtr = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, decltype(&rtcReleaseGeometry)>;

// The progress of all commits together, by number of triangles.
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

// The mutex must be locked.
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

// Sets vertices in mesh space, or transformed to the world in double precision and rounded once.
void set_vertices(RTCDevice device, RTCGeometry geometry, const std::vector<vec3>& positions,
                  const dmat4& world_from_mesh) {
  static_assert(sizeof(vec3) == 3 * sizeof(float) && sizeof(uvec3) == 3 * sizeof(unsigned), "as Embree reads them");
  const bool is_moved = world_from_mesh != dmat4(1.0);
  // Embree reads sixteen bytes at each vertex, also at the last one.
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
    if (mask != nullptr) state.mesh_masks[m] = std::make_unique<MeshMask>(MeshMask{mesh, *mask});
  });
}

// Sets a geometry's triangles. Huge ones are replaced by degenerate triangles, which no ray hits, to keep the ids.
void set_triangles(RTCDevice device, RTCGeometry geometry, const Mesh& mesh, const HugeGeometry* huge) {
  if (huge == nullptr) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(uvec3), mesh.triangles.size());
    return;
  }
  auto* const indices = static_cast<uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), mesh.triangles.size()));
  check(device, "triangles");
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
  for (const HugeTriangle& triangle : huge->triangles) indices[triangle.id] = uvec3(indices[triangle.id].x);
}

void attach_mesh(const Tracer::State& state, RTCScene target, unsigned id, std::size_t index,
                 const dmat4& world_from_mesh, const HugeGeometry* huge) {
  const RTCDevice device = state.device.get();
  const Mesh& mesh = state.scene.meshes[index];
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
  set_vertices(device, geometry.get(), mesh.positions, world_from_mesh);
  set_triangles(device, geometry.get(), mesh, huge);
  if (MeshMask* const mask = state.mesh_masks[index].get(); mask != nullptr) {
    rtcSetGeometryUserData(geometry.get(), mask);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_hit);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_hit);
  }
  attach(device, target, id, geometry.get());
}

void attach_huge(RTCDevice device, RTCScene target, unsigned id, HugeGeometry& huge) {
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER), &rtcReleaseGeometry);
  set_huge_triangles(geometry.get(), huge);
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

// Where the scene's meshes are stored. A mesh with several instances has a separate Embree scene; any other is stored
// in world space.
struct Storage {
  std::vector<StoredMesh> meshes;   // by mesh; StoredMesh::mesh is null if no instance uses it
  std::vector<std::uint32_t> uses;  // by mesh
  std::vector<double> stretch;      // by instance: largest scale factor from a shared mesh's space to the world
  bool is_shared(std::size_t mesh) const { return uses[mesh] > 1; }
};

Storage find_storage(const Scene& scene) {
  Storage storage;
  storage.meshes.resize(scene.meshes.size());
  storage.uses.assign(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++storage.uses[instance.mesh];
  storage.stretch.assign(scene.instances.size(), 1.0);
  parallel_for(scene.instances.size(), [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    if (storage.is_shared(instance.mesh)) storage.stretch[i] = largest_stretch(instance.world_from_mesh);
  });
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const std::uint32_t mesh = scene.instances[i].mesh;
    StoredMesh& stored = storage.meshes[mesh];
    stored.stretch = stored.mesh == nullptr ? storage.stretch[i] : std::max(stored.stretch, storage.stretch[i]);
    stored.mesh = &scene.meshes[mesh];
    if (!storage.is_shared(mesh)) stored.placed = scene.instances[i].world_from_mesh;
  }
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    StoredMesh& stored = storage.meshes[m];
    if (stored.mesh == nullptr) return;
    stored.longest_edge = longest_edge(*stored.mesh, stored.placed, std::numeric_limits<double>::infinity());
  });
  return storage;
}

// Separates the huge triangles from the meshes, and updates the longest edges of the meshes.
void find_huge(Tracer::State& state, Storage& storage) {
  const double huge_from = huge_edge(storage.meshes);
  state.huge.resize(storage.meshes.size());
  parallel_for(storage.meshes.size(), [&](std::size_t m) {
    StoredMesh& stored = storage.meshes[m];
    if (stored.mesh == nullptr) return;
    std::vector<HugeTriangle> triangles = huge_triangles(stored, huge_from);
    if (triangles.empty()) return;
    stored.longest_edge = longest_edge(*stored.mesh, stored.placed, huge_from / stored.stretch);
    state.huge[m] = std::make_unique<HugeGeometry>();
    state.huge[m]->triangles = std::move(triangles);
    state.huge[m]->mask = state.mesh_masks[m].get();
  });
  for (std::size_t i = 0; i < state.scene.instances.size(); ++i) {
    const std::uint32_t mesh = state.scene.instances[i].mesh;
    if (state.huge[mesh] != nullptr) state.huge[mesh]->instance = static_cast<std::uint32_t>(i);
  }
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
  Storage storage = find_storage(scene);
  find_huge(state, storage);
  BuildProgress all{progress, 0.0, 0.0, {}};
  std::uint64_t in_world = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (storage.uses[m] == 1) in_world += scene.meshes[m].triangles.size();
    if (storage.uses[m] > 0) all.total += static_cast<double>(scene.meshes[m].triangles.size());
  }

  state.mesh_scenes.resize(scene.meshes.size());
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    const Mesh& mesh = scene.meshes[m];
    if (!storage.is_shared(m) || mesh.triangles.empty()) return;
    state.mesh_scenes[m] = new_scene(device);
    const RTCScene target = state.mesh_scenes[m].get();
    attach_mesh(state, target, 0, m, dmat4(1.0), state.huge[m].get());
    if (state.huge[m] != nullptr) attach_huge(device, target, 1, *state.huge[m]);
    commit(device, target, all, mesh.triangles.size());
  });

  state.top = new_scene(device);
  state.instances.resize(scene.instances.size());
  parallel_for(scene.instances.size(), [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.triangles.empty()) return;
    const RTCScene shared = state.mesh_scenes[instance.mesh].get();
    const auto id = static_cast<unsigned>(i);
    HugeGeometry* const huge = state.huge[instance.mesh].get();
    InstanceInfo& info = state.instances[i];
    info.is_shared = shared != nullptr;
    info.culls_back = !scene.materials[mesh.material].double_sided;
    info.longest_edge = storage.meshes[instance.mesh].longest_edge * storage.stretch[i];
    info.huge = huge;
    if (shared != nullptr) {
      info.is_similar = is_similarity(instance.world_from_mesh);
      info.origin_error = origin_error(instance.world_from_mesh);
      attach_instance(device, state.top.get(), id, shared, instance.world_from_mesh);
    } else {
      attach_mesh(state, state.top.get(), id, instance.mesh, instance.world_from_mesh, huge);
      if (huge != nullptr) {
        attach_huge(device, state.top.get(), static_cast<unsigned>(scene.instances.size()) + id, *huge);
      }
    }
  });
  for (const InstanceInfo& info : state.instances) state.longest_edge = std::max(state.longest_edge, info.longest_edge);
  commit(device, state.top.get(), all, in_world);
}

}  // namespace umbrameter
