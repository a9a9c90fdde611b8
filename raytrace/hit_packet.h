// Sixteen rays traced together to their nearest hits. For raytrace/*.cpp alone.
#pragma once

#include "raytrace/packet.h"

namespace umbrameter {

/// As Packet, but knows how far each blocked ray went.
class HitPacket {
 public:
  static constexpr int width = Packet::width;

  explicit HitPacket(const Tracer::State& state) : state_(&state) {
    prepare(query_, state, false);
    for (int lane = 0; lane < width; ++lane) {
      aim(lane, {});
      prepare_lane(rays_.ray, lane);
    }
    clear();
  }

  int size() const { return size_; }
  void clear() {
    size_ = 0;
    for (int& valid : valid_) valid = 0;
  }

  /// Takes the next lane; own is the triangle that the ray leaves and never hits.
  void add(const ShadowRay& ray, std::uint32_t own_instance, std::uint32_t own_triangle) {
    query_.own_instance[size_] = own_instance;
    query_.own_triangle[size_] = own_triangle;
    aim(size_, ray);
    ++size_;
  }

  /// Gives a lane in use another ray from the same triangle.
  void aim(int lane, const ShadowRay& ray) {
    aim_lane(rays_.ray, lane, ray);
    rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    valid_[lane] = ray.reach < 0.0f ? 0 : -1;
  }

  /// Gives every lane in use another ray from the same place. A negative reach is blocked where it starts.
  void aim(const Directions& directions, const float* reach, bool /*is_clear*/) {
    aim_lanes(rays_.ray, directions, reach);
    for (int lane = 0; lane < size_; ++lane) {
      rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      rays_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      valid_[lane] = reach[lane] < 0.0f ? 0 : -1;
    }
  }

  void trace() {
    if (size_ > 0) embree::intersect16(valid_, state_->top.get(), rays_, query_.query);
  }
  /// After trace(). A ray of negative reach is blocked where it starts.
  bool is_blocked(int lane) const {
    return rays_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID || rays_.ray.tfar[lane] < 0.0f;
  }
  /// Of a blocked ray, metres from its origin.
  float distance(int lane) const { return rays_.ray.tfar[lane] < 0.0f ? 0.0f : rays_.ray.tfar[lane]; }

 private:
  const Tracer::State* state_;
  RayQuery query_;
  RTCRayHit16 rays_;
  alignas(64) int valid_[width];
  int size_ = 0;
};

}  // namespace umbrameter
