#include "compare/edge_scale.h"

#include <limits>

namespace umbrameter {
namespace {

// World displacements of the point that is seen, per pixel to the right and down, along the plane of the surfel.
struct Footprint {
  dvec3 right{0.0};
  dvec3 down{0.0};
};

dvec3 hit_plane(const Ray& ray, const dvec3& position, const dvec3& normal) {
  return ray.origin + ray.direction * (glm::dot(position - ray.origin, normal) / glm::dot(ray.direction, normal));
}

Footprint footprint_at(const GBuffer& gbuffer, const View& view, std::size_t pixel) {
  const int x = static_cast<int>(pixel % static_cast<std::size_t>(gbuffer.width));
  const int y = static_cast<int>(pixel / static_cast<std::size_t>(gbuffer.width));
  const dvec3 position(gbuffer.position[pixel]);
  const dvec3 normal(gbuffer.geometric_normal[pixel]);
  const auto at = [&](int column, int row) { return hit_plane(pixel_ray(view, column, row), position, normal); };
  return {0.5 * (at(x + 1, y) - at(x - 1, y)), 0.5 * (at(x, y + 1) - at(x, y - 1))};
}

// Metres between two parallel lines along the tangent that are one pixel apart in the image: the area that a pixel
// covers over the length of the tangent.
double metres_across(const Footprint& footprint, const dvec2& tangent) {
  const dvec3 along = tangent.x * footprint.right + tangent.y * footprint.down;
  return glm::length(glm::cross(footprint.right, footprint.down)) / glm::length(along);
}

}  // namespace

EdgeScale edge_scale(const GBuffer& gbuffer, const View& view, const Light& light, const MapLayout& layout) {
  return [&gbuffer, view, light, layout](std::size_t pixel, const dvec2& tangent) -> LengthFactors {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (!gbuffer.is_surface(pixel)) return {nan, nan};
    const Footprint footprint = footprint_at(gbuffer, view, pixel);
    const dvec3 position(gbuffer.position[pixel]);
    const dvec3 axis = to_light(light, position);
    const auto seen_by_light = [&](const dvec3& vector) { return vector - axis * glm::dot(axis, vector); };
    const Footprint in_map{seen_by_light(footprint.right), seen_by_light(footprint.down)};
    return {metres_across(in_map, tangent) / texel_at(layout, position), metres_across(footprint, tangent)};
  };
}

}  // namespace umbrameter
