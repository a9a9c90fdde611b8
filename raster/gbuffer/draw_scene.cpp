#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "core/interrupt.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

struct SampledTexture {
  const char* texture;
  const char* wrap;
};
// In the order of texture_members.
constexpr std::array<SampledTexture, texture_members.size()> sampled_textures{
    {{"base_color_texture", "base_color_wrap"},
     {"metallic_roughness_texture", "metallic_roughness_wrap"},
     {"specular_texture", "specular_wrap"},
     {"specular_color_texture", "specular_color_wrap"}}};

void set_material(const UploadedScene& scene, const Material& material, gl::Pass& pass) {
  int textures = 0;
  for (std::size_t i = 0; i < sampled_textures.size(); ++i) {
    const auto& [texture, wrap] = sampled_textures[i];
    pass.value(wrap, 0, 0).texture(texture, {});
    const std::optional<std::uint32_t>& index = material.*texture_members[i];
    if (!index || scene.textures[*index].empty()) continue;
    const Texture& modes = scene.texture_modes[*index];
    pass.value(wrap, static_cast<int>(modes.wrap_u), static_cast<int>(modes.wrap_v))
        .texture(texture, scene.textures[*index]);
    textures |= 1 << i;
  }
  pass.value("base_color_factor", material.base_color)
      .value("alpha_cutoff", material.alpha_cutoff)
      .value("metallic_roughness_factors", vec2(material.metallic, material.roughness))
      .value("dielectric_specular", dielectric_specular(material))
      .value("material_textures", textures);
  pass.use();
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

gl::Pass& bind_triangles(gl::Pass& pass, const UploadedScene& scene) {
  return pass.buffer("Instances", scene.instances)
      .texture("positions", scene.position_texels)
      .texture("normals", scene.normal_texels)
      .texture("triangles", scene.triangle_texels);
}

void draw_scene(const UploadedScene& scene, DrawnFor use, const MakePass& make_pass) {
  glBindVertexArray(scene.vertex_array.name());
  glVertexAttrib2f(constant("ATTRIBUTE_TEXCOORD"), 0.0f, 0.0f);  // where a draw has none
  glCullFace(use == DrawnFor::shadow_of_back_faces ? GL_FRONT : GL_BACK);
  // Opaque first: what is masked then meets a filled depth buffer.
  for (const bool is_masked : {false, true}) {
    gl::Pass pass = make_pass(is_masked);
    bind_triangles(pass, scene);
    const Material* current = nullptr;
    for (const SceneDraw& draw : scene.draws) {
      const Material& material = scene.materials.at(draw.material);
      if ((material.alpha_mode == AlphaMode::mask) != is_masked) continue;
      if (&material != current) set_material(scene, material, pass);
      current = &material;
      const bool culls = use != DrawnFor::shadow && !material.double_sided;
      (culls ? glEnable : glDisable)(GL_CULL_FACE);
      glFrontFace(draw.is_mirrored ? GL_CW : GL_CCW);
      (draw.has_texcoords ? glEnableVertexArrayAttrib : glDisableVertexArrayAttrib)(scene.vertex_array.name(),
                                                                                    constant("ATTRIBUTE_TEXCOORD"));
      draw_instances(draw);
    }
  }
}

}  // namespace umbrameter
