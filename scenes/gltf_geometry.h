// glTF meshes to Scene meshes. Internal to scenes/gltf*.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/gltf_materials.h"
#include "scenes/scene.h"

namespace tinygltf {
struct Primitive;
}

namespace umbrameter::gltf {

/// What was left out, counted over the file.
struct Dropped {
  std::uint64_t zero_area = 0;
  std::uint64_t points_and_lines = 0;
  std::uint64_t bad_normals = 0;
  std::uint64_t bad_texcoords = 0;
  std::uint64_t without_positions = 0;     ///< primitives
  std::uint64_t incomplete_triangles = 0;  ///< primitives whose corners are no multiple of three
  bool vertex_colors = false;
  bool morphs = false;
};

/// Turns primitives into Scene meshes when they are asked for; equal ones are stored once.
struct GeometryReader {
  BufferStore& store;
  Scene& scene;
  std::vector<TextureReferences> textures;  ///< one a material of the file
  std::optional<std::uint32_t> default_material;
  Dropped dropped;
  using Key = std::tuple<std::map<std::string, int>, int, int, int, int, std::vector<double>, std::string>;
  std::map<Key, std::optional<std::uint32_t>> known;
};

/// The Scene meshes of a glTF mesh, one a primitive that has triangles. `node_weights` are the morph weights of the
/// node, which come before those of the mesh.
std::vector<std::uint32_t> read_mesh(GeometryReader& reader, std::size_t mesh, std::span<const double> node_weights);

/// A skinned node's own meshes, in world space: each vertex moved by the weighted sum of its joint matrices
/// (glTF 2.0, section 3.7.3.3).
std::vector<std::uint32_t> read_skinned_mesh(GeometryReader& reader, std::size_t mesh,
                                             std::span<const double> node_weights,
                                             std::span<const dmat4> joint_matrices, const std::string& node);

/// Erases triangles without area, and counts them.
void drop_flat_triangles(Mesh& mesh, Dropped& dropped);

/// One line for each kind of thing that was dropped.
void note_dropped(const Dropped& dropped, std::vector<std::string>& notes);

/// Joints and weights of a primitive's vertices: for each set four of each a vertex, as stored.
struct SkinAttributes {
  std::vector<std::vector<vec4>> joints;
  std::vector<std::vector<vec4>> weights;
};

/// The primitive's mesh, without name; and its skin, where that is wanted.
Mesh read_primitive(GeometryReader& reader, const tinygltf::Primitive& primitive, std::span<const double> weights,
                    const std::string& object, SkinAttributes* skin = nullptr);

}  // namespace umbrameter::gltf
