// One function per built-in scene. Internal to scenes/builtin*.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter::builtin {

Scene make_tilted_plane();
Scene make_contact_box();
Scene make_thin_leaf();
Scene make_corner();
Scene make_trench();
Scene make_spheres();
Scene make_ramp();
Scene make_long_posts();
Scene make_two_occluders();
// Files of assets/.
Scene make_room();
Scene make_fence();
Scene make_foliage();
/// With its own lights, or with that many small ones in their place where the number is not 0.
Scene make_courtyard(std::uint64_t lights);
/// Point lights and spot lights in turn, of ranges from 1.5 to 4 m. The first contains the courtyard's camera
/// "overview", the second its camera "arcade".
std::vector<Light> small_lights(std::uint64_t number);

/// About `triangles` triangles, over all instances.
Scene make_city(std::uint64_t triangles);
Scene make_forest(std::uint64_t triangles);

}  // namespace umbrameter::builtin
