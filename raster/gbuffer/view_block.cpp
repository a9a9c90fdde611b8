#include "raster/gbuffer/view_block.h"

namespace umbrameter {

ViewBlock make_view_block(const View& view) {
  const dmat4& world_from_camera = view.camera.world_from_camera;
  const dmat4 projection = clip_from_view(view);
  ViewBlock block{};
  block.view_from_world = view_from_world(view);
  block.clip_from_world = projection * block.view_from_world;
  block.eye = dvec4(dvec3(world_from_camera[3]), 0.0);
  block.axis = dvec4(-glm::normalize(dvec3(world_from_camera[2])), 0.0);
  block.clip_from_view = mat4(projection);
  block.size = ivec2(view.width, view.height);
  block.is_orthographic = std::holds_alternative<OrthographicProjection>(view.camera.projection) ? 1 : 0;
  // Normalised device x is projection[0][0] · x (over −z in perspective), so its inverse is what one unit spans.
  const dvec4 right = dvec4(dvec3(world_from_camera[0]), 0.0) / projection[0][0];
  const dvec4 up = dvec4(dvec3(world_from_camera[1]), 0.0) / projection[1][1];
  dvec4* spanned = block.is_orthographic != 0 ? block.ray_origin : block.ray_direction;
  block.ray_direction[0] = block.axis;
  spanned[1] = right;
  spanned[2] = up;
  return block;
}

}  // namespace umbrameter
