#include "tests/support/reference/volume_counters.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "techniques/shading/light_model.h"

namespace umbrameter {
namespace {

// Rasterisers snap vertices to 1/256 px or finer; twice that, for both ends of an edge.
constexpr double edge_margin = 2.0 / 256.0;
// Share of the depth within which two depths count as equal: float depth buffers resolve more.
constexpr double depth_margin = 1e-5;

// Where the ray enters (front faces) or leaves (back faces) a convex mesh.
struct Crossing {
  double depth = std::numeric_limits<double>::quiet_NaN();  // NaN: none
  bool is_near_edge = false;
};

struct Segment {
  dvec3 a, b;
};

class VolumeRays {
 public:
  VolumeRays(const LightVolume& volume, const View& view)
      : volume_(volume), view_(view), clip_from_world_(clip_from_view(view) * view_from_world(view)) {
    // The outline: the edges between a face that is turned to the viewer and one that is turned away.
    std::map<std::pair<unsigned, unsigned>, bool> is_front;
    for (const uvec3& t : volume.triangles) {
      const dvec3 a(volume.positions[t.x]);
      for (int i = 0; i < 3; ++i) is_front[{t[i], t[(i + 1) % 3]}] = glm::dot(normal(t), to_viewer(view, a)) > 0.0;
    }
    for (const auto& [edge, is_front_here] : is_front) {
      if (is_front_here && !is_front.at({edge.second, edge.first})) {
        outline_.push_back({dvec3(volume.positions[edge.first]), dvec3(volume.positions[edge.second])});
      }
    }
  }

  Crossing cross(int x, int y, VolumeFaces faces) const {
    const Ray ray = pixel_ray(view_, x, y);
    Crossing crossing;
    crossing.is_near_edge =
        is_near_outline({(x + 0.5) / view_.width * 2.0 - 1.0, 1.0 - (y + 0.5) / view_.height * 2.0});
    for (const uvec3& t : volume_.triangles) {
      const dvec3 a(volume_.positions[t.x]);
      const dvec3 b(volume_.positions[t.y]);
      const dvec3 c(volume_.positions[t.z]);
      const dvec3 n = normal(t);
      const double along = glm::dot(n, ray.direction);
      if ((along < 0.0) != (faces == VolumeFaces::front)) continue;
      const double distance = glm::dot(n, a - ray.origin) / along;
      if (!(distance > 0.0)) continue;  // behind the near plane, where the ray starts
      const dvec3 hit = ray.origin + distance * ray.direction;
      if (glm::dot(glm::cross(b - a, hit - a), n) < 0.0 || glm::dot(glm::cross(c - b, hit - b), n) < 0.0 ||
          glm::dot(glm::cross(a - c, hit - c), n) < 0.0) {
        continue;
      }
      // The far plane clips front faces; of back faces the depth is clamped.
      if (faces == VolumeFaces::front && (clip_from_world_ * dvec4(hit, 1.0)).z < 0.0) continue;
      crossing.depth = -(view_from_world(view_) * dvec4(hit, 1.0)).z;
    }
    return crossing;
  }

 private:
  dvec3 normal(const uvec3& t) const {
    const dvec3 a(volume_.positions[t.x]);
    return glm::cross(dvec3(volume_.positions[t.y]) - a, dvec3(volume_.positions[t.z]) - a);
  }

  // Whether the outline passes within edge_margin of the pixel. Measures in clip space, times w, because an edge that
  // crosses the near plane is not a segment in the image.
  bool is_near_outline(const dvec2& ndc) const {
    for (const Segment& edge : outline_) {
      const dvec4 a = clip_from_world_ * dvec4(edge.a, 1.0);
      const dvec4 b = clip_from_world_ * dvec4(edge.b, 1.0);
      const dvec2 pixels(0.5 * view_.width, 0.5 * view_.height);
      const dvec2 from_a = (dvec2(a) - a.w * ndc) * pixels;
      const dvec2 from_b = (dvec2(b) - b.w * ndc) * pixels;
      const dvec2 ab = from_b - from_a;
      const double length2 = glm::dot(ab, ab);
      const double t = length2 > 0.0 ? glm::clamp(-glm::dot(from_a, ab) / length2, 0.0, 1.0) : 0.0;
      if (glm::length(from_a + t * ab) < edge_margin * std::abs(a.w + t * (b.w - a.w))) return true;
    }
    return false;
  }

  const LightVolume& volume_;
  const View& view_;
  dmat4 clip_from_world_;
  std::vector<Segment> outline_;
};

}  // namespace

VolumeCount count_volume(const GBuffer& gbuffer, const View& view, const Light& light, VolumeFaces faces) {
  VolumeCount count;
  const std::optional<LightVolume> volume = light_volume(light);
  if (!volume) return count;
  const VolumeRays rays(*volume, view);
  const shared::LightSource source = light_source(light);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::size_t i = gbuffer.instance.index(x, y);
      const bool is_surface = gbuffer.is_surface(i);
      const double depth = is_surface ? static_cast<double>(gbuffer.depth[i]) : std::numeric_limits<double>::infinity();
      const Crossing crossing = rays.cross(x, y, faces);
      if (crossing.is_near_edge || (is_surface && std::abs(crossing.depth - depth) <= depth_margin * depth)) {
        ++count.undecided;
        continue;
      }
      // Without a crossing the depth is NaN, and both comparisons are false.
      const bool is_shaded = faces == VolumeFaces::front ? crossing.depth < depth : crossing.depth > depth;
      const bool is_inside = is_surface && shared::is_in_volume(gbuffer.position[i], source);
      if (is_shaded) ++count.counters.shaded;
      if (is_shaded && !is_inside) ++count.counters.in_vain;
      if (!is_shaded && is_inside) ++count.counters.missed;
    }
  }
  return count;
}

}  // namespace umbrameter
