#include "scenes/builtin/room.h"

#include <array>
#include <cmath>

#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

RoomPalette add_room_palette(Scene& scene) {
  const auto paint = [&](const char* name, const vec3& color) { return add_material(scene, name, color); };
  RoomPalette p{};
  p.plaster = paint("plaster", {0.66f, 0.62f, 0.55f});
  p.floor = paint("oak boards", {0.37f, 0.235f, 0.13f});
  p.pale_floor = paint("pale oak boards", {0.42f, 0.275f, 0.155f});
  p.dark_floor = paint("dark oak boards", {0.33f, 0.205f, 0.11f});
  p.trim = paint("white paint", {0.74f, 0.72f, 0.68f});
  p.wood = paint("walnut", {0.22f, 0.125f, 0.07f});
  p.dark_wood = paint("dark walnut", {0.13f, 0.075f, 0.045f});
  p.rug = paint("rug", {0.16f, 0.23f, 0.28f});
  p.rug_border = paint("rug border", {0.52f, 0.44f, 0.32f});
  p.cloth = paint("linen", {0.50f, 0.45f, 0.37f});
  p.clay = paint("terracotta", {0.50f, 0.21f, 0.115f});
  p.steel = paint("blued steel", {0.07f, 0.08f, 0.09f});
  p.brass = paint("brass", {0.56f, 0.40f, 0.16f});
  p.ivory = paint("ivory glaze", {0.70f, 0.65f, 0.55f});
  p.soil = paint("soil", {0.06f, 0.04f, 0.028f});
  p.blue = paint("blue cloth binding", {0.10f, 0.17f, 0.27f});
  p.ochre = paint("ochre cloth binding", {0.55f, 0.37f, 0.12f});
  p.red = paint("red cloth binding", {0.42f, 0.10f, 0.07f});
  p.green = paint("green cloth binding", {0.12f, 0.22f, 0.14f});
  p.leaf = add_sheet_material(scene, "leaf", {0.09f, 0.19f, 0.06f});
  return p;
}

// One solid: six slabs about a hollow, with the window cut through.
void add_shell(Scene& scene, const RoomPalette& palette) {
  constexpr double t = wall_thickness;
  const std::array<Bounds, 1> block{Bounds{dvec3(-t), dvec3(room_width + t, room_height + t, room_depth + t)}};
  const std::array<Bounds, 2> hollows{
      Bounds{dvec3(0.0), dvec3(room_width, room_height, room_depth)},
      Bounds{dvec3(-2.0 * t, sill_height, window_near), dvec3(0.1, lintel_height, window_far)}};
  place_once(scene, to_mesh("shell", carved(block, hollows), palette.plaster));
}

void add_floor(Scene& scene, const RoomPalette& palette) {
  // Boards with open joints on the shell's floor; each row starts elsewhere.
  constexpr double width = 0.175;
  constexpr double length = 1.3;
  const int rows = static_cast<int>(room_depth / width);
  const Shape board = bevelled_slab(dvec3(0.0015, -0.01, 0.0015), dvec3(length - 0.0015, 0.012, width - 0.0015), 0.002);
  const std::array<std::uint32_t, 3> tints{add_mesh(scene, to_mesh("board", board, palette.floor, 20.0)),
                                           add_mesh(scene, to_mesh("pale board", board, palette.pale_floor, 20.0)),
                                           add_mesh(scene, to_mesh("dark board", board, palette.dark_floor, 20.0))};
  for (int row = 0; row < rows; ++row) {
    const double start = -length * chance(31, static_cast<std::uint32_t>(row), 0.1, 0.9);
    for (int column = 0; column < 5; ++column) {
      const double low = std::max(start + length * column, 0.004);
      const double high = std::min(start + length * (column + 1), room_width - 0.004);
      if (high - low < 0.02) continue;
      const std::uint32_t number = hash(32, row, column);
      place(scene, tints[static_cast<std::size_t>(chance(number, 1, 0.0, 2.999))], "board",
            moved(dvec3(low, 0, width * row)) * scaled(dvec3((high - low) / length, 1, 1)));
    }
  }
  Shape skirting;
  constexpr double h = 0.11;
  constexpr double d = 0.018;
  append(skirting, chamfered_box(dvec3(-0.01, -0.01, -0.01), dvec3(room_width + 0.01, h, d), 0.005));
  append(skirting,
         chamfered_box(dvec3(-0.01, -0.01, room_depth - d), dvec3(room_width + 0.01, h, room_depth + 0.01), 0.005));
  append(skirting, chamfered_box(dvec3(-0.01, -0.01, -0.008), dvec3(d, h - 0.0005, room_depth + 0.008), 0.005));
  append(skirting, chamfered_box(dvec3(room_width - d, -0.01, -0.008),
                                 dvec3(room_width + 0.01, h - 0.0005, room_depth + 0.008), 0.005));
  place_once(scene, to_mesh("skirting", skirting, palette.trim, 20.0));
}

