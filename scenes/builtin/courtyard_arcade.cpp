#include <array>
#include <cmath>

#include "scenes/builtin/courtyard.h"
#include "scenes/builtin/parts.h"

namespace umbrameter::builtin {
namespace {

constexpr int bays = 5;
constexpr double west = -7.0;
constexpr double axis_z = -5.95;  // of the columns
constexpr double roof_pitch = 23.0;
constexpr double eave_z = -5.32;
constexpr double eave_y = 5.17;

double roof_height(double z) { return eave_y + (eave_z - z) * std::tan(degrees(roof_pitch)); }

// A box from the profile of the roof: from y = low to just under the deck.
Shape gable(double back, double front, double low, double depth) {
  const dvec2 lower[] = {{back, low}, {front, low}};
  const dvec2 upper[] = {{back, roof_height(back) - 0.06}, {front, roof_height(front) - 0.06}};
  Shape shape;
  append(shape, band(lower, upper, depth),
         dmat4(dvec4(0, 0, 1, 0), dvec4(0, 1, 0, 0), dvec4(1, 0, 0, 0), dvec4(0, 0, 0, 1)));
  return shape;
}

void add_walls(Scene& scene, const Palette& palette) {
  place_once(scene, to_mesh("arcade wall", arcade_wall(bays), palette.plaster),
             moved(dvec3(west, arcade_floor, axis_z - 0.5 * arcade_wall_depth)));
  const Bounds wall[] = {{dvec3(-7.3, -0.1, -9.5), dvec3(7.4, 5.0, -9.0)}};
  const Bounds recesses[] = {{dvec3(-3.45, arcade_floor - 0.02, -9.3), dvec3(-2.15, 2.6, -8.0)},
                             {dvec3(2.15, arcade_floor - 0.02, -9.3), dvec3(3.45, 2.6, -8.0)},
                             {dvec3(-0.5, 1.35, -9.3), dvec3(0.5, 2.9, -8.0)},
                             {dvec3(-6.05, 1.35, -9.3), dvec3(-5.05, 2.9, -8.0)},
                             {dvec3(5.05, 1.35, -9.3), dvec3(6.05, 2.9, -8.0)}};
  place_once(scene, to_mesh("back wall", carved(wall, recesses), palette.ochre));
  place_once(scene, to_mesh("east gable", gable(-9.58, -5.62, -0.11, 0.6), palette.plaster), moved(dvec3(6.95, 0, 0)));
  place_once(scene, to_mesh("loft", gable(-9.4, -5.75, 4.93, 14.4), palette.plaster), moved(dvec3(-7.2, 0, 0)));
  place_once(scene, to_mesh("ceiling", box(dvec3(-7.15, 4.78, -9.2), dvec3(7.18, 4.95, -6.0)), palette.pale_wood));
  const std::uint32_t beam = add_mesh(
      scene, to_mesh("beam", chamfered_box(dvec3(-0.08, 4.55, -9.1), dvec3(0.08, 4.8, -6.1), 0.01), palette.dark_wood));
  for (int i = 0; i < 20; ++i) place(scene, beam, "beam", moved(dvec3(-6.65 + 0.7 * i, 0, 0)));
  place_once(scene, to_mesh("cornice", cornice(14.3), palette.pale_stone),
             moved(dvec3(-7.1, 4.82, axis_z + 0.5 * arcade_wall_depth)));
}

void add_arches(Scene& scene, const Palette& palette) {
  const std::uint32_t shaft = add_mesh(scene, to_mesh("column", column(), palette.pale_stone, 32.0));
  for (int i = 0; i <= bays; ++i) place(scene, shaft, "column", moved(dvec3(west + bay * i, arcade_floor, axis_z)));
  constexpr int stones = 15;
  const std::uint32_t tints[] = {add_mesh(scene, to_mesh("voussoir", voussoir(stones), palette.pale_stone, 20.0)),
                                 add_mesh(scene, to_mesh("warm voussoir", voussoir(stones), palette.warm_stone, 20.0))};
  const std::uint32_t key = add_mesh(scene, to_mesh("keystone", keystone(), palette.pale_stone, 20.0));
  for (int i = 0; i < bays; ++i) {
    const dmat4 center = moved(dvec3(west + bay * (i + 0.5), arcade_floor + springing, axis_z));
    for (int j = 0; j < stones; ++j) {
      if (j == stones / 2) continue;
      place(scene, tints[j % 2], "voussoir", center * turned(180.0 * (j + 0.5) / stones, dvec3(0, 0, 1)));
    }
    place(scene, key, "keystone", center);
  }
}

void add_openings(Scene& scene, const Palette& palette) {
  const std::uint32_t door = add_mesh(scene, to_mesh("door", plank_door(1.3, 2.44), palette.dark_wood, 20.0));
  for (const double x : {-3.45, 2.15}) place(scene, door, "door", moved(dvec3(x, arcade_floor, -9.2)));
  const std::uint32_t surround =
      add_mesh(scene, to_mesh("door surround", door_surround(1.3, 2.44), palette.limestone, 20.0));
  for (const double x : {-3.45, 2.15}) place(scene, surround, "door surround", moved(dvec3(x, arcade_floor, -9.0)));
  const std::uint32_t frame =
      add_mesh(scene, to_mesh("arcade window frame", window_frame(1.0, 1.55), palette.limestone, 20.0));
  const std::uint32_t blind = add_mesh(scene, to_mesh("arcade shutter", shutter(0.49, 1.53), palette.shutter_green));
  for (const double x : {-5.55, 0.0, 5.55}) {
    place(scene, frame, "window frame", moved(dvec3(x, 1.35, -9.0)));
    place(scene, blind, "shutter", moved(dvec3(x - 0.495, 1.36, -9.13)));
    place(scene, blind, "shutter", moved(dvec3(x + 0.005, 1.36, -9.13)));
  }
}

}  // namespace

void add_tiles(Scene& scene, const Palette& palette, const std::string& name, const dmat4& world_from_roof,
               double length, double rise) {
  place_once(scene, to_mesh(name + " deck", box(dvec3(0, -0.1, -rise), dvec3(length, 0, 0)), palette.dark_terracotta),
             world_from_roof);
  const std::uint32_t materials[] = {palette.terracotta, palette.dark_terracotta, palette.light_terracotta};
  std::array<std::uint32_t, 3> tints{};
  for (std::size_t i = 0; i < 3; ++i) {
    tints[i] = add_mesh(scene, to_mesh(name + " tile", barrel_tile(), materials[i], 40.0));
  }
  constexpr double step = 0.45;
  const int columns = static_cast<int>(length / 0.255);
  const int rows = static_cast<int>(rise / step);
  const double pitch = length / columns;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto number = static_cast<std::uint32_t>(row * columns + column);
      const dvec3 at{pitch * (column + 0.5) + chance(81, number, -0.004, 0.004), -0.012,
                     0.06 - step * row - 0.52 + chance(82, number, -0.012, 0.012)};
      const double lift = -1.7;
      place(scene, tints[static_cast<std::size_t>(chance(83, number, 0.0, 2.999))], name + " tile",
            world_from_roof * moved(at) * turned(lift, dvec3(1, 0, 0)) * turned(chance(84, number, -0.8, 0.8)));
    }
  }
}

void add_arcade(Scene& scene, const Palette& palette) {
  add_walls(scene, palette);
  add_arches(scene, palette);
  add_openings(scene, palette);
  add_tiles(scene, palette, "arcade", moved(dvec3(-6.94, eave_y, eave_z)) * turned(roof_pitch, dvec3(1, 0, 0)), 14.7,
            4.7);
}

}  // namespace umbrameter::builtin
