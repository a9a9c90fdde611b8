// Rays traced together to their nearest hits. For raytrace/*.cpp alone.
#pragma once

#include "raytrace/packet.h"

namespace umbrameter {

/// As OcclusionPacket, but knows how far each blocked ray went.
template <int lanes>
class HitPacket {
 public:
  static constexpr int width = lanes;
  static constexpr bool knows_distance = true;

  explicit HitPacket(const Tracer::State& state) : state_(&state) {
    prepare(query_, state, false);
    for (int lane = 0; lane < width; ++lane) {
      aim_lane(rays_.ray, lane, {});
      prepare_lane(rays_.ray, lane);
    }
    clear();
  }

  void clear() {
    size_ = 0;
    is_clear_ = true;
    std::fill_n(valid_, width, 0);
  }

  /// Takes the next lane; own is the triangle that the ray leaves and never hits.
  void add(const ShadowRay& ray, std::uint32_t own_instance, std::uint32_t own_triangle) {
    query_.own_instance[size_] = own_instance;
    query_.own_triangle[size_] = own_triangle;
    aim_lane(rays_.ray, size_, ray);
    forget_hit(size_);
    valid_[size_] = -1;
    is_clear_ = is_clear_ && ray.is_clear;
    ++size_;
  }

  /// As OcclusionPacket's.
  void leave(std::uint32_t instance, std::uint32_t triangle) { own_all(query_, instance, triangle); }
  RayLanes lanes_to_write() { return lanes_of(rays_.ray); }
  void use(int count, bool are_clear) {
    size_ = count;
    is_clear_ = are_clear;
    for (int lane = 0; lane < width; ++lane) {
      forget_hit(lane);
      valid_[lane] = lane < size_ && !(rays_.ray.tfar[lane] < 0.0f) ? -1 : 0;
    }
  }

  void trace() {
    if (size_ == 0) return;
    filter_every_hit(query_, !is_clear_);
    embree::intersect<width>(valid_, state_->top.get(), rays_, query_.query);
  }
  /// After trace(). A ray of negative reach is blocked where it starts.
  bool is_blocked(int lane) const {
    return rays_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID || rays_.ray.tfar[lane] < 0.0f;
  }
  /// Of a blocked ray, metres from its origin.
  float distance(int lane) const { return rays_.ray.tfar[lane] < 0.0f ? 0.0f : rays_.ray.tfar[lane]; }
  /// Of a blocked ray whose reach was not negative, index into Scene::instances.
  std::uint32_t instance(int lane) const { return instance_of(rays_.hit.instID[0][lane], rays_.hit.geomID[lane]); }
  int size() const { return size_; }
  bool is_full() const { return size_ == width; }

 private:
  void forget_hit(int lane) {
    rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }

  const Tracer::State* state_;
  RayQuery query_;
  typename embree::Lanes<width>::Hits rays_;
  alignas(64) int valid_[static_cast<std::size_t>(width)];
  int size_ = 0;
  bool is_clear_ = true;
};

}  // namespace umbrameter
