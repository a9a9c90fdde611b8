#include "raytrace/visible_surface.h"

#include <algorithm>
#include <array>
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

// Sides of a pixel: left, right, up, down.
constexpr unsigned sides = 4;
constexpr unsigned horizontal = 0b0011;
constexpr unsigned vertical = 0b1100;

}  // namespace

// The way of a ray over the image, by the share s of that way.
struct VisibleSurface::Ray {
  dvec3 from{0.0};  // the surfel
  dvec3 direction{0.0, 0.0, -1.0};
  double length = 0.0;  // metres
  Place first, last;
  dvec2 start{0.0};
  dvec2 across{0.0};

  dvec2 at(double s) const { return start + s * across; }
  double nearness(double s) const { return first.nearness + s * (last.nearness - first.nearness); }
  // Metres: 1/w is linear in s.
  double distance(double s) const { return length * s * first.w / ((1.0 - s) * last.w + s * first.w); }
};

VisibleSurface::VisibleSurface(const GBuffer& gbuffer, const View& view)
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
  const auto each_facet = [this](const auto& change) {
    parallel_for(facets_.size(), [&](std::size_t i) {
      if (facets_[i].is_surface) change(i);
    });
  };
  each_facet([&](std::size_t i) { tilt(gbuffer, i); });
  each_facet([&](std::size_t i) { join(i); });
  each_facet([&](std::size_t i) { limit(i); });
}

dvec3 VisibleSurface::to_viewer(std::size_t pixel) const {
  return is_orthographic_ ? dvec3(0.0, 0.0, 1.0) : -glm::normalize(positions_[pixel]);
}

double VisibleSurface::distance_to_viewer(std::size_t pixel) const {
  return is_orthographic_ ? infinity : glm::length(positions_[pixel]);
}

VisibleSurface::Place VisibleSurface::place_of(const dvec3& position) const {
  const dvec4 clip = clip_from_view_ * dvec4(position, 1.0);
  Place place;
  place.pixel = {(clip.x / clip.w * 0.5 + 0.5) * width_, (0.5 - clip.y / clip.w * 0.5) * height_};
  place.w = clip.w;
  place.nearness = is_orthographic_ ? position.z : 1.0 / -position.z;
  return place;
}

dvec2 VisibleSurface::center_of(std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t row = pixel / width;
  return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(row) + 0.5};
}

bool VisibleSurface::has_neighbour(std::size_t pixel, unsigned side) const {
  const auto width = static_cast<std::size_t>(width_);
  if (side < 2) return side == 0 ? pixel % width > 0 : pixel % width + 1 < width;
  return side == 2 ? pixel >= width : pixel + width < facets_.size();
}

std::size_t VisibleSurface::neighbour_of(std::size_t pixel, unsigned side) const {
  const std::size_t step = side < 2 ? 1 : static_cast<std::size_t>(width_);
  return (side & 1u) == 0 ? pixel - step : pixel + step;
}

// Of the pixel's plane, wherever.
double VisibleSurface::nearness_at(std::size_t pixel, const dvec2& at) const {
  const Facet& facet = facets_[pixel];
  const dvec2 off = at - center_of(pixel);
  return facet.center + facet.x * off.x + facet.y * off.y;
}

// Of the surface within the pixel's square. Beyond a crease that points to the camera the neighbour's plane is the
// farther one, beyond one that points away from it the nearer one. `has_own_plane` false: only what stands before the
// pixel's own plane, for rays that leave it; −∞ without any.
double VisibleSurface::surface_at(std::size_t pixel, const dvec2& at, bool has_own_plane) const {
  const Facet& facet = facets_[pixel];
  double nearness = has_own_plane ? nearness_at(pixel, at) : -infinity;
  for (unsigned side = 0; side < sides && has_own_plane; ++side) {
    if ((facet.convex >> side & 1u) == 0) continue;
    nearness = std::min(nearness, nearness_at(neighbour_of(pixel, side), at));
  }
  for (unsigned side = 0; side < sides; ++side) {
    if ((facet.concave >> side & 1u) == 0) continue;
    nearness = std::max(nearness, nearness_at(neighbour_of(pixel, side), at));
  }
  return nearness;
}

