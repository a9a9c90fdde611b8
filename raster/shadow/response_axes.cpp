#include "raster/shadow/response_axes.h"

#include <algorithm>
#include <span>
#include <vector>

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

gl::Pass& bind_axes(gl::Pass& pass, const BiasAxes& axes) {
  std::vector<float> both = axes.constant;
  both.insert(both.end(), axes.slope.begin(), axes.slope.end());
  return pass.block("ResponseBlock", make_block(axes))
      .buffer("Axes", gl::make_buffer("biases", std::span<const float>(both)));
}

gl::Buffer list_response_pixels(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes,
                                bool lit_alone) {
  gl::Buffer list = make_pixel_list(context, lookup.gbuffer);
  gl::Pass pass =
      lookup_pass(context, lookup, axes.unit, {{"response_pixels.comp"}, define("LIT_ALONE", lit_alone ? 1 : 0)});
  bind_axes(pass, axes).buffer("PixelList", list).dispatch(lookup.gbuffer.width, lookup.gbuffer.height);
  return list;
}

}  // namespace umbrameter
