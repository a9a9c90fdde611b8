#include "raster/gbuffer/uploaded_scene.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "core/error.h"
#include "core/gbuffer.h"
#include "core/interrupt.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

// As InstanceData in shaders/scene.glsl, layout std430.
struct InstanceData {
  dvec4 rows[3];
  std::uint32_t first_triangle = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t first_normal = no_id;
  std::uint32_t unused[5] = {};
};
static_assert(sizeof(InstanceData) == 128);

// Where a mesh stands in the buffers.
struct MeshRange {
  std::size_t first_triangle = 0;
  std::size_t first_vertex = 0;
  std::size_t first_normal = 0;
  bool has_texcoords = false;  // then they start at first_vertex, too
};

struct Layout {
  std::vector<MeshRange> meshes;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t normals = 0;
  std::size_t texcoords = 0;
};

bool needs_texcoords(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials.at(mesh.material);
  return !mesh.texcoords.empty() &&
         std::ranges::any_of(texture_members, [&](auto member) { return (material.*member).has_value(); });
}

Layout lay_out(const Scene& scene) {
  Layout layout;
  layout.meshes.resize(scene.meshes.size());
  // Meshes with texture coordinates come first, so that one number finds both in buffers of different lengths.
  for (const bool has_texcoords : {true, false}) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      assert(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
      if (needs_texcoords(scene, mesh) != has_texcoords) continue;
      layout.meshes[m] = {layout.triangles, layout.vertices, layout.normals, has_texcoords};
      layout.triangles += mesh.triangles.size();
      layout.vertices += mesh.positions.size();
      layout.normals += mesh.normals.size();
    }
    if (has_texcoords) layout.texcoords = layout.vertices;
  }
  return layout;
}

void require_room(const gl::Context& context, const std::string& what, std::size_t count, std::size_t most,
                  const char* unit) {
  if (count <= most) return;
  throw Error(ExitCode::no_backend, "scene's " + what,
              std::to_string(count) + " " + unit + " do not fit the " + std::to_string(most) +
                  " that a buffer may have on " + context.device().renderer,
              "use a GPU with --gl-device or a smaller scene");
}

void allocate(const gl::Context& context, const Layout& layout, UploadedScene& uploaded) {
  // Shaders count texels in signed numbers.
  const std::size_t most = std::min<std::size_t>(context.max_buffer_texels(), std::numeric_limits<int>::max());
  require_room(context, "positions", layout.vertices, most, "vertices");
  require_room(context, "triangles", layout.triangles, most, "triangles");
  uploaded.positions = gl::make_empty_buffer("scene positions", layout.vertices * sizeof(vec3));
  uploaded.normals = gl::make_empty_buffer("scene normals", layout.normals * sizeof(vec3));
  uploaded.texcoords = gl::make_empty_buffer("scene texture coordinates", layout.texcoords * sizeof(vec2));
  uploaded.triangles = gl::make_empty_buffer("scene triangles", layout.triangles * sizeof(uvec3));
  context.check("memory for the scene");
  uploaded.position_texels = gl::make_buffer_texture("scene positions", gl::Format::rgb32f, uploaded.positions);
  uploaded.normal_texels = gl::make_buffer_texture("scene normals", gl::Format::rgb32f, uploaded.normals);
  uploaded.triangle_texels = gl::make_buffer_texture("scene triangles", gl::Format::rgb32ui, uploaded.triangles);
}

template <class T>
void write(const gl::Buffer& buffer, std::size_t first, const std::vector<T>& values) {
  gl::write_buffer(buffer, first * sizeof(T), std::as_bytes(std::span<const T>(values)));
}

void write_meshes(const Scene& scene, const Layout& layout, const UploadedScene& uploaded) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    throw_if_interrupted();
    const Mesh& mesh = scene.meshes[m];
    const MeshRange& range = layout.meshes[m];
    write(uploaded.positions, range.first_vertex, mesh.positions);
    write(uploaded.normals, range.first_normal, mesh.normals);
    write(uploaded.triangles, range.first_triangle, mesh.triangles);
    if (!range.has_texcoords) continue;
    assert(mesh.texcoords.size() == mesh.positions.size());
    write(uploaded.texcoords, range.first_vertex, mesh.texcoords);
  }
}

gl::Buffer upload_instances(const gl::Context& context, const Scene& scene, const Layout& layout) {
  require_room(context, "instances", scene.instances.size(), context.max_storage_bytes() / sizeof(InstanceData),
               "instances");
  std::vector<InstanceData> all;
  all.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    InstanceData& data = all.emplace_back();
    for (int row = 0; row < 3; ++row) data.rows[row] = glm::transpose(instance.world_from_mesh)[row];
    const MeshRange& range = layout.meshes.at(instance.mesh);
    data.first_triangle = static_cast<std::uint32_t>(range.first_triangle);
    data.first_vertex = static_cast<std::uint32_t>(range.first_vertex);
    if (!scene.meshes[instance.mesh].normals.empty()) {
      data.first_normal = static_cast<std::uint32_t>(range.first_normal);
    }
  }
  return gl::make_buffer("scene instances", std::span<const InstanceData>(all));
}

