// The courtyard's palette and the two halves of its layout. Internal to scenes/builtin*.
#pragma once

#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {

/// Material indices.
struct Palette {
  std::uint32_t limestone, pale_stone, warm_stone, plaster, ochre, earth, terracotta, dark_terracotta, light_terracotta,
      dark_wood, pale_wood, shutter_green, iron, verdigris, water, soil, bark, agave, candle, orange, cloth, blue_cloth,
      fence, spray, leaf, olive, flower;
};
Palette add_palette(Scene& scene);

/// Height of the arcade's floor and of the terrace in the west, metres above the court.
inline constexpr double arcade_floor = 0.16;
inline constexpr double terrace = 1.36;

void add_paving(Scene& scene, const Palette& palette);
void add_arcade(Scene& scene, const Palette& palette);
void add_tower(Scene& scene, const Palette& palette);
void add_terrace(Scene& scene, const Palette& palette);
void add_fence(Scene& scene, const Palette& palette);
void add_furniture(Scene& scene, const Palette& palette);
void add_plants(Scene& scene, const Palette& palette);
/// Point lights and spot lights in turn, of ranges from 1.5 to 4 m. The first contains the camera "overview", the
/// second the camera "arcade".
void add_small_lights(Scene& scene, std::uint64_t number);

/// Rows of barrel tiles over a deck. In its own frame the deck's top is y = 0, z points down the slope, the eave is
/// z = 0; `length` runs along x, `rise` up the slope.
void add_tiles(Scene& scene, const Palette& palette, const std::string& name, const dmat4& world_from_roof,
               double length, double rise);

}  // namespace umbrameter::builtin
