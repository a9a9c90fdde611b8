#include <array>
#include <cmath>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"
#include "scenes/builtin/textures.h"

namespace umbrameter::builtin {
namespace {

// Cards that lie about flat, thinly spread over a rectangle: vine on a pergola's rafters.
Sheet vine_roof(std::uint32_t seed, int cards, double width, double depth) {
  Sheet sheet;
  for (int i = 0; i < cards; ++i) {
    const std::uint32_t index = hash(seed, i);
    const dvec3 center{chance(index, 0, 0.0, width), chance(index, 1, -0.06, 0.22), chance(index, 2, 0.0, depth)};
    const double turn = chance(index, 3, 0.0, 2.0 * pi), size = chance(index, 4, 0.13, 0.24);
    const dvec3 up = glm::normalize(dvec3(std::cos(turn), chance(index, 5, -0.5, 0.4), std::sin(turn)));
    const dvec3 right = glm::normalize(glm::cross(up, dvec3(chance(index, 6, -0.5, 0.5), 1.0, 0.2)));
    add_card(sheet, center, size * right, size * up);
  }
  return sheet;
}

// Upright cards on the faces of a box and within.
Sheet hedge(std::uint32_t seed, int cards, const dvec3& size) {
  Sheet sheet;
  for (int i = 0; i < cards; ++i) {
    const std::uint32_t index = hash(seed, i);
    const dvec3 center{chance(index, 0, 0.0, size.x), size.y * std::sqrt(chance(index, 1, 0.02, 1.0)),
                       chance(index, 2, 0.0, size.z)};
    const double turn = chance(index, 3, 0.0, 2.0 * pi), reach = chance(index, 4, 0.1, 0.15);
    const dvec3 up = glm::normalize(dvec3(0.6 * std::cos(turn), 1.0, 0.6 * std::sin(turn)));
    const dvec3 right = glm::normalize(glm::cross(up, dvec3(std::cos(2.3 * turn), 0.2, std::sin(2.3 * turn))));
    add_card(sheet, center, reach * right, reach * up);
  }
  return sheet;
}

Shape pergola(double width, double depth, double height) {
  Shape shape;
  for (const double x : {0.0, 0.5 * width, width}) {
    append(shape, chamfered_box({x - 0.06, -0.05, depth - 0.06}, {x + 0.06, height, depth + 0.06}, 0.012));
  }
  append(shape,
         chamfered_box({-0.35, height - 0.02, depth - 0.045}, {width + 0.35, height + 0.15, depth + 0.045}, 0.01));
  append(shape, chamfered_box({-0.35, height - 0.021, -0.04}, {width + 0.35, height + 0.149, 0.05}, 0.01));
  const int rafters = 8;
  for (int i = 0; i < rafters; ++i) {
    const double x = width * i / (rafters - 1);
    append(shape, chamfered_box({x - 0.03, height + 0.11, -0.06}, {x + 0.03, height + 0.24, depth + 0.4}, 0.008));
  }
  return shape;
}

}  // namespace

Scene make_foliage() {
  Scene scene;
  scene.name = "foliage";
  const std::uint32_t plaster = add_material(scene, "plaster", {0.66f, 0.58f, 0.47f});
  const std::uint32_t coping = add_material(scene, "pale limestone", {0.66f, 0.61f, 0.51f});
  const std::uint32_t ground = add_material(scene, "sand", {0.58f, 0.50f, 0.38f});
  const std::uint32_t wood = add_material(scene, "wood", {0.20f, 0.125f, 0.07f});
  const std::uint32_t bark = add_material(scene, "bark", {0.15f, 0.11f, 0.08f});
  const std::uint32_t clay = add_material(scene, "terracotta", {0.44f, 0.17f, 0.085f});
  const std::uint32_t earth = add_material(scene, "soil", {0.06f, 0.04f, 0.028f});
  const std::uint32_t spray = add_textured_material(scene, "leaf spray", leaf_spray(), true);

  place_once(scene, to_mesh("ground", chamfered_box({-7, -0.4, -0.6}, {7, 0, 8}, 0.02), ground));
  place_once(scene, to_mesh("wall", box({-6.5, -0.2, -0.4}, {6.5, 3.3, 0.0}), plaster));
  place_once(scene, to_mesh("coping", chamfered_box({-6.6, 3.28, -0.5}, {6.6, 3.42, 0.1}, 0.03), coping));

  const dvec3 corner{0.0, 0.0, 0.07};
  place_once(scene, to_mesh("pergola", pergola(3.6, 2.1, 2.45), wood), moved(corner));
  place_once(scene, to_mesh("vine", vine_roof(211, 330, 3.9, 2.6), spray), moved(corner + dvec3(-0.15, 2.72, -0.05)));
  const std::array<dvec3, 5> stem{dvec3(3.72, -0.1, 2.25), dvec3(3.74, 0.8, 2.27), dvec3(3.66, 1.6, 2.16),
                                  dvec3(3.7, 2.4, 2.2), dvec3(3.3, 2.75, 1.8)};
  const std::array<double, 5> radii{0.045, 0.04, 0.034, 0.03, 0.02};
  place_once(scene, to_mesh("vine stem", tube(stem, radii, 9), bark, 60.0));

  place_once(scene, to_mesh("ivy", ivy(241, 210, 1.9, 3.1), spray), moved({-3.9, 0.05, 0.02}));
  place_once(scene, to_mesh("hedge", hedge(227, 430, {1.9, 0.72, 0.5}), spray), moved({-2.35, 0.0, 1.1}));
  const std::uint32_t pot = add_mesh(scene, to_mesh("pot", flower_pot(), clay));
  const std::uint32_t filling = add_mesh(scene, to_mesh("soil", soil(0.215), earth));
  const std::uint32_t plant = add_mesh(scene, to_mesh("fern", fern(229, 20, 0.85), spray));
  const std::uint32_t small = add_mesh(scene, to_mesh("small fern", fern(233, 13, 0.5), spray));
  for (const auto& [x, z, size, turn] :
       {std::array{0.55, 0.75, 1.25, 0.0}, std::array{3.0, 0.7, 1.0, 80.0}, std::array{-4.3, 1.7, 1.15, 200.0}}) {
    const dmat4 stand = moved({x, 0.0, z}) * turned(turn) * scaled(dvec3(size));
    place(scene, pot, "pot", stand);
    place(scene, filling, "soil", stand * moved({0.0, 0.33, 0.0}));
    place(scene, plant, "fern", stand * moved({0.0, 0.34, 0.0}));
  }
  for (const auto& [x, z, turn] : {std::array{-1.0, 2.2, 20.0}, std::array{-0.1, 2.7, 140.0},
                                   std::array{-2.9, 2.4, 260.0}, std::array{4.6, 1.0, 300.0}}) {
    place(scene, small, "small fern", moved({x, 0.0, z}) * turned(turn));
  }
  // A sapling whose crown is cards too.
  place_once(scene, to_mesh("sapling", tree_trunk(), bark, 60.0), moved({-0.75, 0.0, 0.95}));
  Sheet crown;
  for (std::uint32_t i = 0; i < 150; ++i) {
    const std::uint32_t index = hash(239, i);
    const double y = chance(index, 0, -1.0, 1.0), angle = chance(index, 1, 0.0, 2.0 * pi);
    const double out = std::sqrt(1.0 - y * y) * std::cbrt(chance(index, 2, 0.15, 1.0));
    const dvec3 way = glm::normalize(dvec3(out * std::cos(angle), y + 0.5, out * std::sin(angle)));
    const dvec3 right = glm::normalize(glm::cross(way, dvec3(0.3, chance(index, 3, 0.2, 1.0), -0.4)));
    add_card(crown, dvec3(0.75, 0.7, 0.75) * dvec3(out * std::cos(angle), y, out * std::sin(angle)),
             chance(index, 4, 0.13, 0.2) * right, 0.19 * way);
  }
  place_once(scene, to_mesh("crown", crown, spray), moved({-0.72, 2.15, 0.97}));

  add_camera(scene, "garden wall", looking(dvec3(-1.5, 1.9, 7.6), dvec3(0.1, 1.4, 0.4)), 44.0);
  add_camera(scene, "under the vine", looking(dvec3(4.9, 1.5, 4.4), dvec3(1.4, 1.05, 0.5)), 46.0);
  add_camera(scene, "ivy", looking(dvec3(-2.6, 1.6, 3.1), dvec3(-4.0, 1.35, 0.0)), 40.0);
  const double elevation = degrees(47.0);
  const dvec3 to_sun{0.62 * std::cos(elevation), std::sin(elevation), 0.78 * std::cos(elevation)};
  add_sun(scene, "sun", dvec3(0, 0, 1.5), to_sun, 15.0, 3.0);
  const std::array<dvec2, 7> bollard{dvec2(0, -0.05), {0.06, -0.05}, {0.05, 0.3}, {0.05, 0.42},
                                     {0.07, 0.44},    {0.06, 0.47},  {0, 0.47}};
  const dvec3 foot{1.35, 0.0, 3.35};
  place_once(scene, to_mesh("bollard", lathe(bollard, 16), coping, 40.0), moved(foot));
  Light lamp;
  lamp.name = "garden lamp";
  lamp.world_from_light = looking(foot + dvec3(0, 0.62, 0), foot + dvec3(0, 0.62, -1));
  lamp.color = {1.0f, 0.76f, 0.46f};
  lamp.intensity = 1.7;
  lamp.shape = PointLight{12.0};
  scene.lights.push_back(lamp);
  return scene;
}

}  // namespace umbrameter::builtin
