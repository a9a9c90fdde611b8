// The room's measures, and its two halves. Internal to scenes/builtin*.
#pragma once

#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {

/// The interior runs from x = 0 to `room_width`, y = 0 to `room_height`, z = 0 to `room_depth`; metres.
inline constexpr double room_width = 5.2;
inline constexpr double room_height = 2.8;
inline constexpr double room_depth = 4.2;
inline constexpr double wall_thickness = 0.3;

/// The one opening, in the wall at x = 0.
inline constexpr double sill_height = 0.85;
inline constexpr double lintel_height = 2.35;
inline constexpr double window_near = 1.1;  ///< z of its sides
inline constexpr double window_far = 2.9;

/// Where the lamp shines, under its shade.
inline constexpr dvec3 lamp_position{2.75, 1.82, 1.95};
/// Over a bracket on the wall behind the first camera.
inline constexpr dvec3 reading_lamp_position{4.5, 2.0, 4.06};

struct RoomPalette {
  std::uint32_t plaster, floor, pale_floor, dark_floor, trim, wood, dark_wood, rug, rug_border, cloth, clay, steel,
      brass, ivory, leaf, soil, blue, ochre, red, green;
};

void add_room_furniture(Scene& scene, const RoomPalette& palette);

}  // namespace umbrameter::builtin
