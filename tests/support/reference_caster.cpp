#include "tests/support/reference_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/material.h"

namespace umbrameter {
namespace {

constexpr std::uint32_t leaf_size = 4;

bool meets_box(const dvec3& low, const dvec3& high, const dvec3& origin, const dvec3& inverse, double t_max) {
  double enter = 0.0;
  double leave = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    double t0 = (low[axis] - origin[axis]) * inverse[axis];
    double t1 = (high[axis] - origin[axis]) * inverse[axis];
    if (std::isnan(t0) || std::isnan(t1)) continue;  // in the plane of a face: the other axes decide
    if (t0 > t1) std::swap(t0, t1);
    enter = std::max(enter, t0 * (1.0 - 1e-15));
    leave = std::min(leave, t1 * (1.0 + 1e-15));
  }
  return enter <= leave;
}

}  // namespace

ReferenceCaster::ReferenceCaster(const Scene& scene) : scene_(scene) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto corner = [&](std::uint32_t v) {
        return dvec3(instance.world_from_mesh * dvec4(dvec3(mesh.positions[v]), 1.0));
      };
      const uvec3 v = mesh.triangles[t];
      facets_.push_back({corner(v.x), corner(v.y), corner(v.z), i, t});
    }
  }
  nodes_.reserve(2 * facets_.size() + 1);
  if (!facets_.empty()) build(0, static_cast<std::uint32_t>(facets_.size()));
}

std::uint32_t ReferenceCaster::build(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  dvec3 low(std::numeric_limits<double>::infinity());
  dvec3 high(-std::numeric_limits<double>::infinity());
  dvec3 center_low = low;
  dvec3 center_high = high;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Facet& f = facets_[i];
    low = glm::min(low, glm::min(f.a, glm::min(f.b, f.c)));
    high = glm::max(high, glm::max(f.a, glm::max(f.b, f.c)));
    const dvec3 center = f.a + f.b + f.c;
    center_low = glm::min(center_low, center);
    center_high = glm::max(center_high, center);
  }
  nodes_[index].low = low;
  nodes_[index].high = high;
  if (count <= leaf_size) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  const dvec3 extent = center_high - center_low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto begin = facets_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Facet& p, const Facet& q) {
    return p.a[axis] + p.b[axis] + p.c[axis] < q.a[axis] + q.b[axis] + q.c[axis];
  });
  const std::uint32_t left = build(first, count / 2);
  const std::uint32_t right = build(first + count / 2, count - count / 2);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

bool ReferenceCaster::counts(const Facet& facet, double v, double w, const dvec3& direction, bool cull) const {
  const Instance& instance = scene_.instances[facet.instance];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  const Material& material = scene_.materials[mesh.material];
  if (cull && !material.double_sided) {
    const bool mirrored = glm::determinant(dmat3(instance.world_from_mesh)) < 0.0;
    const bool away = glm::dot(glm::cross(facet.b - facet.a, facet.c - facet.a), direction) > 0.0;
    if (away != mirrored) return false;
  }
  if (material.alpha_mode == AlphaMode::mask) {
    vec2 uv(0);
    if (!mesh.texcoords.empty()) {
      const uvec3 corner = mesh.triangles[facet.triangle];
      uv = vec2((1.0 - v - w) * dvec2(mesh.texcoords[corner.x]) + v * dvec2(mesh.texcoords[corner.y]) +
                w * dvec2(mesh.texcoords[corner.z]));
    }
    if (alpha_at(scene_, material, uv) < material.alpha_cutoff) return false;
  }
  return true;
}

std::optional<ReferenceCaster::Hit> ReferenceCaster::nearest(const dvec3& origin, const dvec3& direction, double t_min,
                                                             double t_max, bool cull) const {
  std::optional<Hit> best;
  if (nodes_.empty()) return best;
  const dvec3 inverse = 1.0 / direction;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (!meets_box(node.low, node.high, origin, inverse, t_max)) continue;
    if (node.count == 0) {
      stack.push_back(node.left);
      stack.push_back(node.right);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Facet& f = facets_[i];
      // Plane, then the three edge tests, all by signed volumes.
      const dvec3 normal = glm::cross(f.b - f.a, f.c - f.a);
      const double fall = glm::dot(normal, direction);
      if (fall == 0.0) continue;
      const double t = glm::dot(normal, f.a - origin) / fall;
      if (!(t > t_min && t < t_max)) continue;
      const dvec3 p = origin + t * direction;
      const double area = glm::dot(normal, normal);
      const double v = glm::dot(normal, glm::cross(p - f.a, f.c - f.a)) / area;
      const double w = glm::dot(normal, glm::cross(f.b - f.a, p - f.a)) / area;
      if (v < 0.0 || w < 0.0 || v + w > 1.0) continue;
      if (!counts(f, v, w, direction, cull)) continue;
      best = Hit{t, f.instance, f.triangle};
      t_max = t;
    }
  }
  return best;
}

bool ReferenceCaster::is_blocked(const dvec3& point, std::uint32_t own_instance, std::uint32_t own_triangle,
                                 const Light& light, double neighbour_gap) const {
  dvec3 direction = -light.axis();
  double t_max = std::numeric_limits<double>::infinity();
  if (!std::holds_alternative<DirectionalLight>(light.shape)) {
    direction = light.position() - point;
    t_max = glm::length(direction);
    direction /= t_max;
  }
  double t_min = neighbour_gap;
  for (;;) {
    const std::optional<Hit> hit = nearest(point, direction, t_min, t_max, false);
    if (!hit) return false;
    if (hit->instance != own_instance || hit->triangle != own_triangle) return true;
    t_min = hit->t;
  }
}

Image<std::uint8_t> near_edges(const Image<float>& visibility) {
  Image<std::uint8_t> edges(visibility.width, visibility.height, 0);
  for (int y = 0; y < edges.height; ++y) {
    for (int x = 0; x < edges.width; ++x) {
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, edges.height - 1); ++ny) {
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, edges.width - 1); ++nx) {
          if (visibility.at(nx, ny) != visibility.at(x, y)) edges.at(x, y) = 1;
        }
      }
    }
  }
  return edges;
}

}  // namespace umbrameter
