// How a scene is read: the unit of its lengths, what becomes of its transparent surfaces, and what is added to it.
#pragma once

#include <string>

#include "core/parameters.h"

namespace umbrameter {

/// What becomes of triangles whose material is alpha-blended or transmits light.
enum class BlendMode : int { opaque, leave_out, mask };

/// The scene.* parameters.
struct SceneParams {
  std::string unit = "m";  ///< of every length in the scene; metres_per_unit() reads it
  BlendMode blend = BlendMode::opaque;
  bool ground = false;  ///< add_ground()
};
Parameters describe(SceneParams& params);

/// Length in metres of a unit: mm, cm, m, km, inch, foot, or a number of metres from 1e-12 to 1e12.
/// Throws Error (usage) for anything else.
double metres_per_unit(const std::string& unit);

}  // namespace umbrameter