void add_window(Scene& scene, const RoomPalette& palette) {
  constexpr double middle = 0.5 * (window_near + window_far);
  constexpr double x = -0.14;  // of the frame's inner face
  constexpr double deep = 0.06;
  Shape frame;
  const auto bar = [&](double y0, double y1, double z0, double z1, double inset) {
    append(frame, chamfered_box(dvec3(x - deep + inset, y0, z0), dvec3(x - inset, y1, z1), 0.004));
  };
  constexpr double rail = 0.055;
  constexpr double glazing = 0.028;
  bar(sill_height - 0.01, sill_height + rail, window_near - 0.01, window_far + 0.01, 0.0);
  bar(lintel_height - rail, lintel_height + 0.01, window_near - 0.01, window_far + 0.01, 0.0);
  bar(sill_height - 0.008, lintel_height + 0.008, window_near - 0.01, window_near + rail, 0.002);
  bar(sill_height - 0.008, lintel_height + 0.008, window_far - rail, window_far + 0.01, 0.002);
  bar(sill_height + 0.01, lintel_height - 0.01, middle - 0.5 * rail, middle + 0.5 * rail, 0.004);
  for (const double share : {1.0 / 3.0, 2.0 / 3.0}) {
    const double y = sill_height + share * (lintel_height - sill_height);
    bar(y - 0.5 * glazing, y + 0.5 * glazing, window_near + 0.01, window_far - 0.01, 0.012);
  }
  for (const double z : {0.5 * (window_near + middle), 0.5 * (window_far + middle)}) {
    bar(sill_height + 0.01, lintel_height - 0.01, z - 0.5 * glazing, z + 0.5 * glazing, 0.014);
  }
  place_once(scene, to_mesh("window frame", frame, palette.trim, 20.0));
  place_once(scene, to_mesh("window board",
                            chamfered_box(dvec3(x - 0.01, sill_height - 0.03, window_near - 0.06),
                                          dvec3(0.07, sill_height + 0.012, window_far + 0.06), 0.008),
                            palette.trim, 20.0));
}

}  // namespace

Scene make_room() {
  Scene scene;
  scene.name = "room";
  const RoomPalette palette = add_room_palette(scene);
  add_shell(scene, palette);
  add_floor(scene, palette);
  add_window(scene, palette);
  add_room_furniture(scene, palette);

  add_camera(scene, "overview", looking(dvec3(4.95, 1.62, 3.95), dvec3(1.7, 0.95, 1.15)), 58.0);
  add_camera(scene, "window", looking(dvec3(3.6, 1.5, 3.7), dvec3(0.2, 1.05, 1.7)), 48.0);
  add_camera(scene, "table", looking(dvec3(4.3, 1.5, 3.1), dvec3(2.7, 0.65, 1.9)), 42.0);
  add_camera(scene, "edges", looking(dvec3(1.95, 1.15, 2.75), dvec3(0.1, 0.22, 4.0)), 44.0);
  // Through the window onto the floor. It crosses the wall at x = 0 in 0.3 m · √(1 + 0.86² + 0.45²) = 0.42 m: a bias
  // below that lets none through.
  add_sun(scene, "sun", dvec3(1.5, 0.8, 2.0), dvec3(-1.0, 0.86, -0.45), 8.0, 3.0);
  add_lamp(scene, "lamp", lamp_position, 2.2);
  add_lamp(scene, "reading-lamp", reading_lamp_position, 0.8);
  return scene;
}

}  // namespace umbrameter::builtin
