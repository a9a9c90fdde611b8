#include "raytrace/tracer.h"

#include <chrono>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

bool on_memory(void* counter, ssize_t bytes, bool /*after*/) {
  *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
  return true;
}

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ExitCode::no_backend, std::string("Embree, ") + step, "out of memory", "use a smaller scene");
  }
  throw Error(ExitCode::no_backend, std::string("Embree, ") + step, "error " + std::to_string(static_cast<int>(error)),
              "check that Embree fits this processor");
}

using GeometryPtr = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, decltype(&rtcReleaseGeometry)>;

// Vertices in mesh space, or moved to the world in double precision and rounded once.
void attach_mesh(RTCDevice device, RTCScene target, unsigned id, const Mesh& mesh, const dmat4* world_from_mesh) {
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  check(device, "geometry buffers");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    vec3 position = mesh.positions[i];
    if (world_from_mesh != nullptr) position = vec3(*world_from_mesh * dvec4(dvec3(position), 1.0));
    for (int c = 0; c < 3; ++c) vertices[3 * i + static_cast<std::size_t>(c)] = position[c];
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int c = 0; c < 3; ++c) indices[3 * i + static_cast<std::size_t>(c)] = mesh.triangles[i][c];
  }
  rtcSetGeometryMask(geometry.get(), 0xffffffffu);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(target, geometry.get(), id);
}

void attach_instance(RTCDevice device, RTCScene target, unsigned id, RTCScene mesh_scene,
                     const dmat4& world_from_mesh) {
  const GeometryPtr geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE), &rtcReleaseGeometry);
  rtcSetGeometryInstancedScene(geometry.get(), mesh_scene);
  const mat4 transform(world_from_mesh);
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
  rtcSetGeometryMask(geometry.get(), 0xffffffffu);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(target, geometry.get(), id);
}

ScenePtr new_scene(RTCDevice device) {
  ScenePtr scene(rtcNewScene(device));
  // Robust: rays that pass through a shared edge hit one of the two triangles.
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | embree::query_filter_flag));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

double longest_edge(const Scene& scene, std::uint32_t instance) {
  double longest = 0.0;
  const std::size_t triangles = scene.meshes[scene.instances[instance].mesh].triangles.size();
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const Triangle corners = world_triangle(scene, instance, t);
    longest = std::max({longest, glm::length(corners.b - corners.a), glm::length(corners.c - corners.b),
                        glm::length(corners.a - corners.c)});
  }
  return longest;
}

InstanceInfo describe_instance(const Scene& scene, std::uint32_t instance, bool is_shared) {
  const Material& material = scene.materials[scene.meshes[scene.instances[instance].mesh].material];
  return {is_shared, material.alpha_mode == AlphaMode::mask, !material.double_sided, longest_edge(scene, instance)};
}

struct FilteredHit {
  std::uint32_t instance;
  std::uint32_t triangle;
  vec2 barycentric;
};

bool is_masked_out(const Scene& scene, const FilteredHit& hit) {
  const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
  const Material& material = scene.materials[mesh.material];
  vec2 texcoord(0);
  if (!mesh.texcoords.empty()) {
    const uvec3 v = mesh.triangles[hit.triangle];
    texcoord = (1.0f - hit.barycentric.x - hit.barycentric.y) * mesh.texcoords[v.x] +
               hit.barycentric.x * mesh.texcoords[v.y] + hit.barycentric.y * mesh.texcoords[v.z];
  }
  return alpha_at(scene, material, texcoord) < material.alpha_cutoff;
}

bool shows_back(const Scene& scene, const FilteredHit& hit, const dvec3& direction) {
  const Triangle t = world_triangle(scene, hit.instance, hit.triangle);
  const bool turns_away = glm::dot(glm::cross(t.b - t.a, t.c - t.a), direction) > 0.0;
  return turns_away != is_mirrored(scene.instances[hit.instance].world_from_mesh);
}

void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto* query = reinterpret_cast<const RayQuery*>(arguments->context);
  const Tracer::State& state = *query->state;
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] != -1) continue;
    const unsigned shared = RTCHitN_instID(arguments->hit, n, i, 0);
    const FilteredHit hit{shared != RTC_INVALID_GEOMETRY_ID ? shared : RTCHitN_geomID(arguments->hit, n, i),
                          RTCHitN_primID(arguments->hit, n, i),
                          {RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i)}};
    const InstanceInfo& info = state.instances[hit.instance];
    const unsigned lane = RTCRayN_id(arguments->ray, n, i);
    bool counts = true;
    if (query->is_primary) {
      counts = !info.culls_back || !shows_back(state.scene, hit, query->primary_direction);
    } else {
      counts = hit.instance != query->own_instance[lane] || hit.triangle != query->own_triangle[lane];
    }
    if (counts && info.is_masked) counts = !is_masked_out(state.scene, hit);
    if (!counts) arguments->valid[i] = 0;
  }
}

}  // namespace

void prepare(RayQuery& query, const Tracer::State& state, bool is_primary) {
  static_assert(std::is_standard_layout_v<RayQuery>, "the filter recovers it from a pointer to its first member");
  embree::prepare(query.query, filter);
  query.state = &state;
  query.is_primary = is_primary;
}

std::string embree_version() { return RTC_VERSION_STRING; }

Tracer::Tracer(const Scene& scene) : state_(std::make_unique<State>(scene)) {
  const auto start = std::chrono::steady_clock::now();
  State& state = *state_;
  // Embree builds on TBB, whose threads are limited by ThreadLimit.
  state.device.reset(rtcNewDevice(nullptr));
  if (state.device == nullptr) {
    check(nullptr, "start");
    throw Error(ExitCode::no_backend, "Embree, start", "no device", "check that Embree fits this processor");
  }
  rtcSetDeviceMemoryMonitorFunction(state.device.get(), on_memory, &state.bytes);

  std::vector<int> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  state.mesh_scenes.resize(scene.meshes.size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    throw_if_interrupted();
    if (uses[m] < 2) continue;
    state.mesh_scenes[m] = new_scene(state.device.get());
    attach_mesh(state.device.get(), state.mesh_scenes[m].get(), 0, scene.meshes[m], nullptr);
    rtcCommitScene(state.mesh_scenes[m].get());
  }
  state.top = new_scene(state.device.get());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    throw_if_interrupted();
    const Instance& instance = scene.instances[i];
    const RTCScene shared = state.mesh_scenes[instance.mesh].get();
    state.instances.push_back(describe_instance(scene, i, shared != nullptr));
    if (shared != nullptr) {
      attach_instance(state.device.get(), state.top.get(), i, shared, instance.world_from_mesh);
    } else {
      attach_mesh(state.device.get(), state.top.get(), i, scene.meshes[instance.mesh], &instance.world_from_mesh);
    }
  }
  rtcCommitScene(state.top.get());
  check(state.device.get(), "build");
  state.statistics = {count(scene).triangles,
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                      static_cast<std::uint64_t>(state.bytes.load())};
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

const Scene& Tracer::scene() const { return state_->scene; }
const BuildStatistics& Tracer::build_statistics() const { return state_->statistics; }

}  // namespace umbrameter