// The plane n·P = n·P₀. Perspective: P = depth · d, with d linear in the pixel, so that 1/depth = n·d / n·P₀.
void VisibleSurface::tilt(const GBuffer& gbuffer, std::size_t pixel) {
  Facet& facet = facets_[pixel];
  const dvec3 normal = view_from_world_ * dvec3(gbuffer.geometric_normal[pixel]);
  const double right = 2.0 / width_ / clip_from_view_[0][0];  // of d, per pixel
  const double down = -2.0 / height_ / clip_from_view_[1][1];
  const double facing = is_orthographic_ ? -normal.z : glm::dot(normal, positions_[pixel]);
  if (facing == 0.0) return;
  facet.x = normal.x * right / facing;
  facet.y = normal.y * down / facing;
}

VisibleSurface::Meeting VisibleSurface::meeting_of(std::size_t pixel, std::size_t neighbour) const {
  const dvec2 here = center_of(pixel);
  const dvec2 there = center_of(neighbour);
  const auto step_at = [&](const dvec2& at) { return nearness_at(neighbour, at) - nearness_at(pixel, at); };
  const double tolerance = rounding * std::max(std::abs(facets_[pixel].center), std::abs(facets_[neighbour].center));
  const double first = step_at(here);
  const double last = step_at(there);
  if (std::abs(first) <= tolerance && std::abs(last) <= tolerance) return Meeting::plane;
  if (first >= -tolerance && last <= tolerance) return Meeting::convex;
  if (first <= tolerance && last >= -tolerance) return Meeting::concave;
  return Meeting::none;
}

void VisibleSurface::join(std::size_t pixel) {
  Facet& facet = facets_[pixel];
  for (unsigned side = 0; side < sides; ++side) {
    if (!has_neighbour(pixel, side)) continue;
    const std::size_t neighbour = neighbour_of(pixel, side);
    if (!facets_[neighbour].is_surface) continue;
    const Meeting meeting = meeting_of(pixel, neighbour);
    const auto bit = static_cast<std::uint8_t>(1u << side);
    if (meeting != Meeting::none) facet.joined |= bit;
    if (meeting == Meeting::convex) facet.convex |= bit;
    if (meeting == Meeting::concave) facet.concave |= bit;
  }
}

// Along an axis on which the facet joins nothing.
void VisibleSurface::limit(std::size_t pixel) {
  Facet& facet = facets_[pixel];
  const auto limit_axis = [&](double& slope, unsigned mask) {
    if ((facet.joined & mask) != 0) return;
    double steepest = 0.0;
    for (unsigned side = 0; side < sides; ++side) {
      if ((mask >> side & 1u) == 0 || !has_neighbour(pixel, side)) continue;
      const Facet& neighbour = facets_[neighbour_of(pixel, side)];
      if (neighbour.is_surface) steepest = std::max(steepest, std::abs(neighbour.center - facet.center));
    }
    steepest = steepest * slope_margin + rounding * std::abs(facet.center);
    slope = std::clamp(slope, -steepest, steepest);
  };
  limit_axis(facet.x, horizontal);
  limit_axis(facet.y, vertical);
}

bool VisibleSurface::is_joined(std::size_t pixel, std::size_t neighbour) const {
  if (!facets_[pixel].is_surface || !facets_[neighbour].is_surface) {
    return facets_[pixel].is_surface == facets_[neighbour].is_surface;
  }
  for (unsigned side = 0; side < sides; ++side) {
    if (has_neighbour(pixel, side) && neighbour_of(pixel, side) == neighbour) {
      return (facets_[pixel].joined & 1U << side) != 0;
    }
  }
  return false;
}

