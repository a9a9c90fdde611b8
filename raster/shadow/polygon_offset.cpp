#include "raster/shadow/polygon_offset.h"

#include <array>
#include <span>

#include "raster/gl/api.h"
#include "raster/gl/pass.h"
#include "raster/gl/target.h"
#include "raster/shadow/map_layer.h"

namespace umbrameter {

double measure_offset_unit(const gl::Context& context, MapDepthFormat format) {
  // So many that the format's rounding hides no part of a unit, and few enough that a float's exponent stays.
  constexpr float units = 1024.0f;
  const gl::Format of_texture = texture_format(format);
  std::array<float, 2> depths{};
  for (const bool has_offset : {false, true}) {
    const gl::Texture depth = gl::make_texture("polygon offset", of_texture, 1, 1);
    const gl::Target target("polygon offset", {}, &depth);
    target.begin({.depth = gl::DepthTest::replace});
    const gl::Pass pass(context, {{"fullscreen.vert", "depth_only.frag"}, {}});
    pass.use();
    if (has_offset) glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0.0f, units);
    gl::draw_triangles(3);
    glDisable(GL_POLYGON_OFFSET_FILL);
    gl::read_texels(depth, of_texture, std::as_writable_bytes(std::span(&depths[has_offset ? 1 : 0], 1)));
  }
  context.check("polygon offset");
  return (static_cast<double>(depths[1]) - static_cast<double>(depths[0])) / static_cast<double>(units);
}

}  // namespace umbrameter
