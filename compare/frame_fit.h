// How a frame's surfaces fit ours under one assumption about its conventions. For compare/frame_alignment.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/frame_alignment.h"

namespace umbrameter {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();
/// Pixels from which an assumption is judged.
inline constexpr std::size_t most_samples = 8192;

// How pixels relate to the world for one camera.
class Pixels {
 public:
  Pixels(const View& view, const FrameSurfaces& frame)
      : view_(view), camera_from_world_(view_from_world(view)), clip_(clip_from_view(view)) {
    const dmat3 axes(view.camera.world_from_camera);
    right_ = axes[0], up_ = axes[1];
    if (const auto* parallel = std::get_if<OrthographicProjection>(&view.camera.projection)) {
      near_ = parallel->near_plane, far_ = parallel->far_plane;
      size_ = 2.0 * parallel->half_height / view.height;
      is_parallel_ = true;
    } else {
      const auto& lens = std::get<PerspectiveProjection>(view.camera.projection);
      near_ = lens.near_plane, far_ = lens.far_plane;
      size_ = 2.0 * std::tan(0.5 * lens.vertical_fov) / view.height;
    }
    if (frame.near_plane > 0.0) near_ = frame.near_plane;
    if (frame.far_plane > 0.0) far_ = frame.far_plane;
  }

  /// Along the camera's axis, metres.
  double depth_of(const dvec3& position) const { return -(camera_from_world_ * dvec4(position, 1.0)).z; }
  /// Side of a pixel at this depth, metres.
  double size_at(double depth) const { return is_parallel_ ? size_ : size_ * depth; }
  const dvec3& right() const { return right_; }
  const dvec3& up() const { return up_; }

