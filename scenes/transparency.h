// Surfaces that let light through: which triangles they are, and what scene.blend makes of them.
#pragma once

#include "scenes/scene.h"
#include "scenes/scene_params.h"

namespace umbrameter {

/// Whether a material is alpha-blended or transmits light, so that a triangle which blocks all light is not what its
/// file means.
bool is_transparent(const Material& material);

/// Turns transparent materials into what both sides can show, which is triangles with or without holes, and notes what
/// it did to how many triangles (over all instances) of which materials:
/// - opaque: the scene stays as it is;
/// - leave_out: their triangles are removed;
/// - mask: alpha-blended materials become alpha masks with a cutoff of 0.5. A material that transmits more than half of
///   the light is removed, another one stays opaque, since transmission has no alpha to cut holes by.
void apply_blend_mode(Scene& scene, BlendMode mode);

}  // namespace umbrameter
