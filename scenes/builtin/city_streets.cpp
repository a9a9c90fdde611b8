#include <array>
#include <cmath>

#include "scenes/builtin/city.h"
#include "scenes/builtin/forest.h"

namespace umbrameter::builtin {
namespace {

constexpr double kerb = 0.15;  // height of the pavement, metres

void add_lamp(Block& block, const dvec3& foot, double side, int detail) {
  Mesh& mesh = block.meshes[iron];
  const int sides = detail >= 2 ? 10 : 5;
  const std::array<dvec3, 2> pole{foot - dvec3(0, 0.1, 0), foot + dvec3(0, 5.6, 0)};
  const std::array<double, 2> radii{0.1, 0.055};
  add_shape(mesh, tube(pole, radii, sides), dvec3(0));
  const dvec3 head = foot + dvec3(1.3 * side, 5.75, 0);
  const std::array<dvec3, 3> arm{foot + dvec3(0, 5.4, 0), foot + dvec3(0.55 * side, 5.85, 0), head};
  const std::array<double, 3> thin{0.05, 0.04, 0.035};
  add_shape(mesh, tube(arm, thin, sides), dvec3(0));
  add_box(mesh, head + dvec3(-0.35, -0.03, -0.14), head + dvec3(0.35, 0.09, 0.14));
  add_box(block.meshes[trim], head + dvec3(-0.3, -0.07, -0.1), head + dvec3(0.3, -0.02, 0.1));
}

void add_car(Block& block, const dvec3& middle, bool along_x, std::uint32_t seed, int detail) {
  const std::array<Fabric, 5> paints{paint, trim, iron, wall, timber};
  const Fabric body = paints[static_cast<std::size_t>(chance(seed, 1, 0.0, 4.99))];
  const dmat4 turn = along_x ? turned(90.0) : dmat4(1.0);
  const auto add = [&](Fabric fabric, const Shape& shape) {
    Shape placed;
    append(placed, shape, moved(middle) * turn);
    add_shape(block.meshes[fabric], placed, dvec3(0));
  };
  add(body, chamfered_box({-0.88, 0.32, -2.15}, {0.88, 0.92, 2.15}, 0.12));
  const auto cabin = [](double shrink, double low, double high) {
    std::array<dvec3, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) {
      const bool upper = (c & 2u) != 0;
      const double x = upper ? 0.6 : 0.78, z = upper ? 0.75 : 1.25;
      corners[c] = {((c & 1u) != 0 ? 1.0 : -1.0) * (x - shrink), upper ? high : low,
                    ((c & 4u) != 0 ? 1.0 : -1.0) * (z - shrink) + 0.15};
    }
    return corners;
  };
  add(glass, chamfered(cabin(0.0, 0.88, 1.4), 0.05));
  add(body, chamfered_box({-0.62, 1.36, -0.62}, {0.62, 1.46, 0.92}, 0.03));
  const int sides = detail >= 2 ? 18 : 8;
  const std::array<dvec2, 6> profile{dvec2(0, 0), {0.26, 0}, {0.32, 0.03}, {0.32, 0.19}, {0.26, 0.22}, {0, 0.22}};
  const Shape wheel = lathe(profile, sides);
  for (const double x : {-0.9, 0.68}) {
    for (const double z : {-1.35, 1.35}) {
      Shape placed;
      append(placed, wheel, moved({x, 0.33, z}) * turned(-90.0, {0, 0, 1}));
      add(iron, placed);
    }
  }
}

void add_tree(Block& block, const dvec3& foot, std::uint32_t seed, int detail) {
  BroadleafStyle style;
  style.seed = seed, style.height = chance(seed, 1, 6.0, 8.0), style.crown_start = 0.3, style.spread = 2.0;
  style.trunk_radius = 0.13, style.rise = 0.7, style.limbs = 10, style.twigs = 2, style.leaves = detail >= 3 ? 26 : 14;
  style.leaf = 0.32, style.clump = 0.6;
  const Plant plant = broadleaf(style);
  add_shape(block.meshes[timber], plant.wood, foot);
  add_shape(block.meshes[foliage], plant.leaves, foot);
}

}  // namespace

Block pave(const Lot& lot, std::uint32_t seed, int detail) {
  Block block;
  add_shape(block.meshes[paving], bevelled_slab({lot.x0, -0.5, lot.z0}, {lot.x1, kerb, lot.z1}, 0.04), dvec3(0));
  // Zebra crossings over the street in the south.
  for (const double x : {lot.x0 - 3.0, lot.x1 - 1.0}) {
    for (int i = 0; i < 6 && detail >= 1; ++i) {
      const double z = lot.z1 + 1.0 + 1.7 * i;
      add_box(block.meshes[trim], {x, -0.05, z}, {x + 4.0, 0.012, z + 0.8});
    }
  }
  if (detail < 1) return block;
  // Lanes: down the middle of the streets in the west and in the south.
  for (int i = 0; i < 9; ++i) {
    const double z = glm::mix(lot.z0, lot.z1 - 2.0, i / 8.0);
    add_box(block.meshes[trim], {lot.x0 - 6.1, -0.05, z}, {lot.x0 - 5.95, 0.011, z + 2.0});
  }
  const int lamps = 3;
  for (int i = 0; i < lamps; ++i) {
    const double z = glm::mix(lot.z0 + 3.0, lot.z1 - 3.0, static_cast<double>(i) / (lamps - 1));
    add_lamp(block, {lot.x0 + 0.5, kerb, z}, -1.0, detail);
    add_lamp(block, {lot.x1 - 0.5, kerb, z}, 1.0, detail);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double z = glm::mix(lot.z0 + 4.0, lot.z1 - 4.0, (i % 3 + chance(seed, 100 + i, 0.1, 0.7)) / 3.0);
    if (chance(seed, 200 + i) < 0.25) continue;
    add_car(block, {i < 3 ? lot.x0 - 1.2 : lot.x1 + 1.2, 0.0, z}, false, hash(seed, 300 + i), detail);
  }
  for (std::uint32_t i = 0; i < 7; ++i) {
    const double x = glm::mix(lot.x0 + 5.0, lot.x1 - 5.0, (i + chance(seed, 400 + i, 0.1, 0.6)) / 7.0);
    if (chance(seed, 500 + i) < 0.45) continue;
    add_car(block, {x, 0.0, lot.z1 + 1.2}, true, hash(seed, 600 + i), detail);
  }
  for (std::uint32_t i = 0; i < 8 && detail >= 2; ++i) {
    const double z = glm::mix(lot.z0 + 5.5, lot.z1 - 5.5, (i % 4 + 0.5) / 4.0);
    add_tree(block, {i < 4 ? lot.x0 + 0.95 : lot.x1 - 0.95, kerb, z}, hash(seed, 700 + i), detail);
  }
  return block;
}

}  // namespace umbrameter::builtin
