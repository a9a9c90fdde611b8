#include "raster/shading/gbuffer_store.h"

#include <vector>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/target.h"

namespace umbrameter {
namespace {

gl::Format texture_format(NormalFormat format) {
  if (format == NormalFormat::rgb32f) return gl::Format::rgba32f;
  if (format == NormalFormat::rgb16f) return gl::Format::rgba16f;
  return format == NormalFormat::rg16 ? gl::Format::rg16 : gl::Format::rgba8;
}

}  // namespace

std::string stored_gbuffer_defines(const ShadingParams& params) {
  ShadingParams formats = params;
  return shader_defines(gbuffer_parameters(formats));
}

ShadingBlock make_shading_block(const View& view, const ShadingParams& params, int light_count) {
  ShadingBlock block;
  block.model = light_model(params);
  block.world_from_clip = mat4(glm::inverse(clip_from_view(view) * view_from_world(view)));
  block.ambient = static_cast<float>(params.ambient);
  block.light_count = light_count;
  return block;
}

StoredGBuffer store_gbuffer(const gl::Context& context, const GpuGBuffer& surfels, const View& view,
                            const ShadingParams& params) {
  const auto make = [&](const char* label, gl::Format format) {
    return gl::make_texture(label, format, surfels.width, surfels.height);
  };
  const gl::Format normals = texture_format(params.normal_format);
  const gl::Format colors = params.color_format == ColorFormat::rgba8 ? gl::Format::rgba8 : gl::Format::rgba32f;
  StoredGBuffer stored;
  stored.formats = params;
  stored.depth = make("stored depth", gl::Format::depth32f);
  stored.normal = make("stored normal", normals);
  stored.geometric_normal = make("stored geometric normal", normals);
  stored.diffuse = make("stored diffuse", colors);
  stored.specular = make("stored specular", colors);
  std::vector<const gl::Texture*> targets = {&stored.normal, &stored.geometric_normal, &stored.diffuse,
                                             &stored.specular};
  if (params.position == PositionSource::stored) {
    stored.position = make("stored position", gl::Format::rgba32f);
    targets.push_back(&stored.position);
  }
  const gl::Target target("stored gbuffer", targets, &stored.depth);
  target.clear();
  target.begin({.depth = gl::DepthTest::replace});
  gl::Pass pass(context, {{"fullscreen.vert", "store_gbuffer.frag"}, stored_gbuffer_defines(params)});
  pass.block("View", make_view_block(view))
      .texture("ids", surfels.ids)
      .texture("position_depth", surfels.position_depth)
      .texture("geometric_normal", surfels.geometric_normal)
      .texture("shading_normal", surfels.shading_normal)
      .texture("albedo", surfels.albedo)
      .texture("specular", surfels.specular)
      .use();
  gl::draw_triangles(3);
  gl::make_writes_visible();
  context.check("stored gbuffer");
  return stored;
}

void bind_stored(gl::Pass& pass, const DeferredInput& input, int light_count) {
  const StoredGBuffer& stored = input.stored;
  pass.block("View", make_view_block(input.view))
      .block("Shading", make_shading_block(input.view, input.params, light_count))
      .texture("ids", input.surfels.ids)
      .texture("stored_depth", stored.depth)
      .texture("stored_normal", stored.normal)
      .texture("stored_geometric_normal", stored.geometric_normal)
      .texture("stored_diffuse", stored.diffuse)
      .texture("stored_specular", stored.specular)
      .texture("stored_position", stored.position);
}

GpuGBuffer decode_surfels(const gl::Context& context, const StoredGBuffer& stored, const GpuGBuffer& surfels,
                          const View& view) {
  GpuGBuffer decoded = make_gbuffer(surfels.width, surfels.height);
  decoded.ids = gl::copy_texture("decoded ids", surfels.ids, gl::Format::rg32ui);
  gl::Pass pass(context, {{"stored_surfels.comp"}, stored_gbuffer_defines(stored.formats)});
  bind_stored(pass, {stored, surfels, view, stored.formats}, 0);
  pass.image("position_depth", decoded.position_depth, gl::Format::rgba32f)
      .image("geometric_normal", decoded.geometric_normal, gl::Format::rgba32f)
      .image("shading_normal", decoded.shading_normal, gl::Format::rgba32f)
      .image("decoded_albedo", decoded.albedo, gl::Format::rgba32f)
      .image("decoded_specular", decoded.specular, gl::Format::rgba32f)
      .dispatch(surfels.width, surfels.height);
  return decoded;
}

}  // namespace umbrameter