  /// From the pixel's centre to where the position is seen: right and down, pixels. NaN behind the camera.
  dvec2 offset(const dvec3& position, std::size_t i) const {
    const dvec4 clip = clip_ * (camera_from_world_ * dvec4(position, 1.0));
    if (!(clip.w > 0.0)) return dvec2(not_a_number);
    const auto width = static_cast<std::size_t>(view_.width);
    const dvec2 seen{0.5 * (clip.x / clip.w + 1.0) * view_.width, 0.5 * (1.0 - clip.y / clip.w) * view_.height};
    return seen - dvec2(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
  }

  dvec3 position_at(std::size_t i, double number, DepthConvention convention) const {
    const auto width = static_cast<std::size_t>(view_.width);
    const Ray ray = pixel_ray(view_, static_cast<int>(i % width), static_cast<int>(i / width));
    const double along = glm::dot(ray.direction, -dvec3(view_.camera.world_from_camera[2]));
    const dvec3 from(view_.camera.world_from_camera[3]);
    // Of an orthographic camera: in its own plane, on the ray.
    const dvec3 eye = is_parallel_ ? ray.origin + glm::dot(from - ray.origin, ray.direction) * ray.direction : from;
    if (convention == DepthConvention::ray) return number > 0.0 ? eye + number * ray.direction : dvec3(not_a_number);
    const double depth = axis_depth(number, convention);
    if (!(depth > 0.0) || !(depth < far_ * (1.0 - 1e-6))) return dvec3(not_a_number);
    return eye + depth / along * ray.direction;
  }

 private:
  double axis_depth(double d, DepthConvention convention) const {
    switch (convention) {
      case DepthConvention::linear:
        return near_ + d * (far_ - near_);
      case DepthConvention::reversed:
        return axis_depth(1.0 - d, DepthConvention::window);
      case DepthConvention::window:
        if (is_parallel_) return axis_depth(d, DepthConvention::linear);
        // d = f (z − n) / (z (f − n)); f may be infinite.
        return d < 1.0 ? near_ / (1.0 - d * (1.0 - near_ / far_)) : infinite;
      case DepthConvention::reversed_infinite:
        return d > 0.0 ? near_ / d : infinite;
      case DepthConvention::axis:
      case DepthConvention::ray:
        break;
    }
    return d;
  }

  const View& view_;
  dmat4 camera_from_world_, clip_;
  dvec3 right_{0.0}, up_{0.0};
  double near_ = 0.0, far_ = 0.0, size_ = 0.0;
  bool is_parallel_ = false;
};

// What may have to be undone: the pixel at which the frame shows what belongs to ours, axes, unit, kind of depth,
// shift.
struct Remedy {
  bool flips_x = false, flips_y = false;
  std::array<int, 3> axis{0, 1, 2};  // our x, y, z are these coordinates of the frame
  std::array<double, 3> sign{1.0, 1.0, 1.0};
  double scale = 1.0;  // metres per unit of the frame
  DepthConvention convention = DepthConvention::axis;
  dvec2 shift{0.0};
};

inline bool is_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class Fit {
 public:
  Fit(const FrameSurfaces& frame, const GBuffer& gbuffer, const View& view)
      : frame_(frame), gbuffer_(gbuffer), pixels_(view, frame), has_positions_(!frame.position.empty()) {}

  bool has_positions() const { return has_positions_; }
  std::size_t size() const { return gbuffer_.instance.size(); }

  dvec3 position(std::size_t i, const Remedy& remedy) const {
    const auto width = static_cast<std::size_t>(gbuffer_.width);
    std::size_t x = i % width, y = i / width;
    if (remedy.flips_x) x = width - 1 - x;
    if (remedy.flips_y) y = static_cast<std::size_t>(gbuffer_.height) - 1 - y;
    const std::size_t at = y * width + x;
    if (!has_positions_) return pixels_.position_at(i, remedy.scale * frame_.depth[at], remedy.convention);
    const dvec3 p(frame_.position[at]);
    dvec3 ours;
    for (int c = 0; c < 3; ++c) {
      const auto k = static_cast<std::size_t>(c);
      ours[c] = remedy.scale * remedy.sign[k] * p[remedy.axis[k]];
    }
    return ours;
  }

  // To the frame's position, in pixels: across the image, and from the plane of our triangle.
  struct Distance {
    dvec2 across{not_a_number};
    double from_plane = not_a_number;
    double slope_x = 0.0, slope_y = 0.0;  // change of from_plane of a depth image that is shifted by a pixel
    double length() const { return std::max(glm::length(across), std::abs(from_plane)); }
  };
  Distance distance(std::size_t i, const Remedy& remedy) const {
    Distance result;
    const dvec3 theirs = position(i, remedy);
    if (!gbuffer_.is_surface(i) || !is_finite(theirs)) return result;
    const dvec3 ours(gbuffer_.position[i]);
    const dvec3 normal(gbuffer_.geometric_normal[i]);
    const double size = pixels_.size_at(pixels_.depth_of(ours));
    result.across = pixels_.offset(theirs, i);
    result.from_plane = glm::dot(theirs - ours, normal) / size;
    // Positions are single precision on both sides.
    const double rounding = 1e-6 * (glm::length(ours) + glm::length(theirs)) / size;
    result.from_plane = std::copysign(std::max(std::abs(result.from_plane) - rounding, 0.0), result.from_plane);
    result.slope_x = -glm::dot(pixels_.right(), normal);
    result.slope_y = glm::dot(pixels_.up(), normal);
    if (has_positions_) {
      result.across -= remedy.shift;
    } else {
      result.from_plane -= remedy.shift.x * result.slope_x + remedy.shift.y * result.slope_y;
    }
    return result;
  }

  enum class Match { none, partner, alone };
  Match match(std::size_t i, const Remedy& remedy, double reach = partner_distance) const {
    const bool theirs = is_finite(position(i, remedy));
    if (!theirs && !gbuffer_.is_surface(i)) return Match::none;
    return distance(i, remedy).length() <= reach ? Match::partner : Match::alone;
  }

  // A step that visits about as many pixels as a remedy is judged from, not column by column.
  std::size_t step() const { return size() <= most_samples ? 1 : (size() / most_samples) | 1u; }

  double share_unmatched(const Remedy& remedy, double reach = partner_distance) const {
    std::size_t all = 0, alone = 0;
    for (std::size_t i = 0; i < size(); i += step()) {
      const Match found = match(i, remedy, reach);
      all += found != Match::none ? 1u : 0u;
      alone += found == Match::alone ? 1u : 0u;
    }
    return all > 0 ? static_cast<double>(alone) / static_cast<double>(all) : 1.0;
  }

  // The shift that is left, from pixels whose surfaces nearly agree.
  dvec2 shift(const Remedy& remedy) const {
    constexpr double reach = 3.0;
    std::vector<Distance> near;
    for (std::size_t i = 0; i < size(); i += step()) {
      const Distance each = distance(i, remedy);
      if (each.length() <= reach) near.push_back(each);
    }
    if (near.size() < 16) return dvec2(not_a_number);
    if (has_positions_)
      return {median(near, [](const auto& d) { return d.across.x; }),
              median(near, [](const auto& d) { return d.across.y; })};
    return shift_of_depths(near);
  }

  // Where both show a surface; infinite if that is nowhere.
  double median_error(const Remedy& remedy) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < size(); i += step()) {
      const double length = distance(i, remedy).length();
      if (std::isfinite(length)) all.push_back(length);
    }
    return all.empty() ? infinite : median(all, [](double each) { return each; });
  }

