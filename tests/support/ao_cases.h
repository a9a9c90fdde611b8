// Ambient occlusion of a floor point whose exact answer is known: scenes, points and formulas. O = 1 − accessibility.
// Sources: Howell, A Catalog of Radiation Heat Transfer Configuration Factors; Lambert's polygon formula.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "techniques/truth/parameters.h"
#include "tests/support/polygons.h"
#include "tests/support/shapes.h"

namespace umbrameter::ao_cases {

/// Half the side of the square floor at y = 0, metres.
inline constexpr float floor_half = 8.0f;

struct Case {
  std::string name;
  Mesh occluder;
  vec3 point{0};
  AoWeight weight = AoWeight::cosine;
  double distance = 0.0;  ///< limit, metres; 0 for none
  double accessibility = 1.0;
};

/// The occluder over the floor, which is instance 0.
inline Scene scene_of(const Case& c) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-floor_half, 0, floor_half}, {2 * floor_half, 0, 0}, {0, 0, -2 * floor_half}));
  shapes::add_mesh(scene, c.occluder);
  return scene;
}

/// `count` pixels that all see the case's point: each has points of its own, as if each had a seed of its own.
inline GBuffer surfels_of(const Case& c, int count) {
  return shapes::surfels(std::vector<vec3>(static_cast<std::size_t>(count), c.point), {0, 1, 0}, 0,
                         [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
}

inline TruthParams params_of(const Case& c) {
  TruthParams params;
  params.ao_weight = c.weight;
  params.ao_distance = c.distance;
  return params;
}

/// One case of each kind, none of them symmetric to every sampling pattern.
inline std::vector<Case> all() {
  constexpr AoWeight cosine = AoWeight::cosine;
  constexpr AoWeight uniform = AoWeight::uniform;
  // 200 m to either side: what lies beyond is less than 10⁻⁵ of the hemisphere.
  const Mesh wall = shapes::quad({0, 0, -200}, {0, 1, 0}, {0, 0, 400});
  const Mesh overhead = shapes::sphere({0, 1.5f, 0}, 1.0f, 200, 400);
  const Mesh disk = shapes::disk({0, 1, 0}, 1.0f, 720);
  const Mesh ceiling = shapes::quad({-7, 2, -7}, {14, 0, 0}, {0, 0, 14});
  const double tilted = 2.25 + 4.0;  // L² of the sphere overhead, seen from 2 m aside
  const double root = std::sqrt((0.2 + 2.0) * (0.2 + 2.0) - 4.0 * 0.2);
  return {
      // O_cos = ½(1 − d/√(d² + h²)), O_uni = atan(h/d)/π.
      {"wall, h = d", wall, {1, 0, 0}, cosine, 0.0, 0.853553},
      {"wall, h = d, uniform", wall, {1, 0, 0}, uniform, 0.0, 0.75},
      {"wall, h = 4d", wall, {0.25f, 0, 0}, cosine, 0.0, 0.621268},
      // c = d/D, a = d/√(d² + h²), S(c) = acos c − c√(1 − c²): O_cos = (S(c) − a·S(c/a))/π; uniform by quadrature.
      {"wall, h = d, limit 2d", wall, {1, 0, 0}, cosine, 2.0, 0.868736},
      {"wall, h = d, limit 2d, uniform", wall, {1, 0, 0}, uniform, 2.0, 0.793870},
      // O_cos = cos θ·(R/L)², O_uni = 1 − √(1 − (R/L)²).
      {"sphere overhead", overhead, {0, 0, 0}, cosine, 0.0, 0.555556},
      {"sphere overhead, uniform", overhead, {0, 0, 0}, uniform, 0.0, 0.745356},
      {"sphere aside", overhead, {2, 0, 0}, cosine, 0.0, 1.0 - 1.5 / std::sqrt(tilted) / tilted},
      {"sphere aside, uniform", overhead, {2, 0, 0}, uniform, 0.0, std::sqrt(1.0 - 1.0 / tilted)},
      // O_cos = 1 − c², c = (h² + D² − R²)/(2hD): here (2.25 + 0.64 − 1)/2.4 = 0.7875.
      {"sphere overhead, limit", overhead, {0, 0, 0}, cosine, 0.8, 0.7875 * 0.7875},
      // O_cos = R³/(s² + R²)^{3/2}.
      {"sphere on the floor", shapes::sphere({0, 1.0001f, 0}, 1.0f, 200, 400), {2, 0, 0}, cosine, 0.0, 0.910557},
      // O_cos = ½(1 − (s² + h² − r²)/√((s² + h² + r²)² − 4r²s²)).
      {"disk", disk, {0, 0, 0}, cosine, 0.0, 0.5},
      {"disk, uniform", disk, {0, 0, 0}, uniform, 0.0, 0.707107},
      {"disk, off its axis", disk, {0.4f, 0, 0.2f}, cosine, 0.0, 1.0 - 0.5 * (1.0 - 0.2 / root)},
      // O_cos = 1 − (h/D)², O_uni = 1 − h/D.
      {"ceiling, limit", ceiling, {0, 0, 0.5f}, cosine, 3.0, 4.0 / 9.0},
      {"ceiling, limit, uniform", ceiling, {0, 0, 0.5f}, uniform, 3.0, 2.0 / 3.0},
      // Lambert's formula over the face that looks at the point.
      {"box", shapes::box({-3, 0, -1}, {-1, 2, 1}), {0, 0, 0}, cosine, 0.0, 0.809864},
      // Half the hemisphere, less what a wall of 20 m leaves at 1 mm.
      {"two planes", shapes::quad({0, 0, -20}, {0, 20, 0}, {0, 0, 40}), {0.001f, 0, 0}, cosine, 0.0, 0.5},
  };
}

inline Mesh together(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
  return mesh;
}

/// What all() leaves out: the other weight of each formula, limits on either side of their conditions, more planes, and
/// polygons and convex solids in any pose, also partly below the floor.
inline std::vector<Case> others() {
  constexpr AoWeight cosine = AoWeight::cosine;
  constexpr AoWeight uniform = AoWeight::uniform;
  const Mesh wall = shapes::quad({0, 0, -200}, {0, 1, 0}, {0, 0, 400});
  const Mesh high_wall = shapes::quad({0, 0, -200}, {0, 4, 0}, {0, 0, 400});
  const Mesh overhead = shapes::sphere({0, 1.5f, 0}, 1.0f, 200, 400);
  const Mesh disk = shapes::disk({0, 1, 0}, 1.0f, 720);
  const Mesh side = shapes::quad({0, 0, -20}, {0, 20, 0}, {0, 0, 40});
  const Mesh corner = together(side, shapes::quad({-20, 0, 0}, {0, 20, 0}, {40, 0, 0}));
  const vec3 crease{0.001f, 0, 0.001f};
  const auto groove = [](double opening) {
    const vec3 up = 20.0f * vec3(dvec3(std::cos(opening), std::sin(opening), 0));
    return shapes::quad({0, 0, -20}, up, {0, 0, 40});
  };
  std::vector<Case> cases = {
      {"wall, h = 4d, uniform", wall, {0.25f, 0, 0}, uniform, 0.0, 0.577979},
      // c = d/D ≥ a: O_cos = S(c)/π, O_uni = (1 − c)/2; S(.6) = acos .6 − .6 · .8. Beyond the limit nothing.
      {"wall above the limit", high_wall, {0.6f, 0, 0}, cosine, 1.0, 1.0 - (std::acos(0.6) - 0.48) / pi},
      {"wall above the limit, uniform", high_wall, {0.6f, 0, 0}, uniform, 1.0, 0.8},
      // O_uni = 1 − c with c as of the same case in all(); past the tangents' length √(h² − R²) the limit cuts nothing.
      {"sphere overhead, limit, uniform", overhead, {0, 0, 0}, uniform, 0.8, 0.7875},
      {"sphere overhead, limit past the tangents", overhead, {0, 0, 0}, cosine, 1.2, 0.555556},
      {"sphere overhead, limit past the tangents, uniform", overhead, {0, 0, 0}, uniform, 1.2, 0.745356},
      // 1 − √(1 − (R/L)²), L² = 5.
      {"sphere on the floor, uniform",
       shapes::sphere({0, 1.0001f, 0}, 1.0f, 200, 400),
       {2, 0, 0},
       uniform,
       0.0,
       0.894427},
      // On the axis a ray at μ = cos θ goes h/μ, within the limit from μ = h/D: O_cos = 1 − μ², O_uni = 1 − μ.
      {"disk, limit", disk, {0, 0, 0}, cosine, 1.2, 1.0 / 1.44},
      {"disk, limit, uniform", disk, {0, 0, 0}, uniform, 1.2, 1.0 / 1.2},
      // A face at the point's foot, d → 0 in the wall's formula: half of the hemisphere, with a limit too.
      {"two planes, uniform", side, {0.001f, 0, 0}, uniform, 0.0, 0.5},
      {"two planes, limit", side, {0.001f, 0, 0}, cosine, 20.0, 0.5},
      {"three planes", corner, crease, cosine, 0.0, 0.25},
      {"three planes, uniform", corner, crease, uniform, 0.0, 0.25},
      // Opening Φ: AO_cos = sin²(Φ/2), AO_uni = Φ/π.
      {"groove of 60 degrees", groove(pi / 3.0), {0.001f, 0, 0}, cosine, 0.0, 0.25},
      {"groove of 60 degrees, uniform", groove(pi / 3.0), {0.001f, 0, 0}, uniform, 0.0, 1.0 / 3.0},
      {"groove of 120 degrees", groove(2.0 * pi / 3.0), {0.001f, 0, 0}, cosine, 0.0, 0.75},
      {"groove of 120 degrees, uniform", groove(2.0 * pi / 3.0), {0.001f, 0, 0}, uniform, 0.0, 2.0 / 3.0},
  };
  Mesh hanging;
  hanging.positions = {{-1, 0.5f, 0}, {2, 1.5f, -1}, {0, 2.5f, 1.5f}};
  hanging.triangles = {{0, 1, 2}};
  Mesh sunk;  // its lowest corner is below the floor
  sunk.positions = {{-0.8f, -0.7f, 0.9f}, {1.4f, 1.2f, -0.6f}, {-1.1f, 1.9f, -0.4f}};
  sunk.triangles = {{0, 1, 2}};
  for (const Mesh& polygon : {hanging, sunk}) {
    const polygons::Polygon corners(polygon.positions.begin(), polygon.positions.end());
    const vec3 point(0.3f, 0, 0.2f);
    const double above = polygons::cosine_share(corners, dvec3(point), {0, 1, 0});
    const double angle = polygons::uniform_share(corners, dvec3(point), {0, 1, 0});
    const std::string what = polygon.positions[0].y < 0.0f ? "triangle through the floor" : "hanging triangle";
    cases.push_back({what, polygon, point, cosine, 0.0, 1.0 - above});
    cases.push_back({what + ", uniform", polygon, point, uniform, 0.0, 1.0 - angle});
  }
  Mesh upright = shapes::box({-3, 0, -1}, {-1, 2, 1});
  Mesh tilted = shapes::box({-0.6f, -0.4f, -0.5f}, {0.6f, 0.4f, 0.5f});
  const dvec3 axis = glm::normalize(dvec3(1, 2, -0.7));
  for (vec3& p : tilted.positions) {
    // By 1 radian about the axis (Rodrigues), then aside; a corner is below the floor.
    const dvec3 v(p);
    const dvec3 turned =
        std::cos(1.0) * v + std::sin(1.0) * glm::cross(axis, v) + (1.0 - std::cos(1.0)) * glm::dot(axis, v) * axis;
    p = vec3(turned + dvec3(1.2, 0.45, 0.3));
  }
  for (const Mesh& solid : {upright, tilted}) {
    const std::string what = solid.positions[0].x < -2.0f ? "upright box" : "tilted box through the floor";
    for (const AoWeight weight : {cosine, uniform}) {
      const double share = polygons::share_of_convex(solid, dvec3(0), {0, 1, 0}, weight == cosine);
      cases.push_back({what + (weight == cosine ? "" : ", uniform"), solid, {0, 0, 0}, weight, 0.0, 1.0 - share});
    }
  }
  return cases;
}

}  // namespace umbrameter::ao_cases
