// What a method of ambient occlusion should not depend on: the angle of view of an open plane, the camera's rotation
// about its axis, the resolution, and the seed of its noise; and how much other settings change it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "raster/rasterizer.h"
#include "scenes/scene.h"
#include "scenes/view.h"

namespace umbrameter {

struct Darkening {
  double mean = 0.0;
  double worst = 0.0;
};

/// 1 − AO of an endless plane, in a square of a fifth of the image's height about the axis of the camera, or about the
/// ray 24 degrees to its side. `angle`: between the axis and the plane's normal, degrees. The camera is 3 m away, and
/// its image `height` pixels high and three times as wide.
struct PlanePlace {
  double angle = 0.0;
  bool is_at_edge = false;
  int height = 160;  ///< a multiple of 10
  int seeds = 1;     ///< whose mean it is
};
Darkening open_plane_darkening(const gl::Context& context, const AoParams& params, const PlanePlace& place);

/// Pixels across the screen, on the axis of that camera.
double radius_in_pixels(const AoParams& params, int height);

/// Root mean squares over the pixels that see a surface.
struct AoVariation {
  double rotation = 0.0;  ///< camera rotated by 90 degrees about its axis, mean of the seeds
  double half = 0.0;      ///< half resolution against the mean of 2×2 pixels, mean of the seeds
  double noise = 0.0;     ///< standard deviation over the seeds
};
AoVariation measure_variation(const gl::Context& context, const UploadedScene& scene, const View& view,
                              const AoParams& params, int seeds);

/// Root mean square of the part of the noise that repeats with the noise tile: of each pixel's deviation from its mean
/// over the seeds and from the deviations about it, as far as it agrees with that of the pixel one tile further.
double measure_period(const gl::Context& context, const UploadedScene& scene, const View& view, const AoParams& params,
                      int seeds);

/// Mean angles in degrees between bent normals and those of the reference, over the pixels where both exist and seeds.
struct BentNormalError {
  double method = 0.0;
  double normal = 0.0;  ///< of the geometric normal instead
};
/// `reference`: the mean open direction of each surfel, cosine-weighted, up to the method's radius. Nothing if the
/// method yields no bent normal.
std::optional<BentNormalError> measure_bent_normals(const gl::Context& context, const GpuGBuffer& gbuffer,
                                                    const View& view, const AoParams& params, int seeds,
                                                    const Image<vec3>& reference);

struct AoSetting {
  std::string_view key;
  std::string_view value;
};
/// What each setting alone changes, mean of the seeds: root mean squares over the pixels that see a surface.
std::vector<double> measure_changes(const gl::Context& context, const UploadedScene& scene, const View& view,
                                    const AoParams& params, int seeds, const std::vector<AoSetting>& settings);

}  // namespace umbrameter
