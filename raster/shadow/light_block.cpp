#include "raster/shadow/light_block.h"

#include <cstddef>

#include "raster/shader_interface.h"

namespace umbrameter {

LightBlock make_light_block(const Light& light, const LightFrame& frame) {
  LightBlock block;
  block.light_from_world = frame.light_from_world;
  block.light_in_world = homogeneous_place(light);
  for (int face = 0; face < 6; ++face) {
    const dmat3 basis = cube_face(face);
    for (int axis = 0; axis < 3; ++axis) block.face_basis[3 * face + axis] = dvec4(basis[axis], 0.0);
  }
  block.half_extent = frame.half_extent;
  block.far_depth = frame.far_depth;
  block.resolution = frame.resolution;
  return block;
}

std::string map_defines(const LightFrame& frame) { return define("MAP_KIND", static_cast<unsigned>(frame.kind)); }

}  // namespace umbrameter