  // Metres per unit of the frame: the usual unit nearest to the median ratio, 1 where none is near.
  double unit(Remedy remedy) const {
    constexpr std::array<double, 10> units = {1.0,    0.01,         100.0,  0.001,        1000.0,
                                              0.0254, 1.0 / 0.0254, 0.3048, 1.0 / 0.3048, 0.1};
    std::vector<double> ratios;
    for (std::size_t i = 0; i < size(); i += step()) {
      if (!gbuffer_.is_surface(i)) continue;
      const dvec3 theirs = position(i, remedy);
      if (!is_finite(theirs)) continue;
      const dvec3 ours(gbuffer_.position[i]);
      const double ratio =
          has_positions_ ? glm::length(ours) / glm::length(theirs) : pixels_.depth_of(ours) / pixels_.depth_of(theirs);
      if (std::isfinite(ratio)) ratios.push_back(ratio);
    }
    if (ratios.empty()) return 1.0;
    const double ratio = median(ratios, [](double each) { return each; });
    for (const double unit : units) {
      if (std::abs(ratio / unit - 1.0) < 0.05) return unit;
    }
    return 1.0;
  }

 private:
  template <class T, class Of>
  static double median(std::vector<T>& items, const Of& of) {
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [&](const T& a, const T& b) { return of(a) < of(b); });
    return of(*middle);
  }

  // A depth image shifted by (x, y) lies off our planes by slope_x · x + slope_y · y. Least squares, then again without
  // what fits badly: steps at silhouettes.
  static dvec2 shift_of_depths(const std::vector<Distance>& near) {
    dvec2 shift(0.0);
    for (const double reach : {infinite, 1.0, 0.25}) {
      double xx = 0.0, xy = 0.0, yy = 0.0, xr = 0.0, yr = 0.0;
      std::size_t used = 0;
      for (const Distance& each : near) {
        if (std::abs(each.from_plane - shift.x * each.slope_x - shift.y * each.slope_y) > reach) continue;
        ++used;
        xx += each.slope_x * each.slope_x, xy += each.slope_x * each.slope_y, yy += each.slope_y * each.slope_y;
        xr += each.slope_x * each.from_plane, yr += each.slope_y * each.from_plane;
      }
      const double determinant = xx * yy - xy * xy;
      // On planes of one direction a shift along them cannot be seen.
      if (used < 16 || !(determinant > 1e-4 * xx * yy)) return dvec2(not_a_number);
      shift = {(xr * yy - yr * xy) / determinant, (yr * xx - xr * xy) / determinant};
    }
    return shift;
  }

  const FrameSurfaces& frame_;
  const GBuffer& gbuffer_;
  Pixels pixels_;
  bool has_positions_;
};

}  // namespace umbrameter
