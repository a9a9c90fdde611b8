// A scene's triangles, textures and transforms in GPU memory: merged buffers, instances stay instances.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "scenes/memory.h"
#include "scenes/scene.h"

namespace umbrameter {

/// Neighbouring instances of one mesh, drawn together.
struct SceneDraw {
  std::uint32_t material = 0;
  std::uint32_t first_index = 0;   ///< in the merged index buffer
  std::uint32_t index_count = 0;   ///< three a triangle
  std::uint32_t first_vertex = 0;  ///< added to each index
  std::uint32_t first_instance = 0;
  std::uint32_t instance_count = 0;
  bool is_mirrored = false;
};

/// Copies what it needs: the Scene may go. Belongs to the context that it was uploaded to.
struct UploadedScene {
  gl::Buffer positions;  ///< three floats a vertex, mesh space
  gl::Buffer normals;    ///< three floats a vertex, zero where the mesh has none
  gl::Buffer texcoords;  ///< two floats a vertex, zero where the mesh has none
  gl::Buffer indices;    ///< three unsigned a triangle, counted from the mesh's first vertex
  gl::Buffer instances;  ///< raster/shaders/scene.glsl, InstanceData
  gl::VertexArray vertex_array;
  std::vector<gl::Texture> textures;  ///< as in Scene::textures
  std::vector<Material> materials;
  std::vector<Texture> texture_modes;  ///< wrap modes only, without texels
  std::vector<SceneDraw> draws;
};

/// Throws Error (no_backend) when a buffer or texture is larger than the device allows.
UploadedScene upload(const gl::Context& context, const Scene& scene);

/// Bytes of the buffers and textures that upload() makes of the scene; what a driver adds is not in it.
SceneBytes bytes_when_uploaded(const Scene& scene);

/// camera: back faces of single-sided materials are left out, and all programs read base_color.glsl;
/// shadow: every face, and only the masked program reads it.
enum class DrawnFor : int { camera, shadow };

/// Draws every instance with the state that the caller has set: opaque materials with one program, alpha-masked ones
/// with the other. Both are made of shaders that include scene.glsl.
void draw_scene(const UploadedScene& scene, DrawnFor use, const gl::Program& opaque, const gl::Program& masked);

/// Binds the buffers that scene.glsl reads.
void bind_triangles(const UploadedScene& scene);

}  // namespace umbrameter
