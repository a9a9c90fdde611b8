#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// One block with its top at y = 0. The slots run along z, are open at the front and end in a wall at the back.
constexpr std::array<double, 4> widths{0.02, 0.05, 0.1, 0.2};
constexpr std::array<double, 3> depths_per_width{1.0, 2.0, 4.0};
constexpr double half_length = 3.0;
constexpr double end_wall = 0.25;
constexpr double height = 1.0;
constexpr double between_slots = 0.14;
constexpr double between_groups = 0.30;
constexpr double margin = 0.24;

struct Slot {
  double x;  // of the middle
  double width, depth;
};

std::vector<Slot> lay_out() {
  std::vector<Slot> slots;
  double x = 0.0;
  for (const double ratio : depths_per_width) {
    if (!slots.empty()) x += between_groups;
    for (const double width : widths) {
      if (width != widths.front()) x += between_slots;
      slots.push_back({x + 0.5 * width, width, ratio * width});
      x += width;
    }
  }
  for (Slot& slot : slots) slot.x -= 0.5 * x;
  return slots;
}

std::string in_centimetres(double metres) { return std::to_string(std::lround(100.0 * metres)) + " cm"; }

void add_block(Scene& scene, const std::vector<Slot>& slots) {
  const std::uint32_t stone = add_material(scene, "limestone", vec3(0.62f, 0.57f, 0.48f));
  const std::uint32_t clay = add_material(scene, "terracotta", vec3(0.52f, 0.21f, 0.11f));
  const double half_width = slots.back().x + 0.5 * slots.back().width + margin;
  const std::array<Bounds, 1> block{
      Bounds{dvec3(-half_width, -height, -half_length - end_wall), dvec3(half_width, 0.0, half_length)}};
  // A strip of tile is each slot's floor. Its sides and underside lie in the stone, so that no two faces coincide.
  constexpr double tile = 0.012;
  std::vector<Bounds> holes;
  for (const Slot& slot : slots) {
    const dvec3 low{slot.x - 0.5 * slot.width, -slot.depth - 0.5 * tile, -half_length};
    holes.push_back({low, dvec3(slot.x + 0.5 * slot.width, 0.1, half_length + 0.1)});
    place_once(scene, to_mesh("floor " + in_centimetres(slot.width) + " wide " + in_centimetres(slot.depth) + " deep",
                              box(low + dvec3(-0.01, -0.5 * tile, -0.01),
                                  dvec3(slot.x + 0.5 * slot.width + 0.01, -slot.depth, half_length + 0.006)),
                              clay));
  }
  place_once(scene, to_mesh("block", carved(block, holes), stone));
}

// A rail across all slots: its shadow steps aside wherever the ground falls away.
void add_rail(Scene& scene, double half_width) {
  const std::uint32_t steel = add_material(scene, "blued steel", vec3(0.07f, 0.085f, 0.10f));
  constexpr double z = 1.85;
  constexpr double y = 0.32;
  const std::array<dvec3, 2> along{dvec3(-half_width, y, z), dvec3(half_width, y, z)};
  Shape rail = tube(along, std::array{0.018, 0.018}, 24);
  for (const double x : {-half_width + 0.09, half_width - 0.09}) {
    const std::array<dvec3, 2> stand{dvec3(x, -0.01, z), dvec3(x, y + 0.004, z)};
    append(rail, tube(stand, std::array{0.014, 0.014}, 24));
    const std::array<dvec2, 4> foot{dvec2(0, -0.006), dvec2(0.045, -0.006), dvec2(0.045, 0.012), dvec2(0, 0.012)};
    append(rail, lathe(foot, 24), moved(dvec3(x, 0, z)));
  }
  place_once(scene, to_mesh("rail", rail, steel));
}

}  // namespace

Scene make_trench() {
  Scene scene;
  scene.name = "trench";
  const std::vector<Slot> slots = lay_out();
  add_block(scene, slots);
  add_rail(scene, slots.back().x + 0.5 * slots.back().width + 0.16);
  const std::uint32_t slate = add_material(scene, "slate", vec3(0.23f, 0.23f, 0.22f));
  place_once(scene, to_mesh("ground", box(dvec3(-5.5, -height - 0.3, -6.5), dvec3(5.5, -height + 0.01, 6.0)), slate));

  add_camera(scene, "overview", looking(dvec3(-1.85, 2.1, 5.5), dvec3(0.0, -0.42, 1.7)), 40.0);
  const Slot& deepest = slots.back();
  add_camera(scene, "along", looking(dvec3(deepest.x - 0.1, 0.75, 3.9), dvec3(deepest.x - 0.2, -0.35, 2.2)), 40.0);
  // Sees every floor squarely.
  Camera above;
  above.name = "above";
  above.world_from_camera = looking(dvec3(0.0, 2.0, 0.2), dvec3(0.0, 0.0, 0.2), dvec3(0, 0, -1));
  above.projection = OrthographicProjection{1.78, 1.0, 0.1, 10.0};
  scene.cameras.push_back(above);
  // Across the slots it falls 1.6 m on 1 m: it reaches three eighths of the floors as deep as wide, and none of the
  // others.
  add_sun(scene, "sun", dvec3(0.0), dvec3(-1.0, 1.6, 0.55), 8.0, 3.0);
  // Down into the widest slots, lengthwise.
  add_spot(scene, "spot", looking(dvec3(deepest.x, 1.6, 3.4), dvec3(deepest.x, -0.4, 1.0)), 8.0, 12.0, 3.0);
  return scene;
}

}  // namespace umbrameter::builtin
