// A bounded number of a scene's triangles, by which views are judged without OpenGL and without a ray tracer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

struct SampledTriangle {
  /// Relative to the centre of the scene's bounds, in their radii; counter-clockwise seen from the front.
  std::array<vec3, 3> corners{};
  std::uint32_t object = 0;
  /// Equal for triangles of one object and material that face about the same way in about the same plane.
  std::uint64_t surface = 0;
  float weight = 1.0f;  ///< triangles of the scene that it stands for
  bool is_double_sided = false;
  bool front_faces_light = false;  ///< any light of the scene, or default_sun() where it has none
  bool back_faces_light = false;
};

struct TriangleSample {
  Bounds bounds;
  std::vector<SampledTriangle> triangles;

  dvec3 center() const { return bounds.empty() ? dvec3(0) : bounds.center(); }
  double radius() const { return bounds.radius() > 0.0 ? bounds.radius() : 1.0; }
};

/// All triangles, but those of the ground, of a scene that has at most max_count. Else each large one, and of the small
/// ones every n-th, with n times its area, so that surfaces stay as dense as they look (Cook et al., Stochastic
/// Simplification of Aggregate Detail, 2007). The same scene gives the same sample.
TriangleSample sample_triangles(const Scene& scene, std::size_t max_count = 40'000);

}  // namespace umbrameter
