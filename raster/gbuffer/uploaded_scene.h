// A scene's triangles, textures and transforms in GPU memory: merged buffers, instances stay instances.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "raster/gl/context.h"
#include "raster/gl/objects.h"
#include "raster/gl/pass.h"
#include "scenes/memory.h"
#include "scenes/scene.h"

namespace umbrameter {

/// All instances of one mesh that turn its front faces the same way, drawn together.
struct SceneDraw {
  std::uint32_t material = 0;
  std::uint32_t first_triangle = 0;  ///< in the buffer of triangles
  std::uint32_t triangle_count = 0;
  std::uint32_t first_vertex = 0;    ///< added to each index
  std::uint32_t first_instance = 0;  ///< in UploadedScene::drawn_instances
  std::uint32_t instance_count = 0;
  bool is_mirrored = false;
  bool has_texcoords = false;
};

/// Copies what it needs: the Scene may go. Belongs to the context that it was uploaded to.
struct UploadedScene {
  gl::Buffer positions;        ///< three floats a vertex, mesh space
  gl::Buffer normals;          ///< three floats a vertex, of the meshes that have them
  gl::Buffer texcoords;        ///< two floats a vertex, of the meshes whose textures need them: the first vertices
  gl::Buffer triangles;        ///< three unsigned a triangle, counted from the mesh's first vertex
  gl::Buffer instances;        ///< raster/shaders/scene.glsl, InstanceData
  gl::Buffer drawn_instances;  ///< indices into Scene::instances, in the order in which they are drawn
  gl::Texture position_texels;
  gl::Texture normal_texels;
  gl::Texture triangle_texels;
  gl::VertexArray vertex_array;
  std::vector<gl::Texture> textures;  ///< as in Scene::textures
  std::vector<Material> materials;
  std::vector<Texture> texture_modes;  ///< wrap modes only, without texels
  std::vector<SceneDraw> draws;
};

/// Throws Error (no_backend) when a buffer or texture is larger than the device allows.
/// Throws Error when the user interrupts; draw_scene() too.
UploadedScene upload(const gl::Context& context, const Scene& scene);

/// Bytes of the buffers and textures that upload() makes of the scene; what a driver adds is not in it.
SceneBytes bytes_when_uploaded(const Scene& scene);

/// camera: back faces of single-sided materials are left out; shadow: every face; shadow_of_front_faces and
/// shadow_of_back_faces: of single-sided materials only these.
enum class DrawnFor : int { camera, shadow, shadow_of_front_faces, shadow_of_back_faces };

/// A pass that draws opaque or alpha-masked materials. Its shaders include scene.glsl and may include material.glsl.
using MakePass = std::function<gl::Pass(bool is_masked)>;

/// Draws every instance with the state that the caller has set.
void draw_scene(const UploadedScene& scene, DrawnFor use, const MakePass& make_pass);

/// Binds the buffers and textures that scene.glsl reads, and the normals.
gl::Pass& bind_triangles(gl::Pass& pass, const UploadedScene& scene);

}  // namespace umbrameter