double VisibleSurface::reach_in_view(std::size_t pixel, const dvec3& direction, double reach) const {
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

void VisibleSurface::march(std::size_t pixel, const dvec3& direction, double reach,
                           const std::function<bool(const SurfaceEvent&)>& visit) const {
  Ray ray;
  ray.from = positions_[pixel];
  ray.direction = direction;
  ray.length = reach_in_view(pixel, direction, reach);
  ray.first = place_of(positions_[pixel]);
  ray.last = place_of(positions_[pixel] + ray.length * direction);
  // From the centre of the surfel's pixel, where its facet is known exactly.
  ray.start = center_of(pixel);
  ray.across = ray.last.pixel - ray.start;
  const dvec2 across = ray.across;
  if (!(glm::dot(across, across) > 0.0) || !std::isfinite(across.x) || !std::isfinite(across.y)) return;

  // Whether the ray is behind the surface changes only where it passes through one of the planes. `bounds` divides the
  // pixel's part of the way there.
  std::array<double, sides + 3> bounds{};
  std::size_t bound_count = 0;
  bool was_behind = false;
  // Returns whether to go on.
  const auto cross = [&](std::size_t at, std::size_t before, double enter, double leave) {
    const bool is_own = at == pixel;
    const Facet& facet = facets_[at];
    const auto add_root = [&](std::size_t of) {
      const double first = nearness_at(of, ray.at(enter)) - ray.nearness(enter);
      const double last = nearness_at(of, ray.at(leave)) - ray.nearness(leave);
      if ((first > 0.0) != (last > 0.0)) {
        bounds[bound_count++] = std::clamp(enter + (leave - enter) * first / (first - last), enter, leave);
      }
    };
    bound_count = 0;
    bounds[bound_count++] = enter;
    if (!is_own) add_root(at);
    const unsigned creases = facet.concave | (is_own ? 0u : unsigned{facet.convex});
    for (unsigned side = 0; side < sides; ++side) {
      if ((creases >> side & 1u) != 0) add_root(neighbour_of(at, side));
    }
    std::sort(bounds.begin() + 1, bounds.begin() + static_cast<std::ptrdiff_t>(bound_count));
    bounds[bound_count] = leave;
    const auto visit_at = [&](double s, bool is_connected) {
      const double distance = ray.distance(s);
      const double depth = depth_of(surface_at(at, ray.at(s), true));
      dvec3 seen = ray.from + distance * direction;
      if (is_orthographic_) {
        seen.z = -depth;
      } else {
        seen *= depth / -seen.z;
      }
      return visit({distance, seen, is_connected});
    };
    const double tolerance = rounding * std::abs(facet.center);
    for (std::size_t part = 0; part < bound_count; ++part) {
      const double from = bounds[part];
      const double to = bounds[part + 1];
      const double middle = 0.5 * (from + to);
      const bool is_behind = surface_at(at, ray.at(middle), !is_own) - ray.nearness(middle) > tolerance;
      const bool is_at_border = part == 0;
      const bool is_connected = is_behind != was_behind && (!is_at_border || is_joined(before, at));
      if ((is_connected || is_behind) && !visit_at(from, is_connected)) return false;
      if (is_behind && !visit_at(to, false)) return false;
      was_behind = is_behind;
    }
    return true;
  };

  // The traversal of a grid (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987).
  const int step_x = across.x > 0.0 ? 1 : -1;
  const int step_y = across.y > 0.0 ? 1 : -1;
  const double each_x = across.x != 0.0 ? 1.0 / std::abs(across.x) : infinity;
  const double each_y = across.y != 0.0 ? 1.0 / std::abs(across.y) : infinity;
  double next_x = 0.5 * each_x;
  double next_y = 0.5 * each_y;
  int x = static_cast<int>(ray.start.x);
  int y = static_cast<int>(ray.start.y);
  std::size_t before = pixel;
  if (facets_[pixel].concave != 0 && !cross(pixel, pixel, 0.0, std::min(std::min(next_x, next_y), 1.0))) return;
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
    if (!facets_[at].is_surface) {
      was_behind = false;
    } else if (!cross(at, before, enter, std::min(std::min(next_x, next_y), 1.0))) {
      return;
    }
    before = at;
  }
}

}  // namespace umbrameter
