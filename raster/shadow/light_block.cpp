#include "raster/shadow/light_block.h"

#include <cstddef>

#include "raster/shader_interface.h"
#include "techniques/shadow/map_depth.h"

namespace umbrameter {

LightBlock make_light_block(const Light& light, const MapLayout& layout) {
  LightBlock block{};
  block.light_from_world = layout.light_from_world;
  block.light_in_world = homogeneous_position(light);
  for (int face = 0; face < 6; ++face) {
    const dmat3 basis = cube_face(face);
    for (int axis = 0; axis < 3; ++axis) block.face_basis[3 * face + axis] = dvec4(basis[axis], 0.0);
  }
  block.view_count = static_cast<int>(layout.views.size());
  for (std::size_t v = 0; v < layout.views.size(); ++v) {
    block.map_views[v] = dvec4(layout.views[v].center, layout.views[v].half_extent, layout.views[v].farthest);
  }
  block.view_depth_plane = layout.view_depth_plane;
  const MapWarp warp = layout.warp.value_or(MapWarp{});
  block.warp_center = warp.center;
  block.warp_scale = warp.scale;
  block.warp_shift = warp.shift;
  block.warp_middle_depth = warp.middle_depth;
  block.warp_depth_scale = warp.depth_scale;
  block.fade_start = layout.fade_start;
  block.nearest_view_depth = layout.nearest_view_depth;
  block.cascade_blend = layout.blend;
  block.selects_by_depth = layout.selection == CascadeSelection::depth ? 1 : 0;
  block.is_stable = layout.is_stable ? 1 : 0;
  block.uses_neighbour = layout.uses_neighbour ? 1 : 0;
  block.far_depth = layout.far_depth;
  block.encoded_near = layout.encoded_near;
  block.encoded_far = far_end_of(layout);
  block.tie_shift = layout.equal_is_lit ? 1 : -1;
  if (layout.rounds_receivers) {
    const ClipRows rows = clip_rows(layout);
    block.receiver_z = rows.z;
    block.receiver_w = rows.w;
  }
  block.resolution = layout.resolution;
  return block;
}

std::string map_defines(const MapLayout& layout) {
  return define("MAP_KIND", static_cast<unsigned>(layout.kind)) + define("MAP_WARPED", layout.warp ? 1 : 0) +
         define("ROUNDS_RECEIVERS", layout.rounds_receivers ? 1 : 0) +
         define("STORES_OVER_W", layout.warp && layout.warp->stores_over_w ? 1 : 0);
}

}  // namespace umbrameter
