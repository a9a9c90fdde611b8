// How the views of a directional light's map are fitted: the area of each, and the split into cascades. The number of
// views and their resolution are in ShadowMapParams.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/view.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// The range of view depths that the cascades divide. seen: from the nearest to the farthest surfel. camera: from the
/// near plane to MapFitParams::max_distance, or to the far plane if that is nearer.
enum class SplitRange : int { seen, camera };

/// The area of a single map or of the last cascade. scene: the scene's bounds. view: what the camera sees in the range
/// of the splits. bounds: a given square.
enum class MapFit : int { scene, view, bounds };

/// The area of the other cascades, and of MapFit::view. tight: the smallest square around the surfels. stable: around
/// the bounding sphere of that part of the camera's frustum, moved in whole texels. If the range of the splits is
/// SplitRange::camera, a stable area has the same size wherever the camera is and looks.
enum class CascadeFit : int { tight, stable };

/// lispsm: a single map that is fitted to the view is warped by warp_map().
enum class Warp : int { none, lispsm };

/// The shadow.* parameters of how a directional light's map is fitted. Other lights ignore them.
struct MapFitParams {
  double split_lambda = 0.5;
  std::string splits;        ///< as parse_splits() reads it; empty: by split_lambda
  std::string cascade_bias;  ///< own_range, or as parse_cascade_bias() reads it
  SplitRange split_range = SplitRange::seen;
  double max_distance = 100.0;
  MapFit fit = MapFit::scene;
  double fit_x = 0.0;
  double fit_y = 0.0;
  double fit_z = 0.0;
  double fit_size = 10.0;
  CascadeFit cascade_fit = CascadeFit::tight;
  CascadeSelection selection = CascadeSelection::map;
  double blend = 0.0;
  double fade = 0.0;  ///< share of max_distance, of a map whose farthest depth that is
  Warp warp = Warp::none;
  double warp_near = 1.0;   ///< metres from the camera; nearer surfaces get fewer texels
  double warp_far = 100.0;  ///< metres
  bool pancaking = false;
  double near_offset = 1.0;
};
Parameters describe(MapFitParams& params);
/// Whether the warp applies: to a single map that is fitted tightly to the view.
bool can_warp(int cascades, const MapFitParams& fit);

/// Throws Error (usage) for cascades or a fit that differs from the default if none of the lights is directional, and
/// for a warp of a map that is not a single one, fitted to the view and tight.
void require_sense(const ShadowMapParams& map, const MapFitParams& fit, std::span<const Light> lights);

/// Far ends of `count` ranges of view depth, metres. lambda mixes logarithmic (1) and uniform (0) splits: the practical
/// split scheme. (F. Zhang, H. Sun, L. Xu and L. K. Lun, Parallel-Split Shadow Maps for Large-Scale Virtual
/// Environments, VRCIA 2006.) nearest and farthest are above 0.
std::vector<double> split_depths(double nearest, double farthest, int count, double lambda = 0.5);

/// Far ends of all ranges but the last, as shares of the whole range: "0.1,0.2,0.5". Throws Error (usage) unless there
/// are `count` − 1 rising numbers between 0 and 1.
std::vector<double> parse_splits(const std::string& text, int count);

/// MapFitParams::cascade_bias: a bias in the map's depth is a share of each cascade's own depth range, its side plus
/// MapFitParams::near_offset.
inline constexpr std::string_view own_range = "own-range";

/// Factors of the constant bias in the cascades, each above 0: "1,2,4". Empty or own_range: all are 1. Throws Error
/// (usage).
std::vector<double> parse_cascade_bias(const std::string& text, int count);

/// What a map is fitted to: its area to the scene. The ground, a flat box or an empty one, only extends the range of
/// depths: light that passes the scene casts no shadow on it.
struct MappedBounds {
  Bounds scene;
  Bounds ground;
  MappedBounds(const Bounds& scene_bounds, const Bounds& ground_bounds = {})
      : scene(scene_bounds), ground(ground_bounds) {}
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
