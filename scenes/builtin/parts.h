// The shapes that the courtyard is put together from, each about its own origin. Internal to scenes/builtin*.
#pragma once

#include "scenes/builtin/shapes.h"

namespace umbrameter::builtin {

// architecture.cpp: measures that parts and layout share, metres.
inline constexpr double bay = 2.8;          ///< from column axis to column axis
inline constexpr double springing = 2.95;   ///< height where the arches begin
inline constexpr double arch_radius = 1.1;  ///< of the wall's opening
inline constexpr double arcade_wall_top = 4.9;
inline constexpr double arcade_wall_depth = 0.5;

/// Plinth, base, shaft with entasis, capital and impost block; from y = 0 to just above the springing.
Shape column();
/// The wall above `bays` arches along +x from the first column's axis; z from 0 to the wall's depth.
Shape arcade_wall(int bays);
/// One stone of an arch ring of `count`, about the arch's centre, at the ring's +x end; z about 0.
Shape voussoir(int count);
Shape keystone();
/// A moulding `length` long along +x, that stands out along +z from z = 0; y from 0 to 0.3.
Shape cornice(double length);
/// A turned baluster, y from 0 to 0.62.
Shape baluster();
/// A barrel tile: along +z, 0.52 long, arched over x.
Shape barrel_tile();
/// A ball on a neck, from y = 0.
Shape finial(double radius);
/// Frame, sill and two louvred shutters of a window of that opening; the wall's face is z = 0, the sill's top y = 0.
Shape window_frame(double width, double height);
Shape shutter(double width, double height);
/// A door of planks in the opening from x = 0 to width, y = 0 to height; its face looks along +z.
Shape plank_door(double width, double height);
/// Posts and lintel about that opening; the wall's face is z = 0.
Shape door_surround(double width, double height);

// furniture.cpp
Shape crate();
Shape barrel_staves();
Shape barrel_hoops();
Shape bench();
Shape stall_table();
Shape awning_poles(double width, double depth);
/// 5 mm of cloth on those poles, sagging, with a scalloped valance in front (+z).
Shape awning_cloth(double width, double depth);
Shape basin();
Shape basin_bowl();
Shape water_disk(double radius, int segments);
Shape lantern_frame();
Shape lantern_light();

// plants.cpp
Shape flower_pot();
Shape urn();
Shape soil(double radius);
Shape tree_trunk();
/// Narrow folded leaves without thickness, spread through an ellipsoid about the origin.
Sheet leaf_cloud(std::uint32_t seed, int leaves, const dvec3& radii, double leaf_length);
/// Cards for leaf_spray(), that rise from the origin to all sides.
Sheet fern(std::uint32_t seed, int cards, double length);
/// Cards for leaf_spray() on a wall that looks along +z.
Sheet ivy(std::uint32_t seed, int cards, double width, double height);
/// Thick pointed blades from the origin.
Shape agave(std::uint32_t seed, int blades, double length);
/// A slim cone of leaf cards about a core, for a cypress.
Sheet cypress_leaves(std::uint32_t seed, double height);

}  // namespace umbrameter::builtin
