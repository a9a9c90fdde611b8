#include <algorithm>
#include <cstdint>

#include "core/interrupt.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

void set_base_color(const UploadedScene& scene, const Material& material, const gl::Program& program) {
  const bool has_texture = material.base_color_texture && !scene.textures[*material.base_color_texture].empty();
  const unsigned name = program.name();
  glProgramUniform4f(name, location("UNIFORM_BASE_COLOR"), material.base_color.x, material.base_color.y,
                     material.base_color.z, material.base_color.w);
  glProgramUniform1i(name, location("UNIFORM_HAS_TEXTURE"), has_texture ? 1 : 0);
  if (has_texture) {
    const Texture& modes = scene.texture_modes[*material.base_color_texture];
    glProgramUniform2i(name, location("UNIFORM_WRAP"), static_cast<int>(modes.wrap_u), static_cast<int>(modes.wrap_v));
    glBindTextureUnit(slot("TEXTURE_BASE_COLOR"), scene.textures[*material.base_color_texture].name());
  }
}

void set_surface(const Material& material, const gl::Program& program) {
  const vec3 specular = dielectric_specular(material);
  glProgramUniform2f(program.name(), location("UNIFORM_METALLIC_ROUGHNESS"), material.metallic, material.roughness);
  glProgramUniform3f(program.name(), location("UNIFORM_DIELECTRIC_SPECULAR"), specular.x, specular.y, specular.z);
}

// Software rasterisers draw at once: an interrupt waits for no more than about this many triangles.
constexpr std::uint32_t triangles_a_call = 1'000'000;

void draw_instances(const SceneDraw& draw) {
  const std::uint32_t step = std::max(1u, triangles_a_call / std::max(1u, draw.triangle_count));
  for (std::uint32_t i = 0; i < draw.instance_count; i += step) {
    throw_if_interrupted();
    glDrawElementsInstancedBaseVertexBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(3 * draw.triangle_count), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(std::uintptr_t{draw.first_triangle} * sizeof(uvec3)),
        static_cast<GLsizei>(std::min(step, draw.instance_count - i)), static_cast<GLint>(draw.first_vertex),
        draw.first_instance + i);
  }
}

}  // namespace

void bind_triangles(const UploadedScene& scene) {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_INSTANCES"), scene.instances.name());
  glBindTextureUnit(slot("TEXTURE_POSITIONS"), scene.position_texels.name());
  glBindTextureUnit(slot("TEXTURE_NORMALS"), scene.normal_texels.name());
  glBindTextureUnit(slot("TEXTURE_TRIANGLES"), scene.triangle_texels.name());
}

void draw_scene(const UploadedScene& scene, DrawnFor use, const gl::Program& opaque, const gl::Program& masked) {
  bind_triangles(scene);
  glBindVertexArray(scene.vertex_array.name());
  glVertexAttrib2f(slot("ATTRIBUTE_TEXCOORD"), 0.0f, 0.0f);  // where a draw has none
  glCullFace(GL_BACK);
  // Opaque first: what is masked then meets a filled depth buffer.
  for (const bool is_masked : {false, true}) {
    const gl::Program& program = is_masked ? masked : opaque;
    glUseProgram(program.name());
    for (const SceneDraw& draw : scene.draws) {
      const Material& material = scene.materials.at(draw.material);
      if ((material.alpha_mode == AlphaMode::mask) != is_masked) continue;
      const bool culls = use == DrawnFor::camera && !material.double_sided;
      (culls ? glEnable : glDisable)(GL_CULL_FACE);
      glFrontFace(draw.is_mirrored ? GL_CW : GL_CCW);
      (draw.has_texcoords ? glEnableVertexArrayAttrib : glDisableVertexArrayAttrib)(scene.vertex_array.name(),
                                                                                    slot("ATTRIBUTE_TEXCOORD"));
      // Setting a uniform that a program lacks is an error on some drivers.
      if (is_masked || use == DrawnFor::camera) set_base_color(scene, material, program);
      if (use == DrawnFor::camera) set_surface(material, program);
      if (is_masked) glProgramUniform1f(program.name(), location("UNIFORM_ALPHA_CUTOFF"), material.alpha_cutoff);
      draw_instances(draw);
    }
  }
}

}  // namespace umbrameter
