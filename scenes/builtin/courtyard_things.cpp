#include <array>
#include <cmath>

#include "scenes/builtin/courtyard.h"
#include "scenes/builtin/parts.h"

namespace umbrameter::builtin {
namespace {

void add_stalls(Scene& scene, const Palette& palette) {
  const std::uint32_t poles = add_mesh(scene, to_mesh("awning poles", awning_poles(2.8, 2.2), palette.dark_wood, 30.0));
  const auto stripes = [](const dvec3& point) {
    return vec2(static_cast<float>(point.x / 0.62), static_cast<float>(point.z));
  };
  const Shape cloth = awning_cloth(2.8, 2.2);
  const std::uint32_t red = add_mesh(scene, to_mesh("red awning", cloth, palette.cloth, 60.0, stripes));
  const std::uint32_t blue = add_mesh(scene, to_mesh("blue awning", cloth, palette.blue_cloth, 60.0, stripes));
  const std::uint32_t table = add_mesh(scene, to_mesh("table", stall_table(), palette.pale_wood, 20.0));
  const std::uint32_t box_mesh = add_mesh(scene, to_mesh("crate", crate(), palette.pale_wood, 20.0));
  const std::uint32_t old_box = add_mesh(scene, to_mesh("old crate", crate(), palette.dark_wood, 20.0));
  const std::uint32_t fruit = add_mesh(scene, to_mesh("orange", sphere(0.045, 8), palette.orange, 60.0));

  const std::uint32_t filling =
      add_mesh(scene, to_mesh("crate filling", box(dvec3(-0.3, 0.02, -0.2), dvec3(0.3, 0.3, 0.2)), palette.orange));

  const auto fill = [&](const dmat4& at, std::uint32_t seed) {
    place(scene, filling, "crate filling", at);
    for (std::uint32_t i = 0; i < 20; ++i) {
      const double x = -0.23 + 0.115 * (i % 5) + chance(seed, 3 * i, -0.012, 0.012);
      const double z = -0.15 + 0.1 * std::floor(i / 5.0) + chance(seed, 3 * i + 1, -0.012, 0.012);
      place(scene, fruit, "orange", at * moved(dvec3(x, 0.325 + chance(seed, 3 * i + 2, 0.0, 0.03), z)));
    }
  };
  const dmat4 first = moved(dvec3(4.95, 0, -1.55)) * turned(-62.0);
  const dmat4 second = moved(dvec3(5.35, 0, 2.1)) * turned(-84.0);
  std::uint32_t seed = 40;
  for (const dmat4& stall : {first, second}) {
    const bool is_first = seed == 40;
    place(scene, poles, "awning poles", stall);
    place(scene, is_first ? red : blue, "awning", stall);
    place(scene, table, "table", stall * moved(dvec3(0, 0, 0.1)));
    for (int i = 0; i < 2; ++i) {
      const dmat4 at = stall * moved(dvec3(-0.55 + 0.95 * i, 0.798, 0.15)) * turned(chance(seed, 900, -6.0, 9.0));
      place(scene, i == 0 ? box_mesh : old_box, "crate", at);
      fill(at, seed++);
    }
    seed += 10;
  }
  // A stack that nobody has squared up; each layer sinks 2 mm into the one below, as wood does.
  struct Stacked {
    double x, level, z, angle;
    bool old;
  };
  for (const Stacked& c : {Stacked{2.5, 0, 3.3, 12, false},
                           {3.28, 0, 3.42, -7, true},
                           {2.85, 1, 3.38, 31, false},
                           {2.1, 0, 4.0, 58, true},
                           {2.9, 0, 4.12, -3, false},
                           {6.0, 0, -4.6, 5, false},
                           {6.0, 1, -4.58, -9, true},
                           {5.2, 0, -4.7, 17, true},
                           {2.82, 2, 3.4, 9, true}}) {
    const dmat4 at = moved(dvec3(c.x, -0.002 + 0.358 * c.level, c.z)) * turned(c.angle);
    place(scene, c.old ? old_box : box_mesh, "crate", at);
    if (c.x == 2.9) fill(at, 77);
  }
  const std::uint32_t staves = add_mesh(scene, to_mesh("barrel", barrel_staves(), palette.dark_wood, 40.0));
  const std::uint32_t hoops = add_mesh(scene, to_mesh("barrel hoops", barrel_hoops(), palette.iron, 40.0));
  for (const dvec3& at : {dvec3(3.95, 0, -4.55), dvec3(3.25, 0, -4.75), dvec3(6.35, 0, 4.55)}) {
    place(scene, staves, "barrel", moved(at));
    place(scene, hoops, "barrel hoops", moved(at));
  }
}

void add_pot(Scene& scene, std::uint32_t pot, std::uint32_t ground, double level, const dmat4& at) {
  place(scene, pot, "pot", at);
  place(scene, ground, "soil", at * moved(dvec3(0, level, 0)));
}

}  // namespace

void add_furniture(Scene& scene, const Palette& palette) {
  add_stalls(scene, palette);
  const dmat4 well = moved(dvec3(-1.2, 0, 0.9));
  place_once(scene, to_mesh("basin", basin(), palette.limestone, 30.0), well);
  place_once(scene, to_mesh("fountain", basin_bowl(), palette.verdigris, 40.0), well);
  place_once(scene, to_mesh("basin water", water_disk(1.25, 8), palette.water, 30.0), well * moved(dvec3(0, 0.44, 0)));
  place_once(scene, to_mesh("bowl water", water_disk(0.6, 32), palette.water, 30.0), well * moved(dvec3(0, 1.25, 0)));
  const std::uint32_t seat = add_mesh(scene, to_mesh("bench", bench(), palette.dark_wood, 20.0));
  place(scene, seat, "bench", moved(dvec3(-6.4, 0, -1.1)) * turned(90.0));
  place(scene, seat, "bench", moved(dvec3(0, arcade_floor, -8.62)));
  place(scene, seat, "bench", moved(dvec3(-10.6, terrace, 0.1)) * turned(90.0));
  const std::uint32_t frame = add_mesh(scene, to_mesh("lantern", lantern_frame(), palette.iron, 40.0));
  const std::uint32_t candle = add_mesh(scene, to_mesh("candle", lantern_light(), palette.candle, 40.0));
  for (const double x : {-5.6, 0.0, 5.6}) {
    place(scene, frame, "lantern", moved(dvec3(x, 3.05, -7.6)));
    place(scene, candle, "candle", moved(dvec3(x, 3.05, -7.6)));
  }
}

void add_plants(Scene& scene, const Palette& palette) {
  const std::uint32_t pot = add_mesh(scene, to_mesh("flower pot", flower_pot(), palette.terracotta, 40.0));
  const std::uint32_t vase = add_mesh(scene, to_mesh("urn", urn(), palette.pale_stone, 40.0));
  const std::uint32_t bed = add_mesh(scene, to_mesh("soil", soil(0.222), palette.soil, 40.0));
  const std::uint32_t bush =
      add_mesh(scene, to_mesh("bush", leaf_cloud(5, 240, dvec3(0.29, 0.27, 0.29), 0.16), palette.leaf));
  const std::uint32_t blooms =
      add_mesh(scene, to_mesh("blooms", leaf_cloud(6, 60, dvec3(0.36, 0.33, 0.36), 0.09), palette.flower));
  const std::uint32_t fronds = add_mesh(scene, to_mesh("fern", fern(7, 26, 0.75), palette.spray));
  const std::uint32_t blades = add_mesh(scene, to_mesh("agave", agave(8, 20, 0.62), palette.agave, 50.0));

  // 0 bush, 1 fern, 2 agave, 3 flowering bush.
  struct Potted {
    dvec3 at;
    double size;
    int plant;
  };
  std::uint32_t number = 0;
  for (const Potted& p : {Potted{{-5.9, 0, 4.75}, 1.1, 2},
                          {{-5.35, 0, 5.3}, 0.8, 3},
                          {{-6.35, 0, -2.75}, 0.95, 3},
                          {{-6.3, 0, 0.0}, 0.8, 1},
                          {{-1.4, arcade_floor, -5.15 - 3.5}, 1.0, 1},
                          {{1.35, arcade_floor, -8.65}, 1.0, 0},
                          {{6.45, 0, -3.2}, 1.1, 3},
                          {{6.5, 0, 0.3}, 1.0, 1},
                          {{-10.5, terrace, 1.05}, 0.9, 0},
                          {{-10.5, terrace, 3.2}, 0.9, 0},
                          {{-10.4, terrace, -4.3}, 1.2, 2},
                          {{-7.9, terrace, -4.5}, 0.9, 3},
                          {{1.4, 0, -5.0}, 0.9, 3},
                          {{-1.4, 0, -5.0}, 0.9, 3},
                          {{-7.65, terrace, 5.45}, 1.0, 2},
                          {{4.2, arcade_floor, -8.6}, 1.1, 2},
                          {{-4.2, arcade_floor, -8.6}, 1.0, 1}}) {
    const dmat4 at = moved(p.at) * turned(57.0 * number++) * scaled(dvec3(p.size));
    add_pot(scene, pot, bed, 0.32, at);
    if (p.plant == 0 || p.plant == 3) place(scene, bush, "bush", at * moved(dvec3(0, 0.58, 0)));
    if (p.plant == 3) place(scene, blooms, "blooms", at * moved(dvec3(0, 0.6, 0)));
    if (p.plant == 1) place(scene, fronds, "fern", at * moved(dvec3(0, 0.33, 0)));
    if (p.plant == 2) place(scene, blades, "agave", at * moved(dvec3(0, 0.34, 0)));
  }
  for (const double z : {0.45, 3.75}) {
    const dmat4 at = moved(dvec3(-4.28, 0.955, z));
    add_pot(scene, vase, bed, 0.55, at);
    place(scene, z < 1.0 ? bush : fronds, "urn plant",
          at * (z < 1.0 ? moved(dvec3(0, 0.78, 0)) : moved(dvec3(0, 0.56, 0))));
    if (z < 1.0) place(scene, blooms, "blooms", at * moved(dvec3(0, 0.8, 0)));
  }

  const dmat4 tree = moved(dvec3(-4.55, 0, -3.55));
  add_pot(scene, pot, bed, 0.32, tree * scaled(dvec3(1.75)));
  place_once(scene, to_mesh("olive trunk", tree_trunk(), palette.bark, 50.0), tree * moved(dvec3(0, 0.58, 0)));
  const std::uint32_t crown =
      add_mesh(scene, to_mesh("olive crown", leaf_cloud(9, 500, dvec3(0.62, 0.48, 0.62), 0.165), palette.olive));
  for (const dvec3& at : {dvec3(0, 2.85, 0), dvec3(0.5, 2.55, 0.25), dvec3(-0.45, 2.5, 0.3), dvec3(0.1, 2.5, -0.5)}) {
    place(scene, crown, "olive crown",
          tree * moved(at) * turned(90.0 * at.x + 40.0 * at.z) * scaled(dvec3(at.y > 2.7 ? 1.0 : 0.8)));
  }
  place_once(scene, to_mesh("ivy", ivy(10, 330, 2.6, 3.3), palette.spray),
             moved(dvec3(-11.05, terrace, -3.9)) * turned(90.0));
  const std::uint32_t wall_ivy = add_mesh(scene, to_mesh("tower ivy", ivy(12, 330, 1.45, 4.6), palette.spray));
  place(scene, wall_ivy, "tower ivy", moved(dvec3(-7.62, terrace, -4.95)));
  const std::uint32_t cypress = add_mesh(scene, to_mesh("cypress", cypress_leaves(13, 5.0), palette.spray));
  const dvec3 stem[] = {{0, -0.1, 0}, {0, 2.0, 0}, {0, 4.6, 0}};
  const double radii[] = {0.1, 0.08, 0.02};
  const std::uint32_t core = add_mesh(scene, to_mesh("cypress stem", tube(stem, radii, 10), palette.bark, 50.0));
  for (const auto& [x, z, size] : {std::array{8.2, -3.9, 1.0}, {8.25, -6.6, 1.2}, {8.15, 0.6, 0.85}}) {
    const dmat4 at = moved(dvec3(x, -0.03, z)) * turned(70.0 * z) * scaled(dvec3(size));
    place(scene, cypress, "cypress", at * moved(dvec3(0, 0.15, 0)));
    place(scene, core, "cypress stem", at);
  }
}

}  // namespace umbrameter::builtin
