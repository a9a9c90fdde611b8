#include <array>
#include <cmath>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/room.h"

namespace umbrameter::builtin {
namespace {

constexpr double floor_top = 0.012;
constexpr dvec3 table_foot{2.75, floor_top, 1.95};
constexpr double table_top = 0.74;

Shape table_wood() {
  Shape shape = chamfered_box(dvec3(-0.8, table_top - 0.035, -0.45), dvec3(0.8, table_top, 0.45), 0.008);
  for (const double x : {-0.7, 0.7}) {
    for (const double z : {-0.36, 0.36}) {
      // Legs taper towards the floor.
      append(shape, chamfered({dvec3(x - 0.02, -0.003, z - 0.02), dvec3(x + 0.02, -0.003, z - 0.02),
                               dvec3(x - 0.033, 0.71, z - 0.033), dvec3(x + 0.033, 0.71, z - 0.033),
                               dvec3(x - 0.02, -0.003, z + 0.02), dvec3(x + 0.02, -0.003, z + 0.02),
                               dvec3(x - 0.033, 0.71, z + 0.033), dvec3(x + 0.033, 0.71, z + 0.033)},
                              0.004));
    }
  }
  for (const double z : {-0.36, 0.36}) append(shape, box(dvec3(-0.68, 0.61, z - 0.012), dvec3(0.68, 0.707, z + 0.012)));
  for (const double x : {-0.7, 0.7}) append(shape, box(dvec3(x - 0.012, 0.612, -0.34), dvec3(x + 0.012, 0.708, 0.34)));
  return shape;
}

// Looks along +z; the back is at −z.
Shape chair() {
  Shape shape = chamfered_box(dvec3(-0.21, 0.43, -0.20), dvec3(0.21, 0.462, 0.22), 0.008);
  const auto rod = [&](const dvec3& from, const dvec3& to, double r0, double r1) {
    const std::array<dvec3, 2> path{from, to};
    append(shape, tube(path, std::array{r0, r1}, 12));
  };
  for (const double x : {-1.0, 1.0}) {
    rod({0.20 * x, -0.003, 0.21}, {0.17 * x, 0.44, 0.17}, 0.013, 0.019);
    rod({0.20 * x, -0.003, -0.24}, {0.17 * x, 0.44, -0.16}, 0.013, 0.019);
    rod({0.17 * x, 0.44, -0.17}, {0.185 * x, 0.86, -0.27}, 0.017, 0.013);
  }
  for (const double x : {-0.09, -0.03, 0.03, 0.09}) rod({x, 0.45, -0.175}, {1.12 * x, 0.82, -0.268}, 0.009, 0.008);
  append(shape, chamfered_box(dvec3(-0.225, -0.045, -0.013), dvec3(0.225, 0.045, 0.013), 0.008),
         moved(dvec3(0, 0.845, -0.268)) * turned(-13.0, dvec3(1, 0, 0)));
  for (const double x : {-0.185, 0.185}) rod({x, 0.2, -0.2}, {x, 0.2, 0.19}, 0.009, 0.009);
  rod({-0.19, 0.24, 0.19}, {0.19, 0.24, 0.19}, 0.009, 0.009);
  return shape;
}

void add_lamp_fitting(Scene& scene, const RoomPalette& palette) {
  // A cap well over the light: it shadows a round of the ceiling and leaves the walls lit.
  const double top = room_height - lamp_position.y;
  std::vector<dvec2> profile{{0.0, 0.155}};
  const auto inside = bezier({0.02, 0.155}, {0.05, 0.15}, {0.075, 0.145}, {0.088, 0.135}, 8);
  const auto outside = bezier({0.09, 0.137}, {0.075, 0.175}, {0.03, 0.17}, {0.02, 0.22}, 12);
  profile.insert(profile.end(), inside.begin(), inside.end());
  profile.insert(profile.end(), outside.begin(), outside.end());
  profile.emplace_back(0.0, 0.222);
  const dmat4 at = moved(lamp_position);
  place_once(scene, to_mesh("lamp cap", lathe(profile, 48), palette.clay, 50.0), at);
  Shape cord;
  const std::array<dvec3, 2> path{dvec3(0, 0.02, 0), dvec3(0, top + 0.01, 0)};
  append(cord, tube(path, std::array{0.004, 0.004}, 8));
  const std::array<dvec2, 4> rose{dvec2(0, top - 0.035), dvec2(0.05, top - 0.03), dvec2(0.055, top + 0.005),
                                  dvec2(0, top + 0.005)};
  append(cord, lathe(rose, 24));
  place_once(scene, to_mesh("lamp cord", cord, palette.steel), at);

  // A bracket on the wall behind the viewer, that carries a saucer below its light.
  Shape bracket;
  const double rest = reading_lamp_position.y - 0.09;
  const std::array<dvec2, 6> saucer{dvec2(0, rest - 0.03), dvec2(0.03, rest - 0.028),  dvec2(0.07, rest),
                                    dvec2(0.066, rest),    dvec2(0.028, rest - 0.022), dvec2(0, rest - 0.024)};
  append(bracket, lathe(saucer, 32), moved(dvec3(reading_lamp_position.x, 0, reading_lamp_position.z)));
  const std::array<dvec3, 2> arm{dvec3(reading_lamp_position.x, rest - 0.026, reading_lamp_position.z),
                                 dvec3(reading_lamp_position.x, rest - 0.026, room_depth + 0.01)};
  append(bracket, tube(arm, std::array{0.008, 0.008}, 12));
  place_once(scene, to_mesh("bracket", bracket, palette.brass, 50.0));
}

void add_table(Scene& scene, const RoomPalette& palette) {
  place_once(scene, to_mesh("table", table_wood(), palette.wood, 20.0), moved(table_foot));
  const std::uint32_t seat = add_mesh(scene, to_mesh("chair", chair(), palette.dark_wood, 30.0));
  struct Seat {
    double x, z, angle;
  };
  for (const Seat& s : {Seat{-0.38, -0.62, 6.0}, {0.40, -0.58, -4.0}, {-0.34, 0.66, 176.0}, {0.62, 0.80, 208.0}}) {
    place(scene, seat, "chair", moved(table_foot + dvec3(s.x, 0, s.z)) * turned(s.angle));
  }
  const dmat4 top = moved(table_foot + dvec3(0, table_top, 0));
  // A shallow bowl with fruit, a jug and two cups.
  std::vector<dvec2> dish{{0.0, -0.002}, {0.06, -0.002}};
  for (const auto& part : {bezier({0.065, 0.004}, {0.12, 0.015}, {0.16, 0.04}, {0.175, 0.075}, 8),
                           bezier({0.168, 0.077}, {0.15, 0.045}, {0.11, 0.022}, {0.05, 0.016}, 8)}) {
    dish.insert(dish.end(), part.begin(), part.end());
  }
  dish.emplace_back(0.0, 0.014);
  place_once(scene, to_mesh("dish", lathe(dish, 48), palette.ivory, 40.0), top * moved(dvec3(0.12, 0, 0.02)));
  const std::uint32_t fruit = add_mesh(scene, to_mesh("fruit", sphere(0.036, 24), palette.ochre, 60.0));
  for (const auto& [x, y, z] : {std::array{-0.04, 0.049, -0.02},
                                {0.035, 0.05, -0.035},
                                {0.0, 0.05, 0.045},
                                {0.072, 0.062, 0.03},
                                {0.005, 0.103, 0.0}}) {
    place(scene, fruit, "fruit", top * moved(dvec3(0.12 + x, y, 0.02 + z)));
  }
  std::vector<dvec2> jug{{0.0, -0.002}, {0.05, -0.002}};
  for (const auto& part : {bezier({0.055, 0.0}, {0.10, 0.07}, {0.085, 0.13}, {0.045, 0.18}, 10),
                           bezier({0.04, 0.20}, {0.04, 0.22}, {0.045, 0.23}, {0.055, 0.25}, 5),
                           bezier({0.05, 0.25}, {0.04, 0.23}, {0.035, 0.22}, {0.035, 0.2}, 5)}) {
    jug.insert(jug.end(), part.begin(), part.end());
  }
  jug.emplace_back(0.0, 0.195);
  place_once(scene, to_mesh("jug", lathe(jug, 40), palette.blue, 40.0), top * moved(dvec3(-0.36, 0, -0.10)));
  const std::array<dvec2, 8> cup{dvec2(0, -0.002),    dvec2(0.025, -0.002), dvec2(0.036, 0.03),  dvec2(0.038, 0.075),
                                 dvec2(0.035, 0.075), dvec2(0.033, 0.03),   dvec2(0.022, 0.006), dvec2(0, 0.006)};
  const std::uint32_t cups = add_mesh(scene, to_mesh("cup", lathe(cup, 32), palette.ivory, 40.0));
  for (const auto& [x, z] : {std::pair{-0.45, 0.18}, {-0.12, -0.22}, {0.5, 0.2}}) {
    place(scene, cups, "cup", top * moved(dvec3(x, 0, z)));
  }
}

void add_shelf(Scene& scene, const RoomPalette& palette) {
  // Against the wall at z = 0; open to the front.
  constexpr double width = 1.5;
  constexpr double height = 2.0;
  constexpr double depth = 0.30;
  constexpr int boards = 5;
  const dmat4 at = moved(dvec3(3.35, floor_top, 0.02));
  const std::array<Bounds, 1> block{Bounds{dvec3(0, -0.003, 0), dvec3(width, height, depth)}};
  std::vector<Bounds> holes;
  constexpr double board = 0.022;
  constexpr double pitch = (height - 0.06 - board) / boards;
  for (int row = 0; row < boards; ++row) {
    for (int column = 0; column < 2; ++column) {
      const double low = 0.06 + pitch * row;
      const double left = board + column * 0.5 * (width - board);
      holes.push_back({dvec3(left, low + board * 0.5, 0.015),
                       dvec3(left + 0.5 * (width - board) - board, low + pitch - 0.5 * board, depth + 0.1)});
    }
  }
  place_once(scene, to_mesh("shelf", carved(block, holes), palette.wood), at);

  const Shape volume_shape = chamfered_box(dvec3(0, -0.001, 0), dvec3(1, 1, 1), 0.02);
  const std::array<std::uint32_t, 5> covers{add_mesh(scene, to_mesh("blue book", volume_shape, palette.blue, 20.0)),
                                            add_mesh(scene, to_mesh("ochre book", volume_shape, palette.ochre, 20.0)),
                                            add_mesh(scene, to_mesh("red book", volume_shape, palette.red, 20.0)),
                                            add_mesh(scene, to_mesh("green book", volume_shape, palette.green, 20.0)),
                                            add_mesh(scene, to_mesh("linen book", volume_shape, palette.cloth, 20.0))};
  const std::uint32_t pot = add_mesh(scene, to_mesh("vase", urn(), palette.clay, 40.0));
  const std::uint32_t ball = add_mesh(scene, to_mesh("globe", sphere(0.095, 40), palette.brass, 60.0));
  std::uint32_t number = 0;
  for (std::size_t cell = 0; cell < holes.size(); ++cell) {
    const dvec3 low = holes[cell].min;
    const double right = holes[cell].max.x - 0.01;
    const double free = cell == 5 || cell == 8 ? 0.30 : chance(50, static_cast<std::uint32_t>(cell), 0.03, 0.2);
    double x = low.x + 0.006;
    while (true) {
      const double thick = chance(51, number, 0.018, 0.05);
      if (x + thick > right - free) break;
      const double tall = chance(52, number, 0.2, 0.31);
      const double deep = chance(53, number, 0.15, 0.21);
      place(scene, covers[static_cast<std::size_t>(chance(54, number, 0.0, 4.999))], "book",
            at * moved(dvec3(x, low.y, depth - 0.035 - deep + chance(55, number, 0.0, 0.02))) *
                scaled(dvec3(thick, tall, deep)));
      x += thick + 0.0012;
      ++number;
    }
    if (cell == 5)
      place(scene, pot, "vase", at * moved(dvec3(right - 0.14, low.y - 0.002, 0.16)) * scaled(dvec3(0.42)));
    if (cell == 8) place(scene, ball, "globe", at * moved(dvec3(right - 0.13, low.y + 0.0945, 0.16)));
  }
}

void add_pictures(Scene& scene, const RoomPalette& palette) {
  // On the wall at z = 0, left of the shelf.
  struct Picture {
    const char* name;
    double x, y, half_width, half_height;
    std::uint32_t paint;
  };
  for (const Picture& p : {Picture{"large picture", 1.75, 1.58, 0.42, 0.30, palette.rug},
                           Picture{"small picture", 0.92, 1.62, 0.20, 0.26, palette.ochre},
                           Picture{"low picture", 2.62, 1.62, 0.2, 0.26, palette.clay}}) {
    const dvec3 middle(p.x, p.y, 0.0);
    constexpr double rim = 0.03;
    const std::array<Bounds, 1> whole{Bounds{middle + dvec3(-p.half_width, -p.half_height, -0.005),
                                             middle + dvec3(p.half_width, p.half_height, 0.03)}};
    const std::array<Bounds, 1> inside{Bounds{middle + dvec3(-p.half_width + rim, -p.half_height + rim, 0.012),
                                              middle + dvec3(p.half_width - rim, p.half_height - rim, 0.1)}};
    place_once(scene, to_mesh(std::string(p.name) + " frame", carved(whole, inside), palette.dark_wood));
    place_once(scene, to_mesh(std::string(p.name) + " mount",
                              box(middle + dvec3(-p.half_width + rim - 0.005, -p.half_height + rim - 0.005, 0.008),
                                  middle + dvec3(p.half_width - rim + 0.005, p.half_height - rim + 0.005, 0.014)),
                              palette.ivory));
    place_once(scene, to_mesh(p.name,
                              box(middle + dvec3(-0.62 * p.half_width, -0.6 * p.half_height, 0.01),
                                  middle + dvec3(0.62 * p.half_width, 0.6 * p.half_height, 0.016)),
                              p.paint));
  }
}

void add_plants(Scene& scene, const RoomPalette& palette) {
  const std::uint32_t pot = add_mesh(scene, to_mesh("flower pot", flower_pot(), palette.clay, 40.0));
  const std::uint32_t ground = add_mesh(scene, to_mesh("soil", soil(0.222), palette.soil, 40.0));
  const std::uint32_t crown =
      add_mesh(scene, to_mesh("crown", leaf_cloud(21, 170, dvec3(0.36, 0.42, 0.36), 0.2), palette.leaf));
  const std::uint32_t sprig =
      add_mesh(scene, to_mesh("sprig", leaf_cloud(22, 90, dvec3(0.30, 0.28, 0.30), 0.2), palette.leaf));
  const dmat4 corner = moved(dvec3(0.48, floor_top, 0.46));
  place(scene, pot, "pot", corner * scaled(dvec3(1.05)));
  place(scene, ground, "soil", corner * scaled(dvec3(1.05)) * moved(dvec3(0, 0.32, 0)));
  const std::array<dvec3, 3> stem{dvec3(0, 0.3, 0), dvec3(0.02, 0.7, 0.01), dvec3(0, 1.15, 0)};
  place_once(scene, to_mesh("stem", tube(stem, std::array{0.016, 0.014, 0.008}, 10), palette.wood, 50.0), corner);
  place(scene, crown, "crown", corner * moved(dvec3(0, 1.12, 0)));
  for (const double z : {1.42, 2.60}) {
    const dmat4 at = moved(dvec3(-0.035, sill_height + 0.012, z)) * scaled(dvec3(0.34));
    place(scene, pot, "pot", at);
    place(scene, ground, "soil", at * moved(dvec3(0, 0.32, 0)));
    place(scene, sprig, "sprig", at * moved(dvec3(0, 0.56, 0)) * turned(50.0 * z));
  }
}

}  // namespace

void add_room_furniture(Scene& scene, const RoomPalette& palette) {
  Shape border = bevelled_slab(dvec3(1.35, floor_top - 0.003, 0.85), dvec3(4.15, floor_top + 0.008, 3.05), 0.004);
  place_once(scene, to_mesh("rug border", border, palette.rug_border, 20.0));
  place_once(
      scene,
      to_mesh("rug", bevelled_slab(dvec3(1.47, floor_top + 0.002, 0.97), dvec3(4.03, floor_top + 0.011, 2.93), 0.003),
              palette.rug, 20.0));
  add_table(scene, palette);
  add_lamp_fitting(scene, palette);
  add_shelf(scene, palette);
  add_pictures(scene, palette);
  add_plants(scene, palette);
}

}  // namespace umbrameter::builtin
