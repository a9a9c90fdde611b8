// A second implementation of hard shadows that shares nothing with raytrace/: plain double-precision rays against
// world-space triangles in a small tree of boxes of its own. Slow and simple.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/view.h"

namespace umbrameter {

class ReferenceCaster {
 public:
  explicit ReferenceCaster(const Scene& scene);

  struct Hit {
    double t = 0.0;
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
  };
  /// Nearest hit with t_min < t < t_max that counts: masked-out points do not, nor, with cull, back faces of
  /// single-sided materials.
  std::optional<Hit> nearest(const dvec3& origin, const dvec3& direction, double t_min, double t_max, bool cull) const;

  /// Whether anything but the surfel's own triangle lies between the point and the light. Hits nearer than
  /// `neighbour_gap` metres along the ray are taken for rounding of the neighbours and do not count.
  bool is_blocked(const dvec3& point, std::uint32_t own_instance, std::uint32_t own_triangle, const Light& light,
                  double neighbour_gap) const;

 private:
  struct Facet {
    dvec3 a, b, c;
    std::uint32_t instance, triangle;
  };
  struct Node {
    dvec3 low, high;
    std::uint32_t first = 0, count = 0;  // of a leaf
    std::uint32_t left = 0, right = 0;   // of an inner node
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  bool counts(const Facet& facet, double v, double w, const dvec3& direction, bool cull) const;

  const Scene& scene_;
  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
};

/// Pixels in whose 3 × 3 neighbourhood the image changes: where two exact methods may differ by rounding.
Image<std::uint8_t> near_edges(const Image<float>& visibility);

}  // namespace umbrameter
