#include "compare/shimmer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace umbrameter {
namespace {

const dvec3 x_axis(1, 0, 0);
const dvec3 y_axis(0, 1, 0);
const dvec3 z_axis(0, 0, 1);

dmat4 turn(double angle, const dvec3& axis) { return glm::rotate(dmat4(1.0), angle, axis); }

// A depth along an axis is largest at a corner.
double largest_depth(const MapLayout& layout, const Bounds& bounds) {
  double largest = depth_of(layout, bounds.corner(0));
  for (int i = 1; i < 8; ++i) largest = std::max(largest, depth_of(layout, bounds.corner(i)));
  return largest;
}

template <class Takes>
Flips count(const Image<float>& before, const Image<float>& after, const Takes& takes) {
  assert(before.size() == after.size());
  Flips flips;
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!takes(i)) continue;
    ++flips.pixels;
    sum += std::abs(static_cast<double>(after[i]) - static_cast<double>(before[i]));
  }
  if (flips.pixels > 0) flips.share = sum / static_cast<double>(flips.pixels);
  return flips;
}

}  // namespace

MapLayout shift_grid(const MapLayout& layout, const dvec2& texels, const Bounds& bounds) {
  const dvec2 shift = texels * (2.0 * layout.views.front().half_extent / layout.resolution);
  MapLayout shifted = layout;
  dmat4 change = glm::translate(dmat4(1.0), dvec3(shift, 0.0));
  if (layout.kind != MapKind::orthographic) {
    // In the middle of a paraboloid's view, texels count tangents of half the angle.
    const dvec2 angle = glm::atan(shift) * (layout.kind == MapKind::paraboloid ? 2.0 : 1.0);
    change = turn(angle.y, x_axis) * turn(-angle.x, y_axis);
    if (layout.kind == MapKind::cube) change = turn(angle.x, z_axis) * change;
  }
  shifted.light_from_world = change * layout.light_from_world;
  // Only orthographic maps have such a plane, and these are translated.
  shifted.view_depth_plane.w -= glm::dot(dvec3(layout.view_depth_plane), dvec3(shift, 0.0));
  // A cube's radial distances do not turn, and what moves across the light's axis keeps its depth.
  if (layout.kind == MapKind::perspective) {
    const double farther = largest_depth(shifted, bounds) - largest_depth(layout, bounds);
    shifted.far_depth += std::max(farther, 0.0);
  }
  return shifted;
}

View shift_view(const View& view, const dvec2& pixels) {
  View shifted = view;
  dmat4 change(1.0);
  if (const auto* flat = std::get_if<OrthographicProjection>(&view.camera.projection)) {
    const double pixel = 2.0 * flat->half_height / view.height;
    change = glm::translate(change, dvec3(pixels.x * pixel, -pixels.y * pixel, 0.0));
  } else {
    const double fov = std::get<PerspectiveProjection>(view.camera.projection).vertical_fov;
    const double pixel = 2.0 * std::tan(0.5 * fov) / view.height;
    change = turn(-std::atan(pixels.x * pixel), y_axis) * turn(-std::atan(pixels.y * pixel), x_axis);
  }
  shifted.camera.world_from_camera = view.camera.world_from_camera * change;
  return shifted;
}

Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted) {
  return count(before, after, [&](std::size_t i) { return counted.exclusion[i] == PixelExclusion::none; });
}

Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted,
                  const GBuffer& gbuffer_before, const GBuffer& gbuffer_after) {
  return count(before, after, [&](std::size_t i) {
    return counted.exclusion[i] == PixelExclusion::none && gbuffer_before.instance[i] == gbuffer_after.instance[i] &&
           gbuffer_before.triangle[i] == gbuffer_after.triangle[i];
  });
}

}  // namespace umbrameter
