#include <cmath>

#include "scenes/builtin/city.h"

namespace umbrameter::builtin {
namespace {

// On four braced legs.
void add_water_tank(Block& block, const dvec3& foot, int detail) {
  Mesh& steel = block.meshes[iron];
  const double half = 1.15, legs = 2.4;
  for (const double x : {-half, half}) {
    for (const double z : {-half, half}) {
      add_box(steel, foot + dvec3(x - 0.09, -0.1, z - 0.09), foot + dvec3(x + 0.09, legs, z + 0.09));
    }
  }
  for (const double side : {-half, half}) {
    add_box(steel, foot + dvec3(-half - 0.2, legs - 0.02, side - 0.07),
            foot + dvec3(half + 0.2, legs + 0.14, side + 0.07));
    if (detail < 1) continue;
    for (const double way : {-1.0, 1.0}) {
      for (const bool across : {false, true}) {
        std::array<dvec3, 8> corners;
        for (std::size_t c = 0; c < 8; ++c) {
          const double end = (c & 1u) != 0 ? 1.0 : -1.0;
          const dvec3 p(end * half, 0.2 + (way * end + 1.0) * 0.95 + ((c & 2u) != 0 ? 0.07 : 0.0),
                        side + ((c & 4u) != 0 ? 0.03 : -0.03));
          corners[c] = foot + (across ? dvec3(p.z, p.y, -p.x) : p);
        }
        add_solid(steel, corners);
      }
    }
  }
  const int sides = detail >= 3 ? 40 : detail >= 1 ? 20 : 8;
  const std::array<dvec2, 6> staves{dvec2(0, 0), {1.5, 0}, {1.58, 0.05}, {1.52, 2.7}, {1.48, 2.75}, {0, 2.75}};
  add_shape(block.meshes[timber], lathe(staves, sides), foot + dvec3(0, legs + 0.1, 0));
  const std::array<dvec2, 4> hat{dvec2(0, 0), {1.75, 0}, {1.75, 0.06}, {0, 1.05}};
  add_shape(block.meshes[roofing], lathe(hat, sides), foot + dvec3(0, legs + 2.83, 0));
  for (int i = 0; i < 4 && detail >= 2; ++i) {
    const double y = legs + 0.35 + 0.62 * i;
    const std::array<dvec2, 6> hoop{dvec2(0, y),     {1.59, y},        {1.6, y + 0.01},
                                    {1.6, y + 0.05}, {1.59, y + 0.06}, {0, y + 0.06}};
    add_shape(steel, lathe(hoop, sides), foot + dvec3(0, 0.1, 0));
  }
}

void add_vent(Block& block, const dvec3& foot, int detail) {
  Mesh& mesh = block.meshes[iron];
  add_box(mesh, foot + dvec3(-0.7, -0.1, -0.5), foot + dvec3(0.7, 0.95, 0.5));
  for (int i = 0; i < 6 && detail >= 2; ++i) {
    const double y = 0.12 + 0.13 * i;
    add_box(mesh, foot + dvec3(-0.6, y, 0.45), foot + dvec3(0.6, y + 0.05, 0.54));
  }
}

}  // namespace

void add_mast(Mesh& mesh, const dvec3& foot, double height, int detail) {
  const std::array<dvec3, 2> pole{foot - dvec3(0, 0.1, 0), foot + dvec3(0, height, 0)};
  const std::array<double, 2> radii{0.022 * height, 0.03};
  add_shape(mesh, tube(pole, radii, detail >= 2 ? 10 : 6), dvec3(0));
  for (int i = 0; i < 3 * detail; ++i) {
    const dvec3 middle = foot + dvec3(0, height * (0.45 + 0.5 * i / (3.0 * detail)), 0);
    const double reach = 0.3 + 0.05 * height * (1.0 - i / (3.0 * detail));
    const dvec3 half = i % 2 == 0 ? dvec3(reach, 0.02, 0.02) : dvec3(0.02, 0.021, reach);
    add_box(mesh, middle - half, middle + half);
  }
}

void add_roof_things(Block& block, const Lot& lot, double height, std::uint32_t seed, int detail) {
  const dvec2 low{lot.x0 + 2.3, lot.z0 + 2.3}, high{lot.x1 - 2.3, lot.z1 - 2.3};
  const auto spot = [&](double u, double v) {
    return dvec3(glm::mix(low.x, high.x, u), height, glm::mix(low.y, high.y, v));
  };
  // The stair's head, with a door and a slab.
  const dvec3 stair = spot(0.15, 0.3);
  add_box(block.meshes[wall], stair + dvec3(-1.4, -0.15, -1.7), stair + dvec3(1.4, 2.5, 1.7));
  add_box(block.meshes[trim], stair + dvec3(-1.6, 2.45, -1.9), stair + dvec3(1.6, 2.65, 1.9));
  add_box(block.meshes[timber], stair + dvec3(1.3, -0.05, -0.5), stair + dvec3(1.45, 2.0, 0.5));
  if (chance(seed, 20) < 0.6) add_water_tank(block, spot(0.8, chance(seed, 21, 0.3, 0.7)), detail);
  if (detail < 1) return;
  for (int i = 0; i < 2 + detail; ++i) {
    const double u = chance(seed, 30 + static_cast<std::uint32_t>(i), 0.38, 0.58);
    add_vent(block, spot(u, (i + 0.5) / (2 + detail)), detail);
  }
  // Chimneys on the party wall.
  for (int i = 0; i < 2; ++i) {
    const dvec3 foot{lot.x1 - 0.75, height, glm::mix(low.y, high.y, 0.2 + 0.6 * i)};
    add_box(block.meshes[wall], foot + dvec3(-0.35, -0.1, -0.6), foot + dvec3(0.35, 2.4, 0.6));
    for (const double z : {-0.3, 0.3}) {
      const std::array<dvec2, 4> pot{dvec2(0, 2.3), {0.17, 2.3}, {0.13, 2.9}, {0, 2.9}};
      add_shape(block.meshes[timber], lathe(pot, detail >= 2 ? 12 : 6), foot + dvec3(0, 0, z));
    }
  }
  if (detail >= 2) {
    // Aerials: a pole with rods across.
    for (std::uint32_t i = 0; i < 3; ++i) {
      const dvec3 foot = spot(chance(seed, 40 + i), chance(seed, 50 + i));
      add_box(block.meshes[iron], foot + dvec3(-0.025, -0.1, -0.025), foot + dvec3(0.025, 3.1, 0.025));
      add_box(block.meshes[iron], foot + dvec3(-0.9, 2.9, -0.02), foot + dvec3(0.9, 2.94, 0.02));
      for (int k = 0; k < 7; ++k) {
        const double x = -0.84 + 0.28 * k, reach = 0.22 + 0.04 * k;
        add_box(block.meshes[iron], foot + dvec3(x - 0.012, 2.905, -reach), foot + dvec3(x + 0.012, 2.93, reach));
      }
    }
  }
}

}  // namespace umbrameter::builtin
