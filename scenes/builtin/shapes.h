// A small kit of closed solids, from which the built-in scenes are made.
// Internal to scenes/builtin*. Metres; every solid is closed and turned outwards, with its edges shared by index.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "scenes/scene.h"

namespace umbrameter::builtin {

/// Triangles that share their points wherever the surface goes on.
struct Shape {
  std::vector<dvec3> points;
  std::vector<uvec3> faces;
};

/// `other`, moved by `transform`, beside what is there. The two stay separate solids.
void append(Shape& shape, const Shape& other, const dmat4& transform = dmat4(1.0));

Shape box(const dvec3& low, const dvec3& high);

/// A box-like solid of eight corners (bit 0 of the index is x, bit 1 y, bit 2 z) with every edge cut off.
Shape chamfered(const std::array<dvec3, 8>& corners, double chamfer);
Shape chamfered_box(const dvec3& low, const dvec3& high, double chamfer);
/// A box whose top has its edges cut off: for slabs that show nothing else.
Shape bevelled_slab(const dvec3& low, const dvec3& high, double bevel);

/// One solid of several boxes less several others, on a common grid: no face lies inside or on another.
Shape carved(std::span<const Bounds> solids, std::span<const Bounds> holes = {});

/// Turns a profile of (radius, height) about the y axis. It starts and ends on the axis.
Shape lathe(std::span<const dvec2> profile, int segments);
Shape sphere(double radius, int segments);

/// The area between two polylines of as many points each, drawn out from z = 0 to z = depth.
Shape band(std::span<const dvec2> lower, std::span<const dvec2> upper, double depth);

/// A round rod along a path, with flat ends.
Shape tube(std::span<const dvec3> path, std::span<const double> radii, int sides);

/// Normals smooth across edges that bend less than `crease` degrees, sharp across the others.
/// `texcoord` gives the texture coordinate of a point; empty: none are stored.
Mesh to_mesh(const std::string& name, const Shape& shape, std::uint32_t material, double crease = 35.0,
             const std::function<vec2(const dvec3&)>& texcoord = {});

}  // namespace umbrameter::builtin
