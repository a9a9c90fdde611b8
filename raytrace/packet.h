// Packets of rays that Embree traces together. For raytrace/*.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "raytrace/ray_lanes.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {

struct ShadowRay {
  vec3 origin{0};
  vec3 direction{0, 0, 1};  ///< unit
  float reach = 0;          ///< metres; hits beyond do not block
  bool is_clear = false;    ///< it cannot hit its own triangle
};

/// Reach of a ray to a light at this distance, metres. The ray ends before the light by the rounding error of its
/// length, so that the light's own geometry does not block it.
inline float reach_to_light(double distance) { return static_cast<float>(distance * (1.0 - 0x1p-22)); }

/// Rays as a structure of arrays. Zeroed, because Embree requires finite numbers in unused lanes too.
template <std::size_t capacity>
struct RayColumns {
  std::array<float, capacity> x{}, y{}, z{};                   ///< origins
  std::array<float, capacity> dx{}, dy{}, dz{};                ///< directions, unit
  std::array<float, capacity> reach{};                         ///< metres
  std::array<std::uint32_t, capacity> instance{}, triangle{};  ///< a ray's own triangle, which it never hits
  std::array<std::uint8_t, capacity> is_clear{};               ///< whether the ray cannot hit it anyway

  void set(std::size_t i, const ShadowRay& ray, std::uint32_t own_instance, std::uint32_t own_triangle) {
    x[i] = ray.origin.x;
    y[i] = ray.origin.y;
    z[i] = ray.origin.z;
    dx[i] = ray.direction.x;
    dy[i] = ray.direction.y;
    dz[i] = ray.direction.z;
    reach[i] = ray.reach;
    instance[i] = own_instance;
    triangle[i] = own_triangle;
    is_clear[i] = ray.is_clear ? 1 : 0;
  }
  void move_to_front(std::size_t first, std::size_t count) {
    const auto move = [=](auto&... columns) { (std::copy_n(columns.data() + first, count, columns.data()), ...); };
    move(x, y, z, dx, dy, dz, reach, instance, triangle, is_clear);
  }
};

/// Whether the rays of a packet traverse the same boxes for long: `high` for nearby origins and one direction.
enum class Coherence { low, high };

/// Rays traced up to any hit, or to the nearest one.
template <bool nearest>
class Packet {
 public:
  static constexpr bool finds_nearest = nearest;

