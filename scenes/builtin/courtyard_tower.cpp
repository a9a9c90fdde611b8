#include <cmath>

#include "scenes/builtin/courtyard.h"
#include "scenes/builtin/parts.h"

namespace umbrameter::builtin {
namespace {

constexpr double left = -11.3;
constexpr double right = -6.95;
constexpr double back = -9.6;
constexpr double front = -4.95;
constexpr double wall_top = 7.0;
constexpr double pitch = 29.0;

// Turns +z into +x.
dmat4 eastwards(const dvec3& at) { return moved(at) * turned(90.0); }

void add_tower_roof(Scene& scene, const Palette& palette) {
  const double middle = 0.5 * (left + right);
  const double peak = wall_top + std::tan(degrees(pitch)) * (right - middle);
  const dvec2 lower[] = {{left + 0.01, wall_top - 0.04}, {middle, wall_top - 0.04}, {right - 0.01, wall_top - 0.04}};
  const dvec2 upper[] = {{left + 0.01, wall_top}, {middle, peak}, {right - 0.01, wall_top}};
  place_once(scene, to_mesh("tower gable", band(lower, upper, front - back - 0.02), palette.plaster),
             moved(dvec3(0, 0, back + 0.01)));
  const double c = std::cos(degrees(pitch));
  const double s = std::sin(degrees(pitch));
  const double overhang = 0.36;
  const double slope = (right - middle) / c + overhang;
  const double length = front - back + 0.5;
  const double eave = wall_top - overhang * s + 0.06;
  const dmat4 east{dvec4(0, 0, -1, 0), dvec4(s, c, 0, 0), dvec4(c, -s, 0, 0),
                   dvec4(right + overhang * c, eave, front + 0.28, 1)};
  add_tiles(scene, palette, "tower", east, length, slope);
  const dmat4 west{dvec4(0, 0, 1, 0), dvec4(-s, c, 0, 0), dvec4(-c, -s, 0, 0),
                   dvec4(left - overhang * c, eave, front + 0.281 - length, 1)};
  place_once(scene, to_mesh("tower west deck", box(dvec3(0, -0.1, -slope), dvec3(length, 0, 0)), palette.terracotta),
             west);
  const std::uint32_t ridge = add_mesh(scene, to_mesh("ridge tile", barrel_tile(), palette.dark_terracotta, 40.0));
  for (int i = 0; i < 11; ++i) {
    place(scene, ridge, "ridge tile",
          moved(dvec3(middle, peak + 0.03, front + 0.29 - 0.46 * i)) * turned(178.5, dvec3(0, 1, 0)) *
              turned(1.5, dvec3(1, 0, 0)) * scaled(dvec3(1.7, 1.5, 1.0)));
  }
}

}  // namespace

void add_tower(Scene& scene, const Palette& palette) {
  const Bounds body[] = {{dvec3(left, -0.12, back), dvec3(right, wall_top, front)}};
  const Bounds recesses[] = {{dvec3(-9.65, terrace - 0.02, front - 0.3), dvec3(-8.35, 3.8, 0.0)},
                             {dvec3(-9.5, 4.75, front - 0.3), dvec3(-8.5, 6.15, 0.0)}};
  place_once(scene, to_mesh("tower", carved(body, recesses), palette.plaster));
  add_tower_roof(scene, palette);
  place_once(scene, to_mesh("tower cornice", cornice(right - left + 0.22), palette.pale_stone),
             moved(dvec3(left + 0.02, 6.62, front)));
  place_once(scene, to_mesh("tower side cornice", cornice(front - back - 0.01), palette.pale_stone),
             eastwards(dvec3(right, 6.615, front + 0.005)));

  const Bounds wall[] = {{dvec3(-11.55, -0.13, -5.1), dvec3(-11.05, 5.0, 6.5)}};
  const Bounds openings[] = {{dvec3(-11.35, terrace - 0.02, 1.45), dvec3(-10.0, 3.8, 2.75)},
                             {dvec3(-11.35, 2.4, -2.3), dvec3(-10.0, 3.8, -1.3)},
                             {dvec3(-11.35, 2.4, 4.4), dvec3(-10.0, 3.8, 5.4)}};
  place_once(scene, to_mesh("west wall", carved(wall, openings), palette.ochre));
  place_once(scene, to_mesh("west cornice", cornice(11.57), palette.pale_stone), eastwards(dvec3(-11.05, 4.72, 6.485)));
  place_once(scene, to_mesh("west wall cap", chamfered_box(dvec3(-11.62, 4.98, -5.0), dvec3(-10.84, 5.1, 6.6), 0.02),
                            palette.limestone, 20.0));

  const std::uint32_t door =
      add_mesh(scene, to_mesh("terrace door", plank_door(1.3, 2.44), palette.shutter_green, 20.0));
  place(scene, door, "tower door", moved(dvec3(-9.65, terrace, front - 0.2)));
  place(scene, door, "west door", eastwards(dvec3(-11.25, terrace, 2.75)));
  const std::uint32_t surround =
      add_mesh(scene, to_mesh("terrace door surround", door_surround(1.3, 2.44), palette.pale_stone, 20.0));
  place(scene, surround, "tower door surround", moved(dvec3(-9.65, terrace, front)));
  place(scene, surround, "west door surround", eastwards(dvec3(-11.05, terrace, 2.75)));

  const std::uint32_t frame =
      add_mesh(scene, to_mesh("window frame", window_frame(1.0, 1.4), palette.pale_stone, 20.0));
  const std::uint32_t pane =
      add_mesh(scene, to_mesh("dark pane", box(dvec3(-0.52, -0.02, -0.02), dvec3(0.52, 1.42, 0.02)), palette.iron));
  Shape bars;
  append(bars, box(dvec3(-0.025, -0.01, -0.01), dvec3(0.025, 1.41, 0.05)));
  for (const double y : {0.45, 0.93}) append(bars, box(dvec3(-0.51, y, -0.009), dvec3(0.51, y + 0.035, 0.045)));
  const std::uint32_t cross = add_mesh(scene, to_mesh("glazing bars", bars, palette.pale_wood));
  const std::uint32_t blind = add_mesh(scene, to_mesh("shutter", shutter(0.5, 1.38), palette.shutter_green));
  for (const dmat4& at :
       {moved(dvec3(-9.0, 4.75, front)), eastwards(dvec3(-11.05, 2.4, -1.8)), eastwards(dvec3(-11.05, 2.4, 4.9))}) {
    place(scene, frame, "window frame", at);
    place(scene, pane, "window pane", at * moved(dvec3(0, 0, -0.2)));
    place(scene, cross, "glazing bars", at * moved(dvec3(0, 0, -0.18)));
    // Open, a little off the wall.
    place(scene, blind, "shutter", at * moved(dvec3(-0.64, 0.01, 0.055)) * turned(-172.0) * moved(dvec3(0, 0, -0.045)));
    place(scene, blind, "shutter", at * moved(dvec3(0.64, 0.01, 0.055)) * turned(-14.0));
  }
}

}  // namespace umbrameter::builtin
