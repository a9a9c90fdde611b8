#include "raster/uploaded_scene.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"

namespace umbrameter {
namespace {

// As InstanceData in shaders/scene.glsl, layout std430.
struct InstanceData {
  dvec4 rows[3];
  std::uint32_t first_index = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t flags = 0;
  std::uint32_t unused[5] = {};
};
static_assert(sizeof(InstanceData) == 128);

struct MeshRange {
  std::uint32_t first_index = 0;
  std::uint32_t first_vertex = 0;
};

struct MergedMeshes {
  std::vector<vec3> positions;
  std::vector<vec3> normals;
  std::vector<vec2> texcoords;
  std::vector<uvec3> triangles;
  std::vector<MeshRange> ranges;
};

template <class T>
void append(std::vector<T>& all, const std::vector<T>& some, std::size_t count) {
  assert(some.empty() || some.size() == count);
  all.insert(all.end(), some.begin(), some.end());
  if (some.empty()) all.resize(all.size() + count, T(0));
}

MergedMeshes merge(const Scene& scene) {
  MergedMeshes merged;
  for (const Mesh& mesh : scene.meshes) {
    merged.ranges.push_back(
        {static_cast<std::uint32_t>(3 * merged.triangles.size()), static_cast<std::uint32_t>(merged.positions.size())});
    append(merged.positions, mesh.positions, mesh.positions.size());
    append(merged.normals, mesh.normals, mesh.positions.size());
    append(merged.texcoords, mesh.texcoords, mesh.positions.size());
    append(merged.triangles, mesh.triangles, mesh.triangles.size());
  }
  return merged;
}

std::vector<InstanceData> instance_data(const Scene& scene, const MergedMeshes& merged) {
  std::vector<InstanceData> all;
  all.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    InstanceData& data = all.emplace_back();
    for (int row = 0; row < 3; ++row) data.rows[row] = glm::transpose(instance.world_from_mesh)[row];
    const MeshRange& range = merged.ranges.at(instance.mesh);
    data.first_index = range.first_index;
    data.first_vertex = range.first_vertex;
    data.flags = scene.meshes[instance.mesh].normals.empty() ? 0 : slot("FLAG_HAS_NORMALS");
  }
  return all;
}

std::vector<SceneDraw> list_draws(const Scene& scene, const MergedMeshes& merged) {
  std::vector<SceneDraw> draws;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const bool is_mirrored_here = is_mirrored(instance.world_from_mesh);
    if (i > 0 && scene.instances[i - 1].mesh == instance.mesh && draws.back().is_mirrored == is_mirrored_here) {
      ++draws.back().instance_count;
      continue;
    }
    const Mesh& mesh = scene.meshes[instance.mesh];
    const MeshRange& range = merged.ranges[instance.mesh];
    draws.push_back({mesh.material, range.first_index, static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                     range.first_vertex, i, 1, is_mirrored_here});
  }
  return draws;
}

template <class T>
gl::Buffer upload_buffer(const gl::Context& context, const char* label, const std::vector<T>& values) {
  const std::size_t bytes = values.size() * sizeof(T);
  if (bytes > context.max_storage_bytes()) {
    throw Error(ExitCode::no_backend, std::string("scene's ") + label,
                std::to_string(bytes >> 20) + " MiB do not fit the " +
                    std::to_string(context.max_storage_bytes() >> 20) + " MiB that a buffer may have on " +
                    context.device().renderer,
                "use a GPU with --gl-device or a smaller scene");
  }
  return gl::make_buffer(std::string("scene ") + label, std::span<const T>(values));
}

