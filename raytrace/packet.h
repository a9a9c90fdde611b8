// Occlusion rays traced together. For raytrace/*.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "raytrace/ray_lanes.h"
#include "raytrace/tracer_state.h"

namespace umbrameter {

struct ShadowRay {
  vec3 origin{0};
  vec3 direction{0, 0, 1};  ///< unit
  float reach = 0;          ///< metres; hits beyond do not block
  bool is_clear = false;    ///< it cannot meet its own triangle
};

/// Reach of a ray to a light that far off, metres. The light itself is no blocker: the ray stops short of it by the
/// rounding of its own length.
inline float reach_to_light(double distance) { return static_cast<float>(distance * (1.0 - 0x1p-22)); }

/// Rays from places of their own, a column for each of their quantities.
template <std::size_t capacity>
struct RayColumns {
  std::array<float, capacity> x{}, y{}, z{};                   ///< origins
  std::array<float, capacity> dx{}, dy{}, dz{};                ///< directions, unit
  std::array<float, capacity> reach{};                         ///< metres
  std::array<std::uint32_t, capacity> instance{}, triangle{};  ///< that a ray leaves and never hits
  std::array<std::uint8_t, capacity> is_clear{};               ///< whether it cannot meet that

  void set(std::size_t at, const ShadowRay& ray) {
    x[at] = ray.origin.x;
    y[at] = ray.origin.y;
    z[at] = ray.origin.z;
    dx[at] = ray.direction.x;
    dy[at] = ray.direction.y;
    dz[at] = ray.direction.z;
    reach[at] = ray.reach;
    is_clear[at] = ray.is_clear ? 1 : 0;
  }
  void move_to_front(std::size_t first, std::size_t count) {
    const auto move = [=](auto&... columns) { (std::copy_n(columns.data() + first, count, columns.data()), ...); };
    move(x, y, z, dx, dy, dz, reach, instance, triangle, is_clear);
  }
};

/// What all packets do with Embree's lanes.
template <class Rays>
void prepare_lane(Rays& rays, int lane) {
  rays.tnear[lane] = 0.0f;
  rays.time[lane] = 0.0f;
  rays.mask[lane] = 0xffffffffu;
  rays.id[lane] = static_cast<unsigned>(lane);
  rays.flags[lane] = 0;
}
template <class Rays>
void aim_lane(Rays& rays, int lane, const ShadowRay& ray) {
  rays.org_x[lane] = ray.origin.x;
  rays.org_y[lane] = ray.origin.y;
  rays.org_z[lane] = ray.origin.z;
  rays.dir_x[lane] = ray.direction.x;
  rays.dir_y[lane] = ray.direction.y;
  rays.dir_z[lane] = ray.direction.z;
  rays.tfar[lane] = ray.reach;
}
template <class Rays>
RayLanes lanes_of(Rays& rays) {
  return {rays.org_x, rays.org_y, rays.org_z, rays.dir_x, rays.dir_y, rays.dir_z, rays.tfar};
}

/// How much of their way the rays of a packet go together: `high` where they leave from nearby in one direction.
enum class Coherence { low, high };

/// 4, 8 or 16 rays.
template <int lanes>
class OcclusionPacket {
 public:
  static constexpr int width = lanes;
  static constexpr bool knows_distance = false;

  explicit OcclusionPacket(const Tracer::State& state, Coherence coherence = Coherence::low) : state_(&state) {
    prepare(query_, state, false);
    if (coherence == Coherence::high && !state.takes_16_lanes) embree::hint_coherence(query_.query);
    for (int lane = 0; lane < width; ++lane) {
      aim(lane, {});  // idle lanes too: no garbage is traced along
      prepare_lane(rays_, lane);
    }
    clear();
  }

  int size() const { return size_; }
  void clear() {
    size_ = 0;
    is_clear_ = true;
    std::fill_n(valid_, width, 0);
  }

  /// Takes the next lane; own is the triangle that the ray leaves and never hits.
  void add(const ShadowRay& ray, std::uint32_t own_instance, std::uint32_t own_triangle) {
    query_.own_instance[size_] = own_instance;
    query_.own_triangle[size_] = own_triangle;
    aim(size_, ray);
    ++size_;
  }

  /// Takes `count` rays instead of those it had. The columns go on for a packet's width.
  template <std::size_t capacity>
  void take(const RayColumns<capacity>& rays, std::size_t first, int count) {
    const auto copy = [first](auto& to, const auto& column) {
      std::memcpy(to, column.data() + first, static_cast<std::size_t>(width) * sizeof(column[0]));
    };
    copy(rays_.org_x, rays.x);
    copy(rays_.org_y, rays.y);
    copy(rays_.org_z, rays.z);
    copy(rays_.dir_x, rays.dx);
    copy(rays_.dir_y, rays.dy);
    copy(rays_.dir_z, rays.dz);
    copy(rays_.tfar, rays.reach);
    copy(query_.own_instance, rays.instance);
    copy(query_.own_triangle, rays.triangle);
    const auto clear = rays.is_clear.begin() + static_cast<std::ptrdiff_t>(first);
    is_clear_ = std::all_of(clear, clear + count, [](std::uint8_t is_clear) { return is_clear != 0; });
    use_first(count);
  }

  /// Gives a lane in use another ray from the same triangle.
  void aim(int lane, const ShadowRay& ray) {
    aim_lane(rays_, lane, ray);
    valid_[lane] = -1;
    is_clear_ = is_clear_ && ray.is_clear;
  }

  /// The triangle that the rays of all lanes leave and never hit.
  void leave(std::uint32_t instance, std::uint32_t triangle) { own_all(query_, instance, triangle); }
  /// Rays that leave it can be written here, and are taken by use().
  RayLanes lanes_to_write() { return lanes_of(rays_); }
  /// Only the first lanes are in use. `are_clear`: none can meet its own triangle.
  void use(int count, bool are_clear) {
    use_first(count);
    is_clear_ = are_clear;
  }

  void trace() {
    if (size_ == 0) return;
    filter_every_hit(query_, !is_clear_);
    embree::occluded<width>(valid_, state_->top.get(), rays_, query_.query);
    is_clear_ = true;
  }
  /// After trace(). Embree marks a blocked ray by tfar = −∞.
  bool is_blocked(int lane) const { return rays_.tfar[lane] < 0.0f; }

 private:
  void use_first(int count) {
    if (size_ == count) return;
    for (int lane = 0; lane < width; ++lane) valid_[lane] = lane < count ? -1 : 0;
    size_ = count;
  }

  const Tracer::State* state_;
  RayQuery query_;
  typename embree::Lanes<width>::Rays rays_;
  alignas(64) int valid_[static_cast<std::size_t>(width)];
  int size_ = 0;
  bool is_clear_ = true;
};

using Packet = OcclusionPacket<16>;

}  // namespace umbrameter