  explicit Packet(const Tracer::State& state, Coherence coherence = Coherence::low) : state_(&state) {
    prepare(query_, state, false);
    if (coherence == Coherence::high && !state.has_native_packets) embree::hint_coherence(query_.query);
    for (std::size_t lane = 0; lane < packet_width; ++lane) {
      aim(lane, {});  // lanes without a ray hold valid numbers too
      rays().tnear[lane] = 0.0f;
      rays().time[lane] = 0.0f;
      rays().mask[lane] = 0xffffffffu;
      rays().id[lane] = static_cast<unsigned>(lane);
      rays().flags[lane] = 0;
    }
    clear();
  }

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == packet_width; }
  void clear() { use(0, true); }

  /// Adds a ray, which never hits its own triangle.
  void add(const ShadowRay& ray, std::uint32_t own_instance, std::uint32_t own_triangle) {
    query_.own_instance[size_] = own_instance;
    query_.own_triangle[size_] = own_triangle;
    valid_[size_] = -1;
    aim(size_, ray);
    ++size_;
  }

  /// Replaces the ray of a lane by another one from the same triangle.
  void aim(std::size_t lane, const ShadowRay& ray) {
    rays().org_x[lane] = ray.origin.x;
    rays().org_y[lane] = ray.origin.y;
    rays().org_z[lane] = ray.origin.z;
    rays().dir_x[lane] = ray.direction.x;
    rays().dir_y[lane] = ray.direction.y;
    rays().dir_z[lane] = ray.direction.z;
    rays().tfar[lane] = ray.reach;
    is_clear_ = is_clear_ && ray.is_clear;
  }

  /// Replaces all rays by `count` of the columns, which must hold packet_width values from `first` on.
  template <std::size_t capacity>
  void take(const RayColumns<capacity>& columns, std::size_t first, std::size_t count) {
    const auto copy = [first](auto& to, const auto& column) {
      std::memcpy(to, column.data() + first, packet_width * sizeof(column[0]));
    };
    copy(rays().org_x, columns.x);
    copy(rays().org_y, columns.y);
    copy(rays().org_z, columns.z);
    copy(rays().dir_x, columns.dx);
    copy(rays().dir_y, columns.dy);
    copy(rays().dir_z, columns.dz);
    copy(rays().tfar, columns.reach);
    copy(query_.own_instance, columns.instance);
    copy(query_.own_triangle, columns.triangle);
    const auto* const clear = columns.is_clear.data() + first;
    use(count, std::all_of(clear, clear + count, [](std::uint8_t is_clear) { return is_clear != 0; }));
  }

  /// Sets the triangle that the rays of all lanes start on, and never hit.
  void set_own_triangle(std::uint32_t instance, std::uint32_t triangle) {
    std::fill_n(query_.own_instance, packet_width, instance);
    std::fill_n(query_.own_triangle, packet_width, triangle);
  }
  /// Where the rays are, to write them; use() then says how many there are.
  RayLanes lanes() {
    return {rays().org_x, rays().org_y, rays().org_z, rays().dir_x, rays().dir_y, rays().dir_z, rays().tfar};
  }
  /// Uses the first `count` lanes. `are_clear`: none of these rays can hit its own triangle.
  void use(std::size_t count, bool are_clear) {
    is_clear_ = are_clear;
    if (size_ == count) return;
    for (std::size_t lane = 0; lane < packet_width; ++lane) valid_[lane] = lane < count ? -1 : 0;
    size_ = count;
  }

  void trace() {
    if (size_ == 0) return;
    filter_every_hit(query_, !is_clear_);
    if constexpr (nearest) {
      alignas(64) int valid[packet_width];
      for (std::size_t lane = 0; lane < packet_width; ++lane) {
        lanes_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        lanes_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        valid[lane] = rays().tfar[lane] < 0.0f ? 0 : valid_[lane];
      }
      embree::intersect16(valid, state_->top.get(), lanes_, query_.query);
    } else {
      embree::occluded16(valid_, state_->top.get(), lanes_, query_.query);
    }
    is_clear_ = true;
  }

  // After trace():

  /// Embree sets tfar to −∞ on occlusion; rays of negative reach are blocked at their origins.
  bool is_blocked(std::size_t lane) const {
    if constexpr (nearest) {
      if (lanes_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID) return true;
    }
    return rays().tfar[lane] < 0.0f;
  }
  /// Of a blocked ray, metres from its origin.
  float distance(std::size_t lane) const requires nearest { return std::max(rays().tfar[lane], 0.0f); }
  /// Of a blocked ray whose reach was not negative, index into Scene::instances.
  std::uint32_t instance(std::size_t lane) const requires nearest {
    return instance_of(lanes_.hit.instID[0][lane], lanes_.hit.geomID[lane]);
  }

 private:
  auto& rays() {
    if constexpr (nearest)
      return lanes_.ray;
    else
      return lanes_;
  }
  const auto& rays() const {
    if constexpr (nearest)
      return lanes_.ray;
    else
      return lanes_;
  }

  const Tracer::State* state_;
  RayQuery query_;
  std::conditional_t<nearest, RTCRayHit16, RTCRay16> lanes_;
  alignas(64) int valid_[packet_width]{};
  std::size_t size_ = 0;
  bool is_clear_ = true;
};

using OcclusionPacket = Packet<false>;
using HitPacket = Packet<true>;

}  // namespace umbrameter
