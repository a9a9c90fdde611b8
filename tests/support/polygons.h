// Shares of the hemisphere that flat polygons and convex solids take, in closed form.
#pragma once

#include <cmath>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter::polygons {

using Polygon = std::vector<dvec3>;

/// The part above the horizon of a point at the origin with that normal (Sutherland and Hodgman 1974, one plane).
inline Polygon above_horizon(const Polygon& polygon, const dvec3& normal) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3& a = polygon[i];
    const dvec3& b = polygon[(i + 1) % polygon.size()];
    const double from = glm::dot(normal, a);
    const double to = glm::dot(normal, b);
    if (from >= 0.0) part.push_back(a);
    if ((from >= 0.0) != (to >= 0.0)) part.push_back(a + (b - a) * (from / (from - to)));
  }
  return part;
}

inline Polygon seen_from(Polygon polygon, const dvec3& point) {
  for (dvec3& corner : polygon) corner -= point;
  return polygon;
}

/// Lambert: |Σ angle(v_i, v_{i+1}) · n·(v_i × v_{i+1})/|v_i × v_{i+1}|| / 2π.
inline double cosine_share(const Polygon& polygon, const dvec3& point, const dvec3& normal) {
  const Polygon part = above_horizon(seen_from(polygon, point), normal);
  double sum = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const dvec3 a = glm::normalize(part[i]);
    const dvec3 b = glm::normalize(part[(i + 1) % part.size()]);
    const dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 1e-12) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, across) / sine;
  }
  return std::abs(sum) / (2.0 * pi);
}

/// Solid angle over 2π, as a fan of triangles: tan(Ω/2) = a·(b × c) / (1 + a·b + b·c + c·a) of unit vectors (Van
/// Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983).
inline double uniform_share(const Polygon& polygon, const dvec3& point, const dvec3& normal) {
  const Polygon part = above_horizon(seen_from(polygon, point), normal);
  double sum = 0.0;
  for (std::size_t i = 2; i < part.size(); ++i) {
    const dvec3 a = glm::normalize(part[0]);
    const dvec3 b = glm::normalize(part[i - 1]);
    const dvec3 c = glm::normalize(part[i]);
    sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return std::abs(sum) / (2.0 * pi);
}

/// Of a convex solid, whose triangles turn any way: the sum over those that look at the point.
inline double share_of_convex(const Mesh& mesh, const dvec3& point, const dvec3& normal, bool is_cosine) {
  dvec3 middle(0.0);
  for (const vec3& p : mesh.positions) middle += dvec3(p) / static_cast<double>(mesh.positions.size());
  double sum = 0.0;
  for (const uvec3& t : mesh.triangles) {
    const Polygon face = {dvec3(mesh.positions[t.x]), dvec3(mesh.positions[t.y]), dvec3(mesh.positions[t.z])};
    const dvec3 across = glm::cross(face[1] - face[0], face[2] - face[0]);
    const bool is_turned = glm::dot(across, face[0] - middle) * glm::dot(across, point - face[0]) > 0.0;
    if (is_turned) sum += is_cosine ? cosine_share(face, point, normal) : uniform_share(face, point, normal);
  }
  return sum;
}

}  // namespace umbrameter::polygons
