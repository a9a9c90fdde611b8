// Cascaded shadow maps of directional lights: views that cover the nearer part of what the camera sees, and the whole
// scene as the last.
#pragma once

#include <vector>

#include "core/gbuffer.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// Far ends of `count` ranges of view depth, metres: halfway between uniform and logarithmic splits, the practical
/// scheme with λ = ½. (F. Zhang, H. Sun, L. Xu and L. K. Lun, Parallel-Split Shadow Maps for Large-Scale Virtual
/// Environments, VRCIA 2006.) nearest and farthest are above 0.
std::vector<double> split_depths(double nearest, double farthest, int count);

/// fit_light() with params.cascades views where the light is directional. Each view but the last is the smallest square
/// about the surfels up to its split, with room for the taps of a kernel. A view that would be no finer than the last
/// is left out.
MapLayout fit_map(const Light& light, const Bounds& bounds, const ShadowMapParams& params, const GBuffer& seen);

}  // namespace umbrameter
