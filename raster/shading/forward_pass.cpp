#include <algorithm>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/target.h"
#include "raster/gl/timer.h"
#include "raster/shader_interface.h"
#include "raster/shading/light_buffers.h"
#include "raster/shading/shading_pass.h"
#include "raster/texture_image.h"

namespace umbrameter {

ShadedImage draw_forward(const gl::Context& context, const ForwardInput& input, std::span<const LitLight> lights,
                         const Image<float>& ao) {
  const GpuGBuffer& surfels = input.surfels;
  const gl::Texture radiance = gl::make_texture("radiance", gl::Format::rgba32f, surfels.width, surfels.height);
  const gl::Texture accessibility = upload_image("accessibility", gl::Format::r32f, ao);
  {
    const gl::Target target("forward shading", {&radiance}, nullptr);
    target.clear();
    // Without lights, one pass draws the ambient light.
    for (std::size_t first = 0; first == 0 || first < lights.size(); first += lights_per_pass) {
      const std::span<const LitLight> batch = lights.subspan(first, std::min(lights_per_pass, lights.size() - first));
      const gl::Buffer light_buffer = make_light_buffer(batch);
      const gl::Texture visibility = gl::make_texture("visibilities", gl::Format::r32f, surfels.width, surfels.height,
                                                      static_cast<int>(lights_per_pass));
      for (std::size_t i = 0; i < batch.size(); ++i) {
        write_layer(visibility, gl::Format::r32f, static_cast<int>(i), *batch[i].visibility);
      }
      ShadingParams params = input.params;
      if (first > 0) params.ambient = 0.0;  // the first pass has added it
      const ShadingBlock block = make_shading_block(input.view, params, static_cast<int>(batch.size()));
      const auto make_pass = [&](bool is_masked) {
        gl::Pass pass(context, {{"gbuffer.vert", "forward.frag"}, define("ALPHA_MASK", is_masked ? 1 : 0)});
        pass.block("View", make_view_block(input.view))
            .block("Shading", block)
            .buffer("Lights", light_buffer)
            .texture("ids", surfels.ids)
            .texture("position_depth", surfels.position_depth)
            .texture("shading_normal", surfels.shading_normal)
            .texture("visibilities", visibility)
            .texture("ao", accessibility);
        return pass;
      };
      target.begin({.adds = true});
      gl::run_timed(input.times != nullptr ? &input.times->lights : nullptr,
                    [&] { draw_scene(input.scene, DrawnFor::camera, make_pass); });
    }
  }
  gl::make_writes_visible();
  ShadedImage image;
  image.radiance = read_colors(radiance);
  context.check("forward shading");
  return image;
}

}  // namespace umbrameter
