#include "raster/light_block.h"

#include <cstddef>

#include "raster/shader_interface.h"

namespace umbrameter {

LightBlock make_light_block(const Light& light, const LightFrame& frame, const ShadowParams& params) {
  LightBlock block;
  block.light_from_world = frame.light_from_world;
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  block.light_in_world = is_directional ? dvec4(to_light(light, dvec3(0.0)), 0.0) : dvec4(light.position(), 1.0);
  for (std::size_t face = 0; face < 6; ++face) {
    dvec3 forward(0.0);
    forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
    const dvec3 up = face / 2 == 1 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, 1.0, 0.0);
    block.face_basis[3 * face] = dvec4(glm::cross(forward, up), 0.0);
    block.face_basis[3 * face + 1] = dvec4(up, 0.0);
    block.face_basis[3 * face + 2] = dvec4(forward, 0.0);
  }
  block.half_extent = frame.half_extent;
  block.far_depth = frame.far_depth;
  block.resolution = frame.resolution;
  block.constant_bias = static_cast<float>(params.constant_bias);
  block.slope_bias = static_cast<float>(params.slope_bias);
  block.normal_offset = static_cast<float>(params.normal_offset);
  block.filter_radius = static_cast<float>(params.filter_radius);
  return block;
}

std::string map_defines(const LightFrame& frame) { return define("MAP_KIND", static_cast<unsigned>(frame.kind)); }

}  // namespace umbrameter
