// What a directional light's map must hold, without looking at the image: the part of the camera's frustum that lies
// within the boxes of objects.
#pragma once

#include <span>

#include "core/bounds.h"
#include "core/gbuffer.h"
#include "scenes/view.h"

namespace umbrameter {

/// Vertices of that part as surfels, with position and view depth; none if the camera sees no box. The frustum has the
/// view depths that the visible boxes have, between nearest and farthest (metres); its part is cut by a box along the
/// light: across it around all boxes, with sides in the plane of the world's x, and from the highest box down to the
/// lowest visible one. (Filament 1.53: ShadowMap.cpp, computeLightFrustumBounds() and intersectFrustumWithBox(), and
/// the depths of ShadowMapManager.cpp's tightly_bound_scene, which sources at 003e500 no longer have.)
GBuffer receiver_volume(const View& view, const dvec3& to_light, std::span<const Bounds> boxes, double nearest,
                        double farthest);

}  // namespace umbrameter
