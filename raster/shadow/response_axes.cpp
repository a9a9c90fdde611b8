#include "raster/shadow/response_axes.h"

#include <algorithm>
#include <span>
#include <vector>

#include "raster/gl/api.h"
#include "raster/shader_interface.h"

namespace umbrameter {
namespace {

/// As ResponseBlock in shaders/response.glsl, layout std140.
struct ResponseBlock {
  float min_bias = 0.0f;
  float largest_bias = 0.0f;
  float min_slope = 0.0f;
  float largest_slope = 0.0f;
  int bias_count = 0;
  int slope_count = 0;
  int unused[2] = {};
};
static_assert(sizeof(ResponseBlock) == 32);

ResponseBlock make_block(const BiasAxes& axes) {
  const auto [least, largest] = std::minmax_element(axes.slope.begin(), axes.slope.end());
  return {axes.constant.front(),
          axes.constant.back(),
          *least,
          *largest,
          static_cast<int>(axes.constant.size()),
          static_cast<int>(axes.slope.size())};
}

}  // namespace

ResponseAxes bind_axes(const BiasAxes& axes) {
  std::vector<float> both = axes.constant;
  both.insert(both.end(), axes.slope.begin(), axes.slope.end());
  ResponseAxes bound{gl::make_block("response axes", make_block(axes)),
                     gl::make_buffer("biases", std::span<const float>(both))};
  glBindBufferBase(GL_UNIFORM_BUFFER, slot("BLOCK_RESPONSE"), bound.block.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_AXES"), bound.values.name());
  return bound;
}

}  // namespace umbrameter
