// What the city is built of: boxes put straight into meshes of their own, building by building.
// Internal to scenes/builtin*.
#pragma once

#include <array>
#include <vector>

#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {

/// What a building is made of; one mesh each.
enum Fabric : std::size_t { wall, trim, glass, iron, roofing, timber, paint, paving, foliage, fabrics };

/// The solids of one building or block, in world space.
struct Block {
  std::array<Mesh, fabrics> meshes;
};
std::uint64_t triangles_of(const Block& block);

/// A closed solid of eight corners (bit 0 of the index is x, bit 1 y, bit 2 z), without shared normals: flat faces.
void add_solid(Mesh& mesh, const std::array<dvec3, 8>& corners);
void add_box(Mesh& mesh, const dvec3& low, const dvec3& high);
void add_shape(Mesh& mesh, const Shape& shape, const dvec3& offset);

/// One side of a house: u runs along it, y up, w out of it, from the outer lower corner on the left.
struct Face {
  dvec3 origin{0.0};
  dvec3 along{1, 0, 0};
  dvec3 outward{0, 0, 1};
  double width = 0.0;
  dvec3 at(double u, double y, double w) const { return origin + u * along + dvec3(0, y, 0) + w * outward; }
};
/// A box in a face's frame.
void add_box(Mesh& mesh, const Face& face, const dvec3& low, const dvec3& high);

/// A footprint, metres.
struct Lot {
  double x0 = 0.0, x1 = 0.0, z0 = 0.0, z1 = 0.0;
  bool faces_back = false;                     ///< its street lies in the north (−z)
  bool open_left = false, open_right = false;  ///< nothing adjoins at x0, at x1
};

enum class Style : int { tenement, palace, tower };

struct House {
  Lot lot;
  Style style = Style::tenement;
  int floors = 5;
  std::uint32_t seed = 0;
};

/// `detail` from 0, bare walls with window openings, to 4, louvred shutters. More detail is more triangles.
Block build(const House& house, int detail);

// city_roofs.cpp: what stands on a roof whose top is at `height`.
void add_roof_things(Block& block, const Lot& lot, double height, std::uint32_t seed, int detail);
void add_mast(Mesh& mesh, const dvec3& foot, double height, int detail);

// city_streets.cpp: pavements, lamps, crossings, benches and cars about one city block.
Block pave(const Lot& block, std::uint32_t seed, int detail);

}  // namespace umbrameter::builtin