// Draws in the order in which their first instances come, and the instances of each in the scene's order.
void list_draws(const Scene& scene, const Layout& layout, UploadedScene& uploaded) {
  std::vector<std::array<std::uint32_t, 2>> draw_of(scene.meshes.size(), {no_id, no_id});
  std::vector<std::uint32_t> draws(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const bool is_mirrored_here = is_mirrored(instance.world_from_mesh);
    std::uint32_t& draw = draw_of[instance.mesh][is_mirrored_here ? 1 : 0];
    if (draw == no_id) {
      draw = static_cast<std::uint32_t>(uploaded.draws.size());
      const Mesh& mesh = scene.meshes[instance.mesh];
      const MeshRange& range = layout.meshes[instance.mesh];
      uploaded.draws.push_back({mesh.material, static_cast<std::uint32_t>(range.first_triangle),
                                static_cast<std::uint32_t>(mesh.triangles.size()),
                                static_cast<std::uint32_t>(range.first_vertex), 0, 0, is_mirrored_here,
                                range.has_texcoords});
    }
    draws[i] = draw;
    ++uploaded.draws[draw].instance_count;
  }
  std::uint32_t first = 0;
  for (SceneDraw& draw : uploaded.draws) {
    draw.first_instance = first;
    first += draw.instance_count;
    draw.instance_count = 0;
  }
  std::vector<std::uint32_t> order(scene.instances.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    SceneDraw& draw = uploaded.draws[draws[i]];
    order[draw.first_instance + draw.instance_count++] = i;
  }
  uploaded.drawn_instances = gl::make_buffer("scene drawn instances", std::span<const std::uint32_t>(order));
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
  gl::Texture uploaded = gl::make_texture("texture " + texture.name, gl::Format::rgba8, texels.width, texels.height);
  gl::write_texels(uploaded, gl::Format::rgba8, texels.width, texels.height,
                   std::as_bytes(std::span<const glm::u8vec4>(texels.pixels)));
  return uploaded;
}

gl::VertexArray describe_vertices(const UploadedScene& uploaded) {
  gl::VertexArray vertices = gl::make_vertex_array("scene vertices");
  const unsigned array = vertices.name();
  const auto bind = [array](unsigned location, const gl::Buffer& buffer, std::size_t stride) {
    glVertexArrayVertexBuffer(array, location, buffer.name(), 0, static_cast<GLsizei>(stride));
    glVertexArrayAttribBinding(array, location, location);
    glEnableVertexArrayAttrib(array, location);
  };
  bind(constant("ATTRIBUTE_POSITION"), uploaded.positions, sizeof(vec3));
  glVertexArrayAttribFormat(array, constant("ATTRIBUTE_POSITION"), 3, GL_FLOAT, GL_FALSE, 0);
  bind(constant("ATTRIBUTE_TEXCOORD"), uploaded.texcoords, sizeof(vec2));
  glVertexArrayAttribFormat(array, constant("ATTRIBUTE_TEXCOORD"), 2, GL_FLOAT, GL_FALSE, 0);
  bind(constant("ATTRIBUTE_INSTANCE"), uploaded.drawn_instances, sizeof(std::uint32_t));
  glVertexArrayAttribIFormat(array, constant("ATTRIBUTE_INSTANCE"), 1, GL_UNSIGNED_INT, 0);
  glVertexArrayBindingDivisor(array, constant("ATTRIBUTE_INSTANCE"), 1);
  glVertexArrayElementBuffer(array, uploaded.triangles.name());
  return vertices;
}

}  // namespace

UploadedScene upload(const gl::Context& context, const Scene& scene) {
  const Layout layout = lay_out(scene);
  UploadedScene uploaded;
  allocate(context, layout, uploaded);
  write_meshes(scene, layout, uploaded);
  uploaded.instances = upload_instances(context, scene, layout);
  list_draws(scene, layout, uploaded);
  uploaded.vertex_array = describe_vertices(uploaded);
  uploaded.materials = scene.materials;
  for (const Texture& texture : scene.textures) {
    uploaded.textures.push_back(upload_texture(context, texture));
    uploaded.texture_modes.push_back({texture.name, {}, texture.wrap_u, texture.wrap_v});
  }
  context.check("upload of the scene");
  return uploaded;
}

SceneBytes bytes_when_uploaded(const Scene& scene) {
  const Layout layout = lay_out(scene);
  SceneBytes bytes = bytes_in_memory(scene);
  bytes.vertices = (layout.vertices + layout.normals) * sizeof(vec3) + layout.texcoords * sizeof(vec2);
  bytes.instances = scene.instances.size() * (sizeof(InstanceData) + sizeof(std::uint32_t));
  return bytes;
}

}  // namespace umbrameter
