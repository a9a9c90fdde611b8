// What grows in the forest, and the ground that it grows on. Internal to scenes/builtin*.
#pragma once

#include <vector>

#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {

/// Wood is solid; leaves and needles are triangles of their own, without thickness.
struct Plant {
  Shape wood;
  Shape leaves;
};

/// A broad-leaved tree. Lengths in metres, for a tree that is used unscaled.
struct BroadleafStyle {
  std::uint32_t seed = 0;
  double height = 12.0;
  double crown_start = 0.35;  ///< share of the height where the lowest limb leaves the trunk
  double spread = 3.5;        ///< reach of the longest limb
  double trunk_radius = 0.22;
  double rise = 0.6;  ///< slope of the limbs; negative: they hang
  int limbs = 12;
  int twigs = 4;    ///< on each limb
  int leaves = 24;  ///< about each twig
  double leaf = 0.26;
  double clump = 0.55;  ///< radius of the leaves about a twig's end
};

// forest_trees.cpp
Plant broadleaf(const BroadleafStyle& style);
/// Whorls of drooping branches with needle sprays about a straight trunk.
Plant spruce(std::uint32_t seed, double height, double reach, int whorls, int branches);
Plant bush(std::uint32_t seed, double radius, int stems, int leaves);

// forest_plants.cpp
void add_quad(Shape& shape, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d);
/// Arched fronds with leaflets on both sides.
Shape fern_fronds(std::uint32_t seed, int fronds, double length);
Shape grass_tuft(std::uint32_t seed, int blades, double height);
/// A few stalks with a star of petals each.
Shape blossoms(std::uint32_t seed, int flowers, double height);
Shape rock(std::uint32_t seed, const dvec3& radii, int segments);
Shape fallen_log(double length, double radius);
Shape lantern_post();

/// Smooth values from 0 to 1 over the plane, that change within about a metre.
double noise(std::uint32_t seed, double x, double z);

/// Metres from the border of the clearing and of the path: negative inside. The layout repeats, mirrored.
double beyond_open_ground(double x, double z);
double beyond_path(double x, double z);
/// Edge of the square that the layout repeats over, metres.
inline constexpr double ground_tile = 80.0;
/// Moss, litter, grass and sand, as seen from above; covers one tile.
Texture forest_ground();

/// A square of ground about the origin.
struct Ground {
  double half = 0.0;  ///< metres
  int cells = 1;      ///< along each edge
  /// Height of the surface as it is drawn, facets included.
  double height(double x, double z) const;
};
/// Of both meshes.
std::uint64_t triangles_of(const Ground& ground);
Mesh ground_mesh(const Ground& ground, std::uint32_t material);
/// Bare soil, where the square is cut off.
Mesh ground_sides(const Ground& ground, std::uint32_t material);

}  // namespace umbrameter::builtin
