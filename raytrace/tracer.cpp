#include "raytrace/tracer.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <string>

#include "core/error.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {
namespace {

bool on_memory(void* counter, ssize_t bytes, bool /*after*/) {
  *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
  return true;
}

bool is_accepted(const RTCFilterFunctionNArguments& arguments, const RayQuery& query, unsigned i) {
  const unsigned n = arguments.N;
  const std::uint32_t instance =
      instance_of(RTCHitN_instID(arguments.hit, n, i, 0), RTCHitN_geomID(arguments.hit, n, i));
  const std::uint32_t triangle = RTCHitN_primID(arguments.hit, n, i);
  if (is_ignored(query, RTCRayN_id(arguments.ray, n, i), instance, triangle)) return false;
  const auto* mask = static_cast<const MeshMask*>(arguments.geometryUserPtr);
  return mask == nullptr || mask->is_opaque(triangle, {RTCHitN_u(arguments.hit, n, i), RTCHitN_v(arguments.hit, n, i)});
}

// A bit mask of the active lanes, of 1, 4, 8 or 16; Embree sets active ones to −1 and others to 0. Mostly one lane is
// active, and a loop over all lanes would mispredict which one.
template <unsigned n>
unsigned active_lanes(const int* valid) {
  unsigned lanes = 0;
  for (unsigned i = 0; i < n; ++i) lanes |= static_cast<unsigned>(valid[i]) & (1u << i);
  return lanes;
}

}  // namespace

bool is_back_facing(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, const dvec3& direction) {
  const Triangle t = world_triangle(scene, instance, triangle);
  const bool turns_away = glm::dot(glm::cross(t.b - t.a, t.c - t.a), direction) > 0.0;
  return turns_away != is_mirrored(scene.instances[instance].world_from_mesh);
}

void filter_hit(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const RayQuery*>(arguments->context);
  int* const valid = arguments->valid;
  const unsigned n = arguments->N;
  unsigned lanes = n == 16  ? active_lanes<16>(valid)
                   : n == 8 ? active_lanes<8>(valid)
                   : n == 4 ? active_lanes<4>(valid)
                            : active_lanes<1>(valid);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(lanes));
    if (!is_accepted(*arguments, query, i)) valid[i] = 0;
  }
}

void prepare(RayQuery& query, const Tracer::State& state, bool is_primary) {
  static_assert(std::is_standard_layout_v<RayQuery>, "the filter recovers it from a pointer to its first member");
  embree::prepare(query.query, filter_hit);
  query.state = &state;
  query.is_primary = is_primary;
}

NearestHit nearest_hit(RayQuery& query, const vec3& origin, const vec3& direction, float reach) {
  RTCRayHit hit;
  hit.ray.org_x = origin.x;
  hit.ray.org_y = origin.y;
  hit.ray.org_z = origin.z;
  hit.ray.dir_x = direction.x;
  hit.ray.dir_y = direction.y;
  hit.ray.dir_z = direction.z;
  hit.ray.tnear = 0.0f;
  hit.ray.tfar = reach;
  hit.ray.time = 0.0f;
  hit.ray.mask = 0xffffffffu;
  hit.ray.id = 0;
  hit.ray.flags = 0;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect1(query.state->top.get(), hit, query.query);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {instance_of(hit.hit.instID[0], hit.hit.geomID), hit.hit.primID, hit.ray.tfar};
}

std::string embree_version() { return RTC_VERSION_STRING; }

std::string loaded_embree_version() {
  const DevicePtr device(rtcNewDevice(nullptr));
  check(device.get(), "start");
  return std::to_string(rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_VERSION));
}

Tracer::Tracer(const Scene& scene, const Progress& progress) : state_(std::make_unique<State>(scene)) {
  const auto start = std::chrono::steady_clock::now();
  State& state = *state_;
  // Embree builds on TBB, whose threads are limited by ThreadLimit.
  state.device.reset(rtcNewDevice(nullptr));
  check(state.device.get(), "start");
  if (state.device == nullptr) {
    throw Error(ExitCode::no_backend, "Embree, start", "no device", "check that Embree fits this processor");
  }
  state.has_native_packets = rtcGetDeviceProperty(state.device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  rtcSetDeviceMemoryMonitorFunction(state.device.get(), on_memory, &state.bytes);
  build(state, progress);
  state.statistics = {count(scene).triangles,
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                      static_cast<std::uint64_t>(state.bytes.load())};
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

const Scene& Tracer::scene() const { return state_->scene; }
const BuildStatistics& Tracer::build_statistics() const { return state_->statistics; }
std::uint64_t Tracer::rays_traced() const { return state_->rays_traced.load(); }

}  // namespace umbrameter
