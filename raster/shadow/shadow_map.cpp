#include "raster/shadow/shadow_map.h"

#include <cstdint>
#include <string>

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/shadow/light_block.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

int layer_count(const MapLayout& layout) { return static_cast<int>(layout.views.size()); }

void require_room(const gl::Context& context, const MapLayout& layout) {
  const auto side = static_cast<std::size_t>(layout.resolution);
  const std::size_t bytes = side * side * static_cast<std::size_t>(layer_count(layout)) *
                            (gl::texel_bytes(gl::Format::depth32f) + gl::texel_bytes(gl::Format::rg32ui));
  std::string given = std::to_string(layout.resolution);
  given += " texels ";
  if (layout.resolution > context.max_texture_size()) {
    throw Error(ExitCode::usage, "shadow.resolution",
                given + "are more than " + context.device().renderer + " can draw",
                "at most " + std::to_string(context.max_texture_size()));
  }
  if (bytes > context.memory_limit_bytes()) {
    throw Error(ExitCode::usage, "shadow.resolution",
                given + "take " + std::to_string(bytes >> 20) + " MiB of the machine's " +
                    std::to_string(context.memory_limit_bytes() >> 20) + " MiB",
                "choose a smaller resolution");
  }
}

// One view after another, each into its layer. The other kinds draw all layers at once through a geometry shader.
void draw_views(const UploadedScene& scene, const MakePass& make_pass, const gl::Framebuffer& framebuffer,
                const ShadowMap& map) {
  for (int view = 0; view < layer_count(map.layout); ++view) {
    glNamedFramebufferTextureLayer(framebuffer.name(), GL_COLOR_ATTACHMENT0, map.ids.name(), 0, view);
    glNamedFramebufferTextureLayer(framebuffer.name(), GL_DEPTH_ATTACHMENT, map.depth.name(), 0, view);
    draw_scene(scene, DrawnFor::shadow, [&](bool is_masked) {
      gl::Pass pass = make_pass(is_masked);
      pass.value("map_view", view);
      return pass;
    });
  }
}

}  // namespace

ShadowMap make_shadow_map(const gl::Context& context, const MapLayout& layout) {
  require_room(context, layout);
  ShadowMap map;
  map.layout = layout;
  map.depth =
      gl::make_texture("shadow depth", gl::Format::depth32f, layout.resolution, layout.resolution, layer_count(layout));
  map.ids =
      gl::make_texture("shadow ids", gl::Format::rg32ui, layout.resolution, layout.resolution, layer_count(layout));
  context.check("shadow map textures");
  return map;
}

bool has_textures_for(const ShadowMap& map, const MapLayout& layout) {
  return map.layout.resolution == layout.resolution && layer_count(map.layout) == layer_count(layout);
}

void redraw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light, ShadowMap& map) {
  const MapLayout& layout = map.layout;
  const LightBlock block = make_light_block(light, layout);
  const MakePass make_pass = [&](bool is_masked) {
    gl::ProgramSource source{{"shadow.vert", "shadow.frag"},
                             map_defines(layout) + define("ALPHA_MASK", is_masked ? 1 : 0)};
    if (layout.kind != MapKind::orthographic) source.files.insert(source.files.begin() + 1, "shadow.geom");
    gl::Pass pass(context, source);
    pass.block("LightBlock", block);
    return pass;
  };

  const gl::Framebuffer framebuffer = gl::make_framebuffer("shadow map");
  const unsigned target = framebuffer.name();
  glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, map.ids.name(), 0);
  glNamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, map.depth.name(), 0);
  const GLuint empty_ids[] = {no_id, no_id, no_id, no_id};
  const GLfloat one = 1.0f;
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearNamedFramebufferuiv(target, GL_COLOR, 0, empty_ids);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &one);

  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, layout.resolution, layout.resolution);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRangef(0.0f, 1.0f);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
  // Orthographic: what rounding puts before the near face still casts. The others clip at their own tiny near plane.
  (layout.kind == MapKind::orthographic ? glEnable : glDisable)(GL_DEPTH_CLAMP);
  if (layout.kind == MapKind::orthographic) {
    draw_views(scene, make_pass, framebuffer, map);
  } else {
    draw_scene(scene, DrawnFor::shadow, make_pass);
  }
  glDisable(GL_DEPTH_CLAMP);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  context.check("shadow map");
}

ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const MapLayout& layout) {
  ShadowMap map = make_shadow_map(context, layout);
  redraw_shadow_map(context, scene, light, map);
  return map;
}

ShadowMapImages read_back(const gl::Context& context, const ShadowMap& map) {
  const int layers = layer_count(map.layout);
  ShadowMapImages images;
  images.depth = read_layers<float>(map.depth, gl::Format::depth32f, layers);
  for (const Image<uvec2>& ids : read_layers<uvec2>(map.ids, gl::Format::rg32ui, layers)) {
    Image<std::uint32_t>& instance = images.instance.emplace_back(ids.width, ids.height);
    Image<std::uint32_t>& triangle = images.triangle.emplace_back(ids.width, ids.height);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      instance[i] = ids[i].x;
      triangle[i] = ids[i].y;
    }
  }
  context.check("shadow map read back");
  return images;
}

}  // namespace umbrameter