gl::Texture upload_texture(const gl::Context& context, const Texture& texture) {
  const Image<glm::u8vec4>& texels = texture.texels;
  if (texels.empty()) return {};
  if (std::max(texels.width, texels.height) > context.max_texture_size()) {
    throw Error(ExitCode::no_backend, "texture '" + texture.name + "'",
                std::to_string(texels.width) + "x" + std::to_string(texels.height) + " is more than the " +
                    std::to_string(context.max_texture_size()) + " texels a side of " + context.device().renderer,
                "use a smaller texture");
  }
  gl::Texture uploaded = gl::make_texture("base color " + texture.name, gl::Format::rgba8, texels.width, texels.height);
  gl::write_texels(uploaded, gl::Format::rgba8, texels.width, texels.height,
                   std::as_bytes(std::span<const glm::u8vec4>(texels.pixels)));
  return uploaded;
}

void set_material(const UploadedScene& scene, const Material& material, const gl::Program& program) {
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

}  // namespace

UploadedScene upload(const gl::Context& context, const Scene& scene) {
  const MergedMeshes merged = merge(scene);
  UploadedScene uploaded;
  uploaded.positions = upload_buffer(context, "positions", merged.positions);
  uploaded.normals = upload_buffer(context, "normals", merged.normals);
  uploaded.texcoords = upload_buffer(context, "texture coordinates", merged.texcoords);
  uploaded.indices = upload_buffer(context, "indices", merged.triangles);
  uploaded.instances = upload_buffer(context, "instances", instance_data(scene, merged));
  uploaded.draws = list_draws(scene, merged);
  uploaded.materials = scene.materials;
  for (const Texture& texture : scene.textures) {
    uploaded.textures.push_back(upload_texture(context, texture));
    uploaded.texture_modes.push_back({texture.name, {}, texture.wrap_u, texture.wrap_v});
  }

  uploaded.vertex_array = gl::make_vertex_array("scene vertices");
  const unsigned array = uploaded.vertex_array.name();
  const auto attribute = [array](unsigned location, const gl::Buffer& buffer, int components) {
    const auto stride = static_cast<int>(static_cast<std::size_t>(components) * sizeof(float));
    glVertexArrayVertexBuffer(array, location, buffer.name(), 0, stride);
    glVertexArrayAttribFormat(array, location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, location, location);
    glEnableVertexArrayAttrib(array, location);
  };
  attribute(slot("ATTRIBUTE_POSITION"), uploaded.positions, 3);
  attribute(slot("ATTRIBUTE_TEXCOORD"), uploaded.texcoords, 2);
  glVertexArrayElementBuffer(array, uploaded.indices.name());
  context.check("upload of the scene");
  return uploaded;
}

SceneBytes bytes_when_uploaded(const Scene& scene) {
  const SceneCounts counts = count(scene);
  SceneBytes bytes = bytes_in_memory(scene);
  // Every mesh gets normals and texture coordinates, zeros where it has none.
  bytes.vertices = counts.vertices * (2 * sizeof(vec3) + sizeof(vec2));
  bytes.instances = scene.instances.size() * sizeof(InstanceData);
  return bytes;
}

void bind_triangles(const UploadedScene& scene) {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_INSTANCES"), scene.instances.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_POSITIONS"), scene.positions.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot("BUFFER_INDICES"), scene.indices.name());
}

void draw_scene(const UploadedScene& scene, DrawnFor use, const gl::Program& opaque, const gl::Program& masked) {
  bind_triangles(scene);
  glBindVertexArray(scene.vertex_array.name());
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
      // Setting a uniform that a program lacks is an error on some drivers.
      if (is_masked || use == DrawnFor::camera) set_material(scene, material, program);
      glProgramUniform1ui(program.name(), location("UNIFORM_FIRST_INSTANCE"), draw.first_instance);
      if (is_masked) glProgramUniform1f(program.name(), location("UNIFORM_ALPHA_CUTOFF"), material.alpha_cutoff);
      glDrawElementsInstancedBaseVertex(
          GL_TRIANGLES, static_cast<GLsizei>(draw.index_count), GL_UNSIGNED_INT,
          reinterpret_cast<const void*>(std::uintptr_t{draw.first_index} * sizeof(std::uint32_t)),
          static_cast<GLsizei>(draw.instance_count), static_cast<GLint>(draw.first_vertex));
    }
  }
}

}  // namespace umbrameter
