// The shadow error at every cell of a grid of biases, found in three ways that must agree to the last tap.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/bias_response.h"
#include "compare/unresolved_taps.h"
#include "raster/rasterizer.h"
#include "scenes/scene.h"
#include "scenes/view.h"

namespace umbrameter::test {

struct NamedFilter {
  std::string name;
  ShadowParams params;
};
/// Nearest, bilinear, 3×3 box, 5×5 Gaussian, 16 Poisson points, and some of linear taps.
std::vector<NamedFilter> usual_filters();

/// The scene's own light if it is directional, else a sun; and a spot and a point light above the scene.
std::vector<Light> lights_of_every_kind(const Scene& scene);

struct BiasGrid {
  BiasAxes axes;
  std::vector<int> resolutions;
  std::vector<NamedFilter> filters;
  std::vector<double> normal_offsets = {0.0};
  std::size_t judged_filters = 2;  ///< of the first ones the classes are compared by the judge, too
  int cascades = 1;
  MapDepthParams map_depth{};
  MapFitParams fit{};
};

struct Agreement {
  std::size_t views = 0;  ///< of the last map
  std::size_t cells = 0;
  std::size_t wrong_cells = 0;             ///< cells with any wrong tap
  std::size_t tested_taps = 0;             ///< that the two-plane rule called false occlusion
  std::size_t own_taps = 0;                ///< of those, by the judge
  std::vector<std::string> disagreements;  ///< one line each
  double identity_gap = 0.0;               ///< largest |mean |raster − truth| − sum of the causes| of a cell
};

/// One pass on the device, the same on the processor from the map read back, and each cell drawn on its own; by the
/// two-plane rule and, of some filters, by the judge.
Agreement compare_ways(const gl::Context& context, const Scene& scene, const View& view, const Light& light,
                       const BiasGrid& grid);

}  // namespace umbrameter::test
