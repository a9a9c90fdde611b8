// Cascaded shadow maps for directional lights. Each cascade covers what the camera sees up to a view depth; the last
// covers the whole scene.
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

/// Like fit_light(), but with params.cascades views if the light is directional. Each view except the last is the
/// smallest square around the surfels up to its split, plus a margin for the taps of a kernel. A view that would be no
/// finer than the last is omitted.
MapLayout fit_map(const Light& light, const Bounds& bounds, const ShadowMapParams& params, const GBuffer& seen);

}  // namespace umbrameter
