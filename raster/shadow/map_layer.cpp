#include "raster/shadow/map_layer.h"

#include <array>
#include <span>

#include "raster/gl/api.h"
#include "raster/gl/pass.h"
#include "raster/gl/target.h"
#include "raster/shader_interface.h"
#include "raster/shadow/light_block.h"

namespace umbrameter {
namespace {

bool is_reversed(int mapping) {
  return mapping == shared::DEPTH_REVERSED_LINEAR || mapping == shared::DEPTH_REVERSED_PERSPECTIVE ||
         mapping == shared::DEPTH_REVERSED_OVER_W;
}

// Whether shadow.frag computes the depth at a texel's centre; the rasteriser would interpolate it.
bool writes_depth(const MapLayout& layout) { return is_projective(layout.kind) || layout.warp; }

DrawnFor use_of(CasterFaces faces) {
  if (faces == CasterFaces::front) return DrawnFor::shadow_of_front_faces;
  return faces == CasterFaces::back ? DrawnFor::shadow_of_back_faces : DrawnFor::shadow;
}

// Where a shader writes the depth, it adds the polygon offset, too: the hardware's has no effect there.
MakePass pass_maker(const MapSource& source, const MapLayer& layer) {
  const bool has_plane = writes_depth(source.layout);
  const bool has_passes = source.layout.kind == MapKind::cube && source.params.cube_passes;
  const NormalOffset& offset = source.params.caster_offset;
  const bool moves_casters = !is_none(offset);
  gl::ProgramSource program{
      {"shadow.vert", "shadow.frag"},
      map_defines(source.layout) + define("DEPTH_MAPPING", static_cast<unsigned>(layer.mapping)) +
          define("HAS_PLANE", has_plane ? 1 : 0) + define("MOVES_CASTERS", moves_casters ? 1 : 0) +
          define("CUBE_PASSES", has_passes ? 1 : 0) + define("PEELS", layer.in_front != nullptr ? 1 : 0) +
          define("HAS_OFFSET", has_plane && has_polygon_offset(source.params) ? 1 : 0) +
          define("IS_FLOAT", texture_format(layer.format) == gl::Format::depth32f ? 1 : 0)};
  if (has_plane || moves_casters) {
    program.files.insert(program.files.begin() + 1, has_plane ? "shadow.geom" : "moved_shadow.geom");
  }
  const double sign = is_reversed(layer.mapping) ? -1.0 : 1.0;
  const bool needs_unit = has_plane && source.params.polygon_offset_units != 0.0;
  const double unit = needs_unit ? measure_offset_unit(source.context, layer.format) : 0.0;
  return [&source, &layer, &offset, program, sign, unit,
          block = make_light_block(source.light, source.layout)](bool is_masked) {
    gl::Pass pass(source.context, {program.files, program.defines + define("ALPHA_MASK", is_masked ? 1 : 0)});
    pass.block("LightBlock", block)
        .value("near_depth", static_cast<float>(source.params.near_depth))
        .value("caster_texels", static_cast<float>(offset.texels))
        .value("caster_metres", static_cast<float>(offset.metres))
        .value("caster_profile", static_cast<int>(offset.profile))
        .value("offset_factor", static_cast<float>(sign * source.params.polygon_offset_factor))
        .value("offset_units", static_cast<float>(sign * unit * source.params.polygon_offset_units));
    if (layer.in_front != nullptr) pass.texture("in_front", *layer.in_front);
    return pass;
  };
}

// One view after another, each into its layer.
void draw_views(const MapSource& source, const MapLayer& layer, const MakePass& make_pass, unsigned framebuffer) {
  const DrawnFor use = use_of(source.params.faces);
  for (int view = 0; view < static_cast<int>(source.layout.views.size()); ++view) {
    glNamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, layer.ids.name(), 0, view);
    glNamedFramebufferTextureLayer(framebuffer, GL_DEPTH_ATTACHMENT, layer.depth.name(), 0, view);
    draw_scene(source.scene, use, [&](bool is_masked) {
      gl::Pass pass = make_pass(is_masked);
      pass.value("map_view", view);
      return pass;
    });
  }
}

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

gl::Format texture_format(MapDepthFormat format) {
  if (format == MapDepthFormat::fixed24) return gl::Format::depth24;
  return format == MapDepthFormat::fixed16 ? gl::Format::depth16 : gl::Format::depth32f;
}

void draw_map_layer(const MapSource& source, const MapLayer& layer) {
  const MapLayout& layout = source.layout;
  const MapDepthParams& params = source.params;
  const MakePass make_pass = pass_maker(source, layer);
  const bool reversed = is_reversed(layer.mapping);

  const gl::Framebuffer framebuffer = gl::make_framebuffer("shadow map");
  const unsigned target = framebuffer.name();
  glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, layer.ids.name(), 0);
  glNamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, layer.depth.name(), 0);
  const GLuint empty_ids[] = {no_id, no_id, no_id, no_id};
  const GLfloat far_away = reversed ? 0.0f : 1.0f;
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearNamedFramebufferuiv(target, GL_COLOR, 0, empty_ids);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &far_away);

  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, layout.resolution, layout.resolution);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRangef(0.0f, 1.0f);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(reversed ? GL_GREATER : GL_LESS);
  glDisable(GL_BLEND);
  // Orthographic: what rounding puts before the near face still casts. The others clip at their own tiny near plane.
  (layout.kind == MapKind::orthographic ? glEnable : glDisable)(GL_DEPTH_CLAMP);
  if (has_polygon_offset(params)) {
    const double sign = reversed ? -1.0 : 1.0;
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(static_cast<GLfloat>(sign * params.polygon_offset_factor),
                    static_cast<GLfloat>(sign * params.polygon_offset_units));
  }
  if (layout.kind == MapKind::paraboloid) glEnable(GL_CLIP_DISTANCE0);
  if (!writes_depth(layout) || (layout.kind == MapKind::cube && params.cube_passes)) {
    draw_views(source, layer, make_pass, target);
  } else {
    // All views at once, through a geometry shader.
    draw_scene(source.scene, use_of(params.faces), make_pass);
  }
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  source.context.check("shadow map");
}

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
  const int mapping = depth_mapping(source.params, source.layout);
  const bool rounds_down = source.params.format == MapDepthFormat::f16_down;
  const bool is_half = rounds_down || source.params.format == MapDepthFormat::f16;
  gl::Pass pass(source.context, {{"fullscreen.vert", "shadow_resolve.frag"},
                                 defines_of(source, mapping) + define("COMBINES", 0) +
                                     define("IS_HALF", is_half ? 1 : 0) + define("ROUNDS_DOWN", rounds_down ? 1 : 0)});
  pass.texture("stored_depth", stored);
  draw_depths(source, pass, linear);
}

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
