#include "techniques/ao/reference/depth_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/parallel.h"

namespace umbrameter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Positions and depths are single-precision numbers: a ray is behind a facet if it is by more than their rounding.
constexpr double rounding = 0x1p-20;

// For slopes to neighbours, so that rounding does not cut a plane's own.
constexpr double slope_margin = 1.0 + 1e-3;

}  // namespace

DepthSurface::DepthSurface(const GBuffer& gbuffer, const View& view)
    : width_(view.width),
      height_(view.height),
      is_orthographic_(std::holds_alternative<OrthographicProjection>(view.camera.projection)),
      near_plane_(std::visit([](const auto& lens) { return lens.near_plane; }, view.camera.projection)),
      clip_from_view_(clip_from_view(view)),
      view_from_world_(umbrameter::view_from_world(view)),
      positions_(gbuffer.position.size(), dvec3(0.0)),
      facets_(gbuffer.position.size()) {
  const dmat4 from_world = umbrameter::view_from_world(view);
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    positions_[i] = dvec3(from_world * dvec4(dvec3(gbuffer.position[i]), 1.0));
    facets_[i].is_surface = true;
    facets_[i].center = place_of(positions_[i]).nearness;
  }
  parallel_for(facets_.size(), [&](std::size_t i) {
    if (facets_[i].is_surface) tilt(gbuffer, i);
  });
}

dvec3 DepthSurface::to_viewer(std::size_t pixel) const {
  return is_orthographic_ ? dvec3(0.0, 0.0, 1.0) : -glm::normalize(positions_[pixel]);
}

DepthSurface::Place DepthSurface::place_of(const dvec3& position) const {
  const dvec4 clip = clip_from_view_ * dvec4(position, 1.0);
  Place place;
  place.pixel = {(clip.x / clip.w * 0.5 + 0.5) * width_, (0.5 - clip.y / clip.w * 0.5) * height_};
  place.w = clip.w;
  place.nearness = is_orthographic_ ? position.z : 1.0 / -position.z;
  return place;
}

dvec2 DepthSurface::center_of(std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(width_);
  return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5};
}

// The plane n·P = n·P₀. Perspective: P = depth · d, with d linear in the pixel, so that 1/depth = n·d / n·P₀.
void DepthSurface::tilt(const GBuffer& gbuffer, std::size_t pixel) {
  Facet& facet = facets_[pixel];
  const dvec3 normal = view_from_world_ * dvec3(gbuffer.geometric_normal[pixel]);
  const double right = 2.0 / width_ / clip_from_view_[0][0];  // of d, per pixel
  const double down = -2.0 / height_ / clip_from_view_[1][1];
  const double facing = is_orthographic_ ? -normal.z : glm::dot(normal, positions_[pixel]);
  if (facing == 0.0) return;
  facet.x = normal.x * right / facing;
  facet.y = normal.y * down / facing;
  const auto limit = [&](double& slope, bool has_before, bool has_after, std::size_t step) {
    double steepest = 0.0;
    if (has_before && facets_[pixel - step].is_surface) {
      steepest = std::abs(facets_[pixel - step].center - facet.center);
    }
    if (has_after && facets_[pixel + step].is_surface) {
      steepest = std::max(steepest, std::abs(facets_[pixel + step].center - facet.center));
    }
    steepest = steepest * slope_margin + rounding * std::abs(facet.center);
    slope = std::clamp(slope, -steepest, steepest);
  };
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t column = pixel % width;
  limit(facet.x, column > 0, column + 1 < width, 1);
  limit(facet.y, pixel >= width, pixel + width < facets_.size(), width);
}

bool DepthSurface::is_joined(std::size_t pixel, std::size_t neighbour) const {
  const Facet& a = facets_[pixel];
  const Facet& b = facets_[neighbour];
  if (!a.is_surface || !b.is_surface) return a.is_surface == b.is_surface;
  const dvec2 at_a = center_of(pixel);
  const dvec2 at_b = center_of(neighbour);
  const auto step_at = [&](const dvec2& at) { return nearness_at(b, at_b, at) - nearness_at(a, at_a, at); };
  const double tolerance = rounding * std::max(std::abs(a.center), std::abs(b.center));
  const double middle = step_at(0.5 * (at_a + at_b));
  if (std::abs(middle) <= tolerance) return true;
  const double sign = middle > 0.0 ? 1.0 : -1.0;
  return sign * step_at(at_a) <= tolerance || sign * step_at(at_b) <= tolerance;
}

