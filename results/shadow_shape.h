// The shape of one light's shadow error in a run, and the views of its map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/caster_shape.h"
#include "compare/error_shape.h"
#include "compare/map_views.h"
#include "compare/shimmer.h"

namespace umbrameter {

struct MapViews {
  std::vector<ViewStatistics> views{};    ///< of a map with several views
  std::optional<SeamStatistics> seams{};  ///< likewise
  std::optional<FitShimmer> shimmer{};    ///< with run.shimmer, of a map whose fit follows the camera
};

struct Shimmer {
  double grid_mean = 0.0;     ///< mean over the moves of the map's grid, share of the counted pixels
  double grid_largest = 0.0;  ///< maximum over the moves of the map's grid
  Flips camera;               ///< mean over the moves of the camera
  /// Change of the truth over the same moves of the camera, at the same pixels; only for a light without extent.
  std::optional<Flips> camera_truth;
};

struct ShadowShape {
  ErrorShape error;
  std::vector<CasterShape> casters{};             ///< of a light without extent
  std::optional<ContactSearch> contact_search{};  ///< likewise
  std::optional<Shimmer> shimmer{};               ///< with run.shimmer
  MapViews views{};
};

/// Why no contact gap could be measured, as a sentence without its full stop; empty where one was, and without a
/// shadow.
std::string missing_contacts_text(const ContactSearch& search);

}  // namespace umbrameter
