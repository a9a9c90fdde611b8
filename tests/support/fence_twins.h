// The built-in fence twice: once with the alpha mask only, once with its geometry in the mask's place.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/gbuffer.h"
#include "scenes/builtin.h"
#include "scenes/view.h"

namespace umbrameter::test {

struct FenceTwins {
  Scene masked, solid;          ///< instances have the same indices in both
  std::uint32_t instance = 0;   ///< the fence
  dmat4 panel_from_world{1.0};  ///< the fence lies in z = 0, its lower left corner at the origin
};

inline FenceTwins fence_twins() {
  FenceTwins twins;
  twins.masked = load_scene("fence");
  const auto index_of = [&](const std::string& name) {
    for (std::uint32_t i = 0; i < twins.masked.instances.size(); ++i) {
      if (twins.masked.objects[twins.masked.instances[i].object].name == name) return i;
    }
    throw std::runtime_error("no object " + name);
  };
  twins.instance = index_of("fence mask");
  const std::uint32_t geometry = index_of("fence geometry");
  const std::uint32_t mesh = twins.masked.instances[geometry].mesh;
  twins.masked.instances.erase(twins.masked.instances.begin() + geometry);
  twins.solid = twins.masked;
  twins.solid.instances[twins.instance].mesh = mesh;
  twins.panel_from_world = glm::inverse(twins.masked.instances[twins.instance].world_from_mesh);
  return twins;
}

enum class FencePoint : int { beside, open, bar, edge };

/// Where a ray meets the fence before `reach`. `edge`: within `margin` texels of a border between clear and opaque
/// texels, or where the four texels about the point make a corner, which the filtered mask rounds. The bars are known
/// from the picture alone: a texel is opaque or clear, 1/128 m wide, and beyond the panel all is clear.
inline FencePoint fence_point(const FenceTwins& twins, const dvec3& origin, const dvec3& direction, double margin,
                              double reach = std::numeric_limits<double>::infinity()) {
  const Image<glm::u8vec4>& texels = twins.masked.textures.front().texels;
  const dvec3 o(twins.panel_from_world * dvec4(origin, 1.0));
  const dvec3 d(twins.panel_from_world * dvec4(direction, 0.0));
  const double t = -o.z / d.z;
  if (!(t > 0.0 && t < reach)) return FencePoint::beside;
  const dvec2 p = 128.0 * dvec2(o + t * d);
  if (p.x < -margin || p.y < -margin || p.x > texels.width + margin || p.y > texels.height + margin) {
    return FencePoint::beside;
  }
  // Row 0 of the picture is the top.
  const auto opaque = [&](int x, int y) { return texels.at(x, texels.height - 1 - y).w != 0; };
  const auto is_bar = [&](double x, double y) {
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    return i >= 0 && j >= 0 && i < texels.width && j < texels.height && opaque(i, j);
  };
  const bool inside = is_bar(p.x, p.y);
  for (const double x : {-margin, margin}) {
    for (const double y : {-margin, margin}) {
      if (is_bar(p.x + x, p.y + y) != inside) return FencePoint::edge;
    }
  }
  const auto nearest = [&](int i, int j) {
    return opaque(std::clamp(i, 0, texels.width - 1), std::clamp(j, 0, texels.height - 1)) ? 1 : 0;
  };
  const int i = static_cast<int>(std::floor(p.x - 0.5)), j = static_cast<int>(std::floor(p.y - 0.5));
  const int a = nearest(i, j), b = nearest(i + 1, j), c = nearest(i, j + 1), e = nearest(i + 1, j + 1);
  const int sum = a + b + c + e;
  if (sum == 1 || sum == 3 || (sum == 2 && a == e)) return FencePoint::edge;
  return inside ? FencePoint::bar : FencePoint::open;
}

/// What a comparison of the two found.
struct TwinCount {
  int bars = 0, open = 0, edges = 0;
  int different = 0;  ///< off the edges
  int different_on_edges = 0;
};

/// Pixel by pixel: the same instance and, within `tolerance` metres, the same place.
inline TwinCount compare_coverage(const FenceTwins& twins, const View& view, const GBuffer& a, const GBuffer& b,
                                  double margin, float tolerance) {
  TwinCount count;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::size_t i = a.position.index(x, y);
      const Ray ray = pixel_ray(view, x, y);
      const FencePoint where = fence_point(twins, ray.origin, ray.direction, margin);
      const bool same = a.instance[i] == b.instance[i] &&
                        (!a.is_surface(i) || glm::length(a.position[i] - b.position[i]) < tolerance);
      if (where == FencePoint::edge) {
        ++count.edges;
        count.different_on_edges += same ? 0 : 1;
        continue;
      }
      count.different += same ? 0 : 1;
      count.bars += where == FencePoint::bar && a.instance[i] == twins.instance ? 1 : 0;
      count.open += where == FencePoint::open && a.instance[i] != twins.instance ? 1 : 0;
    }
  }
  return count;
}

/// No difference off the edges, among enough of both kinds of points.
inline void expect_same_coverage(const TwinCount& count, const std::string& camera) {
  EXPECT_EQ(count.different, 0) << camera;
  EXPECT_GT(count.bars, 3000) << camera;
  EXPECT_GT(count.open, 6000) << camera;
  EXPECT_LT(count.edges, (count.bars + count.open) / 4) << camera;
}

}  // namespace umbrameter::test
