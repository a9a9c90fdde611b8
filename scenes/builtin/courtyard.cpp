#include "scenes/builtin/courtyard.h"

#include <cmath>

#include "scenes/builtin/scenes.h"
#include "scenes/builtin/textures.h"

namespace umbrameter::builtin {

Palette add_palette(Scene& scene) {
  const auto paint = [&](const char* name, const vec3& color) { return add_material(scene, name, color); };
  Palette p{};
  p.limestone = paint("limestone", {0.60f, 0.54f, 0.44f});
  p.pale_stone = paint("pale limestone", {0.66f, 0.61f, 0.51f});
  p.warm_stone = paint("warm limestone", {0.56f, 0.48f, 0.36f});
  p.plaster = paint("plaster", {0.66f, 0.55f, 0.40f});
  p.ochre = paint("ochre plaster", {0.60f, 0.40f, 0.21f});
  p.earth = paint("earth", {0.34f, 0.29f, 0.20f});
  p.terracotta = paint("terracotta", {0.44f, 0.17f, 0.085f});
  p.dark_terracotta = paint("dark terracotta", {0.36f, 0.125f, 0.065f});
  p.light_terracotta = paint("light terracotta", {0.50f, 0.23f, 0.13f});
  p.dark_wood = paint("dark wood", {0.115f, 0.062f, 0.034f});
  p.pale_wood = paint("pale wood", {0.36f, 0.235f, 0.125f});
  p.shutter_green = paint("shutter green", {0.075f, 0.165f, 0.125f});
  p.iron = paint("iron", {0.035f, 0.038f, 0.038f});
  p.verdigris = paint("verdigris", {0.17f, 0.36f, 0.30f});
  p.water = paint("water", {0.06f, 0.17f, 0.19f});
  p.soil = paint("soil", {0.06f, 0.04f, 0.028f});
  p.bark = paint("bark", {0.15f, 0.11f, 0.08f});
  p.agave = paint("agave", {0.17f, 0.29f, 0.20f});
  p.candle = paint("candle", {0.80f, 0.74f, 0.60f});
  p.orange = paint("orange", {0.72f, 0.27f, 0.03f});
  p.cloth = add_textured_material(scene, "red and cream cloth", cloth_stripes({168, 58, 44, 255}, {236, 224, 198, 255}),
                                  false);
  p.blue_cloth = add_textured_material(scene, "blue and cream cloth",
                                       cloth_stripes({54, 96, 128, 255}, {236, 226, 204, 255}), false);
  p.fence = add_textured_material(scene, "wrought iron", wrought_iron(), true);
  p.spray = add_textured_material(scene, "leaf spray", leaf_spray(), true);
  p.leaf = add_sheet_material(scene, "leaf", {0.10f, 0.20f, 0.055f});
  p.olive = add_sheet_material(scene, "olive leaf", {0.20f, 0.25f, 0.13f});
  p.flower = add_sheet_material(scene, "flower", {0.55f, 0.06f, 0.11f});
  return p;
}

namespace {

void add_own_lights(Scene& scene) {
  // 40° high, from the south-east: it rakes along the arcade and reaches in between the columns.
  const dvec3 middle(-1.5, 0.0, -1.0);
  const double elevation = degrees(40.0);
  const dvec3 to_sun{0.80 * std::cos(elevation), std::sin(elevation), 0.60 * std::cos(elevation)};
  add_sun(scene, "sun", middle, to_sun, 20.0, 3.0);

  // Between the candle and the crown of the middle lantern.
  Light lantern;
  lantern.name = "lantern";
  lantern.world_from_light = looking(dvec3(0.0, 3.05 + 0.27, -7.6), dvec3(0.0, 3.05 + 0.27, -5.0));
  lantern.color = {1.0f, 0.72f, 0.40f};
  lantern.intensity = 8.0;
  lantern.shape = PointLight{12.0};
  scene.lights.push_back(lantern);

  // On the stairs.
  Light spot;
  spot.name = "spot";
  spot.world_from_light = looking(dvec3(-2.2, 5.2, 5.6), dvec3(-6.0, 0.8, 2.1));
  spot.color = {1.0f, 0.84f, 0.62f};
  spot.intensity = 34.0;
  spot.shape = SpotLight{16.0, degrees(14.0), degrees(24.0)};
  scene.lights.push_back(spot);
}

}  // namespace

Scene make_courtyard(std::uint64_t lights) {
  Scene scene;
  scene.name = "courtyard";
  const Palette palette = add_palette(scene);
  add_paving(scene, palette);
  add_arcade(scene, palette);
  add_tower(scene, palette);
  add_terrace(scene, palette);
  add_fence(scene, palette);
  add_furniture(scene, palette);
  add_plants(scene, palette);

  add_camera(scene, "overview", looking(dvec3(4.4, 4.5, 12.9), dvec3(-1.75, 1.7, -1.8)), 42.0);
  add_camera(scene, "arcade", looking(dvec3(6.2, 1.8, -7.75), dvec3(-4.0, 1.85, -6.95)), 50.0);

  if (lights == 0) {
    add_own_lights(scene);
  } else {
    add_small_lights(scene, lights);
  }
  return scene;
}

}  // namespace umbrameter::builtin
