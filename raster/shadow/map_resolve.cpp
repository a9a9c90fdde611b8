#include "raster/shadow/map_resolve.h"

#include "raster/gl/api.h"
#include "raster/gl/pass.h"
#include "raster/gl/target.h"
#include "raster/shader_interface.h"
#include "raster/shadow/light_block.h"

namespace umbrameter {
namespace {

// Draws one depth per texel of each view.
void draw_depths(const MapSource& source, gl::Pass& pass, const gl::Texture& depth) {
  pass.block("LightBlock", make_light_block(source.light, source.layout))
      .value("near_depth", static_cast<float>(source.params.near_depth));
  const gl::Target target("shadow depth", {}, &depth);
  target.begin({.depth = gl::DepthTest::replace});
  for (int view = 0; view < static_cast<int>(source.layout.views.size()); ++view) {
    target.set_layer(depth, view);
    pass.value("map_view", view).use();
    gl::draw_triangles(3);
  }
  gl::make_writes_visible();
  source.context.check("shadow depth");
}

std::string defines_of(const MapSource& source, int mapping) {
  return map_defines(source.layout) + define("DEPTH_MAPPING", static_cast<unsigned>(mapping));
}

}  // namespace

void combine_layers(const MapSource& source, const MapLayers& layers, const gl::Texture& stored, int mapping) {
  const auto surface = static_cast<unsigned>(source.params.surface);
  gl::Pass pass(source.context, {{"fullscreen.vert", "shadow_resolve.frag"},
                                 defines_of(source, mapping) + define("COMBINES", 1) + define("SURFACE", surface)});
  pass.texture("nearest_layer", layers.nearest)
      .texture("second_layer", layers.second)
      .value("dual_offset", static_cast<float>(source.params.dual_offset));
  draw_depths(source, pass, stored);
}

void decode_depth_map(const MapSource& source, const gl::Texture& stored, const gl::Texture& linear) {
  const int mapping = depth_mapping(source.params, source.layout.kind);
  gl::Pass pass(source.context,
                {{"fullscreen.vert", "shadow_resolve.frag"}, defines_of(source, mapping) + define("COMBINES", 0)});
  pass.texture("stored_depth", stored);
  draw_depths(source, pass, linear);
}

}  // namespace umbrameter
