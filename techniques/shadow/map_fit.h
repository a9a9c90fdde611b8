// The parameters of how a directional light's map is fitted: the area of each view, and the split into cascades. The
// number of views and their resolution are in ShadowMapParams; fit_map() of cascades.h does it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/light.h"
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
/// SplitRange::camera, a stable area has the same size wherever the camera is and looks. boxes: around the part of the
/// frustum within the boxes of objects, receiver_volume(), which is also what SplitRange::seen is then.
enum class CascadeFit : int { tight, stable, boxes };

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
  double fit_depth = 0.0;  ///< metres, half of it on either side of the centre; 0: the scene's
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
/// Texels between the border of the map and what it is fitted to.
int fit_margin(int cascades, const MapFitParams& fit);

/// Whether the warp applies: to a single map that is fitted to the view, and not stable.
bool can_warp(int cascades, const MapFitParams& fit);

/// Throws Error (usage) for cascades or a fit that differs from the default if none of the lights is directional, and
/// for a warp of a map that is not a single one, fitted to the view and tight.
void require_sense(const ShadowMapParams& map, const MapFitParams& fit, std::span<const Light> lights);

/// Far ends of all ranges but the last, as shares of the whole range: "0.1,0.2,0.5". Throws Error (usage) unless there
/// are `count` − 1 rising numbers between 0 and 1.
std::vector<double> parse_splits(const std::string& text, int count);

/// MapFitParams::cascade_bias: a bias in the map's depth is a share of each cascade's own depth range, its side plus
/// MapFitParams::near_offset.
inline constexpr std::string_view own_range = "own-range";

/// Factors of the constant bias in the cascades, each above 0: "1,2,4". Empty or own_range: all are 1. Throws Error
/// (usage).
std::vector<double> parse_cascade_bias(const std::string& text, int count);

}  // namespace umbrameter
