// The uniform block of a light and its map. Internal to raster.
#pragma once

#include <string>

#include "core/math.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The same layout (std140) as LightBlock in shaders/light.glsl.
struct LightBlock {
  dmat4 light_from_world{1.0};
  dvec4 light_in_world{0.0};
  dvec4 face_basis[18] = {};
  dvec4 views[max_map_views] = {};
  float bias_factors[max_map_views] = {};
  dvec4 view_depth_plane{0.0};
  dvec2 warp_center{0.0};
  dvec2 warp_scale{1.0};
  dvec2 warp_shift{0.0};
  double fade_start = 0.0;
  double warp_middle_depth = 0.0;
  double far_depth = 1.0;
  double nearest_view_depth = 0.0;
  double cascade_blend = 0.0;
  double encoded_near = 0.0;
  double offset_metres = 0.0;
  int resolution = 1;
  float constant_bias = 0.0f;
  float slope_bias = 0.0f;
  float normal_offset = 0.0f;
  float filter_radius = 0.0f;
  int tap_count = 0;
  int bias_unit = 0;
  int view_count = 1;
  float cone_bias = 0.0f;
  float search_extent = 0.0f;
  float max_radius = 0.0f;
  float min_radius = 0.0f;
  int search_count = 0;
  int search_in_cone = 0;
  int selects_by_depth = 0;
  int uses_neighbour = 0;
  int is_stable = 0;
  int offset_profile = 0;
  int offset_is_across = 0;
  int unused = 0;
  double warp_depth_scale = 1.0;
};
static_assert(sizeof(LightBlock) == 1248);

/// The block for drawing the map. Bias and filter are 0; lookup_pass() in shadow_lookup.h sets them for a look-up.
LightBlock make_light_block(const Light& light, const MapLayout& layout);

/// "#define MAP_KIND 0", MAP_WARPED, and STORES_OVER_W of a warped map
std::string map_defines(const MapLayout& layout);

}  // namespace umbrameter
