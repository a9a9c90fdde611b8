// Sixteen occlusion rays traced together. For raytrace/*.cpp alone.
#pragma once

#include <algorithm>

#include "raytrace/tracer_state.h"

namespace umbrameter {

struct ShadowRay {
  vec3 origin{0};
  vec3 direction{0, 0, 1};  ///< unit
  float reach = 0;          ///< metres; hits beyond do not block
  bool is_clear = false;    ///< it cannot meet its own triangle
};

/// Of the sixteen rays of a packet.
struct alignas(64) Directions {
  float x[16] = {};
  float y[16] = {};
  float z[16] = {};
};

/// What all packets do with their rays, lane by lane.
inline void prepare_lane(RTCRay16& rays, int lane) {
  rays.tnear[lane] = 0.0f;
  rays.time[lane] = 0.0f;
  rays.mask[lane] = 0xffffffffu;
  rays.id[lane] = static_cast<unsigned>(lane);
  rays.flags[lane] = 0;
}
inline void aim_lane(RTCRay16& rays, int lane, const ShadowRay& ray) {
  rays.org_x[lane] = ray.origin.x;
  rays.org_y[lane] = ray.origin.y;
  rays.org_z[lane] = ray.origin.z;
  rays.dir_x[lane] = ray.direction.x;
  rays.dir_y[lane] = ray.direction.y;
  rays.dir_z[lane] = ray.direction.z;
  rays.tfar[lane] = ray.reach;
}
inline void aim_lanes(RTCRay16& rays, const Directions& directions, const float* reach) {
  std::copy_n(directions.x, 16, rays.dir_x);
  std::copy_n(directions.y, 16, rays.dir_y);
  std::copy_n(directions.z, 16, rays.dir_z);
  std::copy_n(reach, 16, rays.tfar);
}

class Packet {
 public:
  static constexpr int width = 16;

  explicit Packet(const Tracer::State& state) : state_(&state) {
    prepare(query_, state, false);
    for (int lane = 0; lane < width; ++lane) {
      aim(lane, {});  // idle lanes too: no garbage is traced along
      prepare_lane(rays_, lane);
      valid_[lane] = 0;
    }
    is_clear_ = true;
  }

  int size() const { return size_; }
  bool is_full() const { return size_ == width; }
  void clear() {
    size_ = 0;
    is_clear_ = true;
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
    aim_lane(rays_, lane, ray);
    valid_[lane] = -1;
    is_clear_ = is_clear_ && ray.is_clear;
  }

  /// Gives every lane in use another ray from the same place. A negative reach is blocked where it starts.
  void aim(const Directions& directions, const float* reach, bool is_clear) {
    aim_lanes(rays_, directions, reach);
    is_clear_ = is_clear;
  }

  void trace() {
    if (size_ == 0) return;
    filter_every_hit(query_, !is_clear_);
    embree::occluded(valid_, state_->top.get(), rays_, query_.query);
    is_clear_ = true;
  }
  /// After trace(). Embree marks a blocked ray by tfar = −∞.
  bool is_blocked(int lane) const { return rays_.tfar[lane] < 0.0f; }

 private:
  const Tracer::State* state_;
  RayQuery query_;
  RTCRay16 rays_;
  alignas(64) int valid_[width];
  int size_ = 0;
  bool is_clear_ = true;
};

}  // namespace umbrameter