double DepthSurface::reach_in_view(std::size_t pixel, const dvec3& direction, double reach) const {
  const dvec4 from = clip_from_view_ * dvec4(positions_[pixel], 1.0);
  const dvec4 change = clip_from_view_ * dvec4(direction, 0.0);
  // The first root of a border's distance that the ray leaves through.
  const auto cut = [&](double start, double slope) {
    if (slope < 0.0) reach = std::min(reach, std::max(start, 0.0) / -slope);
  };
  cut(from.w - from.x, change.w - change.x);
  cut(from.w + from.x, change.w + change.x);
  cut(from.w - from.y, change.w - change.y);
  cut(from.w + from.y, change.w + change.y);
  cut(-positions_[pixel].z - near_plane_, -direction.z);
  return reach;
}

void DepthSurface::march(std::size_t pixel, const dvec3& direction, double reach, double thickness,
                         const std::function<bool(const SurfaceEvent&)>& visit) const {
  const double length = reach_in_view(pixel, direction, reach);
  const Place first = place_of(positions_[pixel]);
  const Place last = place_of(positions_[pixel] + length * direction);
  // From the centre of the surfel's pixel, where its facet is known exactly.
  const dvec2 start = center_of(pixel);
  const dvec2 across = last.pixel - start;
  if (!(glm::dot(across, across) > 0.0) || !std::isfinite(across.x) || !std::isfinite(across.y)) return;
  // Share s of the way in the image to metres along the ray: 1/w is linear in s.
  const auto distance_at = [&](double s) { return length * s * first.w / ((1.0 - s) * last.w + s * first.w); };
  const auto ray_at = [&](double s) { return first.nearness + s * (last.nearness - first.nearness); };

  // The traversal of a grid (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987).
  const int step_x = across.x > 0.0 ? 1 : -1;
  const int step_y = across.y > 0.0 ? 1 : -1;
  const double each_x = across.x != 0.0 ? 1.0 / std::abs(across.x) : infinity;
  const double each_y = across.y != 0.0 ? 1.0 / std::abs(across.y) : infinity;
  double next_x = 0.5 * each_x;
  double next_y = 0.5 * each_y;
  int x = static_cast<int>(start.x);
  int y = static_cast<int>(start.y);
  std::size_t before = pixel;
  bool was_behind = false;
  for (;;) {
    const double enter = std::min(next_x, next_y);
    if (!(enter < 1.0)) return;
    if (next_x <= next_y) {
      x += step_x;
      next_x += each_x;
    } else {
      y += step_y;
      next_y += each_y;
    }
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    const Facet& facet = facets_[at];
    if (!facet.is_surface) {
      was_behind = false;
      before = at;
      continue;
    }
    const double leave = std::min(std::min(next_x, next_y), 1.0);
    const dvec2 center(x + 0.5, y + 0.5);
    const auto facet_at = [&](double s) { return nearness_at(facet, center, start + s * across); };
    const double tolerance = rounding * std::abs(facet.center);
    const double behind_first = facet_at(enter) - ray_at(enter);  // above 0: the ray is behind
    const double behind_last = facet_at(leave) - ray_at(leave);
    const auto event_at = [&](double s, bool is_connected) {
      const double distance = distance_at(s);
      const double depth = depth_of(facet_at(s));
      dvec3 seen = positions_[pixel] + distance * direction;
      if (is_orthographic_) {
        seen.z = -depth;
      } else {
        seen *= depth / -seen.z;
      }
      return SurfaceEvent{distance, seen, is_connected};
    };
    const auto is_within = [&](double s) { return depth_of(ray_at(s)) - depth_of(facet_at(s)) <= thickness; };
    const bool enters_behind = behind_first > tolerance;
    const bool leaves_behind = behind_last > tolerance;
    const auto through = [&] {  // where the ray passes through the facet
      return std::clamp(enter + (leave - enter) * behind_first / (behind_first - behind_last), enter, leave);
    };
    bool goes_on = true;
    if (enters_behind) {
      const bool is_connected = !was_behind && is_joined(before, at);
      if (is_connected || is_within(enter)) {
        goes_on = visit(event_at(enter, is_connected));
      } else if (leaves_behind && is_within(leave)) {
        goes_on = visit(event_at(leave, false));
      }
      if (goes_on && !leaves_behind) goes_on = visit(event_at(through(), true));
    } else {
      if (was_behind && is_joined(before, at)) goes_on = visit(event_at(enter, true));
      if (goes_on && leaves_behind) goes_on = visit(event_at(through(), true));
    }
    if (!goes_on) return;
    was_behind = leaves_behind;
    before = at;
  }
}

}  // namespace umbrameter
