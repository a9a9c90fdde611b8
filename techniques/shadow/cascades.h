// Fits the views of a light's map: the area of each, and the split into cascades.
#pragma once

#include <utility>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/view.h"
#include "techniques/shadow/map_fit.h"

namespace umbrameter {

/// Far ends of `count` ranges of view depth, metres. lambda mixes logarithmic (1) and uniform (0) splits: the practical
/// split scheme. (F. Zhang, H. Sun, L. Xu and L. K. Lun, Parallel-Split Shadow Maps for Large-Scale Virtual
/// Environments, VRCIA 2006.) nearest and farthest are above 0.
std::vector<double> split_depths(double nearest, double farthest, int count, double lambda = 0.5);

/// What a map is fitted to: its area to the scene. The ground, a flat box or an empty one, only extends the range of
/// depths: light that passes the scene casts no shadow on it. CascadeFit::boxes takes the boxes, the ground's included;
/// without them, the scene and the ground are its boxes.
struct MappedBounds {
  Bounds scene;
  Bounds ground;
  std::vector<Bounds> boxes;
  MappedBounds(const Bounds& scene_bounds, const Bounds& ground_bounds = {}, std::vector<Bounds> object_boxes = {})
      : scene(scene_bounds), ground(ground_bounds), boxes(std::move(object_boxes)) {
    if (boxes.empty()) boxes = {scene, ground};
  }
  Bounds all() const {
    Bounds both = scene;
    both.include(ground);
    return both;
  }
};

/// What the camera sees. Without a view (width 0) there is no frustum to fit to; then use SplitRange::seen and
/// CascadeFit::tight.
struct SeenPart {
  const GBuffer& surfels;
  View view{};
};

/// Like fit_light(), but a directional light's map is fitted by `fit` and has params.cascades views. A cascade except
/// the last has a margin for the taps of a kernel.
///
/// CascadeSelection::map: a cascade covers everything nearer than its far split, and is omitted if it would be no finer
/// than the last. CascadeSelection::depth: it covers its own range of depths and the zone that is blended into it; one
/// that would be no finer than the last covers the area of the last. Positions beyond shadow.max-distance are outside a
/// map that has MapFit::view and SplitRange::camera.
///
/// With pancaking, depth starts near_offset before the nearest surfel, but not before the scene. Casters in front of it
/// are stored at depth 0. They keep shadowing a surfel while the bias is less than its depth.
/// Throws Error (usage) if the range of the splits is empty, and what parse_splits() throws.
MapLayout fit_map(const Light& light, const MappedBounds& bounds, const ShadowMapParams& params, const SeenPart& seen,
                  const MapFitParams& fit = {});

}  // namespace umbrameter
