#include "raster/gbuffer/gbuffer_pass.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "raster/gbuffer/view_block.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

void draw_ids(const gl::Context& context, const UploadedScene& scene, const ViewBlock& view,
              const GpuGBuffer& gbuffer) {
  const gl::Texture depth =
      gl::make_texture("gbuffer depth buffer", gl::Format::depth32f, gbuffer.width, gbuffer.height);
  const gl::Framebuffer framebuffer = gl::make_framebuffer("gbuffer");
  const unsigned target = framebuffer.name();
  glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, gbuffer.ids.name(), 0);
  glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT1, gbuffer.albedo.name(), 0);
  glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT2, gbuffer.specular.name(), 0);
  glNamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, depth.name(), 0);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  glNamedFramebufferDrawBuffers(target, 3, buffers);

  const GLuint empty_ids[] = {no_id, no_id, no_id, no_id};
  const GLfloat zero[] = {0, 0, 0, 0};
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearNamedFramebufferuiv(target, GL_COLOR, 0, empty_ids);
  glClearNamedFramebufferfv(target, GL_COLOR, 1, zero);
  glClearNamedFramebufferfv(target, GL_COLOR, 2, zero);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, zero);

  // Reversed depth: 1 at the near plane, 0 far away, where floats are densest.
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, gbuffer.width, gbuffer.height);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRangef(0.0f, 1.0f);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DEPTH_CLAMP);
  glDepthFunc(GL_GREATER);
  glDisable(GL_BLEND);
  draw_scene(scene, DrawnFor::camera, [&](bool is_masked) {
    gl::Pass pass(context, {{"gbuffer.vert", "gbuffer.frag"}, define("ALPHA_MASK", is_masked ? 1 : 0)});
    pass.block("View", view);
    return pass;
  });
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void resolve(const gl::Context& context, const UploadedScene& scene, const ViewBlock& view, const GpuGBuffer& gbuffer) {
  gl::Pass pass(context, {{"gbuffer_resolve.comp"}, {}});
  bind_triangles(pass, scene)
      .block("View", view)
      .texture("ids", gbuffer.ids)
      .image("position_depth", gbuffer.position_depth, gl::Format::rgba32f)
      .image("geometric_normal", gbuffer.geometric_normal, gl::Format::rgba32f)
      .image("shading_normal", gbuffer.shading_normal, gl::Format::rgba32f)
      .dispatch(gbuffer.width, gbuffer.height);
}

Image<vec4> with_w(const Image<vec3>& image, const Image<float>* w) {
  Image<vec4> wide(image.width, image.height);
  for (std::size_t i = 0; i < image.size(); ++i) wide[i] = vec4(image[i], w != nullptr ? (*w)[i] : 0.0f);
  return wide;
}

void read_vectors(const gl::Texture& texture, Image<vec3>& vectors, Image<float>* w) {
  const Image<vec4> wide = read_image<vec4>(texture, gl::Format::rgba32f);
  parallel_for(static_cast<std::size_t>(wide.height), [&](std::size_t y) {
    const std::size_t first = y * static_cast<std::size_t>(wide.width);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(wide.width); ++i) {
      vectors[i] = vec3(wide[i]);
      if (w != nullptr) (*w)[i] = wide[i].w;
    }
  });
}

}  // namespace

GpuGBuffer make_gbuffer(int width, int height) {
  GpuGBuffer gbuffer;
  gbuffer.width = width;
  gbuffer.height = height;
  gbuffer.ids = gl::make_texture("gbuffer ids", gl::Format::rg32ui, width, height);
  gbuffer.position_depth = gl::make_texture("gbuffer position and depth", gl::Format::rgba32f, width, height);
  gbuffer.geometric_normal = gl::make_texture("gbuffer geometric normal", gl::Format::rgba32f, width, height);
  gbuffer.shading_normal = gl::make_texture("gbuffer shading normal", gl::Format::rgba32f, width, height);
  gbuffer.albedo = gl::make_texture("gbuffer albedo", gl::Format::rgba32f, width, height);
  gbuffer.specular = gl::make_texture("gbuffer specular", gl::Format::rgba32f, width, height);
  return gbuffer;
}

gl::Pass& bind(gl::Pass& pass, const GpuGBuffer& gbuffer) {
  return pass.texture("ids", gbuffer.ids)
      .texture("position_depth", gbuffer.position_depth)
      .texture("geometric_normal", gbuffer.geometric_normal);
}

GpuGBuffer draw_gbuffer(const gl::Context& context, const UploadedScene& scene, const View& view) {
  if (std::max(view.width, view.height) > context.max_texture_size()) {
    throw Error(ExitCode::usage, "view.size",
                "'" + std::to_string(view.width) + "x" + std::to_string(view.height) + "' is more than " +
                    context.device().renderer + " can draw",
                "at most " + std::to_string(context.max_texture_size()) + " pixels a side");
  }
  GpuGBuffer gbuffer = make_gbuffer(view.width, view.height);
  const ViewBlock block = make_view_block(view);
  draw_ids(context, scene, block, gbuffer);
  resolve(context, scene, block, gbuffer);
  return gbuffer;
}

GBuffer read_back(const gl::Context& context, const GpuGBuffer& gbuffer) {
  GBuffer read(gbuffer.width, gbuffer.height);
  const Image<uvec2> ids = read_image<uvec2>(gbuffer.ids, gl::Format::rg32ui);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    read.instance[i] = ids[i].x;
    read.triangle[i] = ids[i].y;
  }
  read_vectors(gbuffer.position_depth, read.position, &read.depth);
  read_vectors(gbuffer.geometric_normal, read.geometric_normal, nullptr);
  read_vectors(gbuffer.shading_normal, read.shading_normal, nullptr);
  read_vectors(gbuffer.albedo, read.albedo, &read.metallic);
  read.specular = read_image<vec4>(gbuffer.specular, gl::Format::rgba32f);
  context.check("gbuffer read back");
  return read;
}

GpuGBuffer upload(const gl::Context& context, const GBuffer& gbuffer) {
  GpuGBuffer uploaded;
  uploaded.width = gbuffer.width;
  uploaded.height = gbuffer.height;
  Image<uvec2> ids(gbuffer.width, gbuffer.height);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = uvec2(gbuffer.instance[i], gbuffer.triangle[i]);
  uploaded.ids = upload_image("gbuffer ids", gl::Format::rg32ui, std::move(ids));
  uploaded.position_depth =
      upload_image("gbuffer position and depth", gl::Format::rgba32f, with_w(gbuffer.position, &gbuffer.depth));
  uploaded.geometric_normal =
      upload_image("gbuffer geometric normal", gl::Format::rgba32f, with_w(gbuffer.geometric_normal, nullptr));
  uploaded.shading_normal =
      upload_image("gbuffer shading normal", gl::Format::rgba32f, with_w(gbuffer.shading_normal, nullptr));
  uploaded.albedo = upload_image("gbuffer albedo", gl::Format::rgba32f, with_w(gbuffer.albedo, &gbuffer.metallic));
  uploaded.specular = upload_image("gbuffer specular", gl::Format::rgba32f, Image<vec4>(gbuffer.specular));
  context.check("gbuffer upload");
  return uploaded;
}

}  // namespace umbrameter
