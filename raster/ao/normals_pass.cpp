#include "raster/ao/normals_pass.h"

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"

namespace umbrameter {

gl::Texture draw_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const gl::Texture& linear_depth,
                         const View& view, AoInputParams params) {
  gl::Texture normals = gl::make_texture("ao normals", gl::Format::rgba32f, gbuffer.width, gbuffer.height);
  gl::Pass pass(context, {{"ao_normals.comp"}, shader_defines(describe(params))});
  bind(pass, gbuffer)
      .texture("linear_depth", linear_depth)
      .block("View", make_view_block(view))
      .image("normals", normals, gl::Format::rgba32f)
      .dispatch(gbuffer.width, gbuffer.height);
  return normals;
}

}  // namespace umbrameter
