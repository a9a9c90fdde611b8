#include "scenes/gltf_geometry.h"

#include <tiny_gltf.h>

#include <cmath>

namespace umbrameter::gltf {
namespace {

bool is_drawn(const tinygltf::Primitive& primitive, const std::filesystem::path& path, const std::string& object) {
  const int mode = primitive.mode;
  if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
    fail(path, object, "there is no mode " + std::to_string(mode) + " in glTF 2.0");
  return mode < 0 || mode >= TINYGLTF_MODE_TRIANGLES;
}

std::string name_of(const tinygltf::Primitive& primitive, const std::string& mesh_name) {
  const bool named = primitive.extras.IsObject() && primitive.extras.Has("name");
  return named && primitive.extras.Get("name").IsString() ? primitive.extras.Get("name").Get<std::string>() : mesh_name;
}

std::string name_primitive(const tinygltf::Mesh& mesh, std::size_t mesh_index, std::size_t index) {
  return label("mesh", mesh_index, mesh.name) + " primitive " + std::to_string(index);
}

std::span<const double> weights_of(const tinygltf::Mesh& mesh, std::span<const double> node_weights) {
  return node_weights.empty() ? std::span<const double>(mesh.weights) : node_weights;
}

dmat4 matrix_of(const SkinAttributes& skin, std::size_t vertex, std::span<const dmat4> joint_matrices) {
  dmat4 sum(0.0);
  double total = 0.0;
  for (std::size_t set = 0; set < skin.joints.size(); ++set) {
    for (int i = 0; i < 4; ++i) {
      const double weight = skin.weights[set][vertex][i];
      if (!(weight > 0.0)) continue;
      sum += weight * joint_matrices[static_cast<std::size_t>(skin.joints[set][vertex][i])];
      total += weight;
    }
  }
  // Quantised weights need not add up to one.
  return total > 0.0 ? sum / total : joint_matrices.front();
}

void check_skin(const SkinAttributes& skin, std::size_t joints, const std::filesystem::path& path,
                const std::string& object) {
  for (std::size_t set = 0; set < skin.joints.size(); ++set) {
    for (std::size_t v = 0; v < skin.joints[set].size(); ++v) {
      const std::string place = std::to_string(set) + " " + std::to_string(v);
      for (int i = 0; i < 4; ++i) {
        const float used = skin.joints[set][v][i];
        const float weight = skin.weights[set][v][i];
        if (!std::isfinite(weight)) fail(path, object, "WEIGHTS_" + place + " is not a finite number");
        const bool is_unused = !(weight > 0.0f);
        if (is_unused || (used >= 0.0f && used < static_cast<float>(joints))) continue;
        fail(path, object, "JOINTS_" + place + " names a joint beyond the skin's " + std::to_string(joints));
      }
    }
  }
}

void move_vertices(Mesh& mesh, const SkinAttributes& skin, std::span<const dmat4> joint_matrices) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const dmat4 matrix = matrix_of(skin, v, joint_matrices);
    mesh.positions[v] = vec3(matrix * dvec4(dvec3(mesh.positions[v]), 1.0));
    if (mesh.normals.empty()) continue;
    const dvec3 normal = glm::transpose(glm::inverse(dmat3(matrix))) * dvec3(mesh.normals[v]);
    const double length = glm::length(normal);
    if (length > 0.0 && std::isfinite(length)) mesh.normals[v] = vec3(normal / length);
  }
}

// The index of a new Scene mesh, where the primitive has triangles.
std::optional<std::uint32_t> read_part(GeometryReader& reader, const tinygltf::Primitive& primitive,
                                       std::span<const double> weights, const std::string& name,
                                       const std::string& object) {
  if (!is_drawn(primitive, reader.store.document.path, object)) {
    ++reader.dropped.points_and_lines;
    return std::nullopt;
  }
  Mesh mesh = read_primitive(reader, primitive, weights, object);
  if (mesh.triangles.empty()) return std::nullopt;
  mesh.name = name;
  reader.scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(reader.scene.meshes.size() - 1);
}

}  // namespace

std::vector<std::uint32_t> read_mesh(GeometryReader& reader, std::size_t number, std::span<const double> node_weights) {
  const tinygltf::Mesh& source = reader.store.document.model->meshes[number];
  const std::span<const double> weights = weights_of(source, node_weights);
  std::vector<std::uint32_t> parts;
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    const std::string name = name_of(primitive, source.name);
    const auto draco = primitive.extensions.find("KHR_draco_mesh_compression");
    const int compressed = draco != primitive.extensions.end() && draco->second.Has("bufferView")
                               ? draco->second.Get("bufferView").GetNumberAsInt()
                               : -1;
    const std::vector<double> used_weights =
        primitive.targets.empty() ? std::vector<double>() : std::vector<double>(weights.begin(), weights.end());
    const GeometryReader::Key key{
        primitive.attributes, primitive.indices, primitive.material, primitive.mode, compressed, used_weights, name};
    auto entry = reader.known.find(key);
    if (entry == reader.known.end()) {
      const auto read = read_part(reader, primitive, weights, name, name_primitive(source, number, p));
      entry = reader.known.emplace(key, read).first;
    }
    if (entry->second) parts.push_back(*entry->second);
  }
  return parts;
}

std::vector<std::uint32_t> read_skinned_mesh(GeometryReader& reader, std::size_t number,
                                             std::span<const double> node_weights,
                                             std::span<const dmat4> joint_matrices, const std::string& node) {
  const tinygltf::Mesh& source = reader.store.document.model->meshes[number];
  std::vector<std::uint32_t> parts;
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    const std::string object = name_primitive(source, number, p);
    if (!is_drawn(primitive, reader.store.document.path, object)) {
      ++reader.dropped.points_and_lines;
      continue;
    }
    SkinAttributes skin;
    Mesh mesh = read_primitive(reader, primitive, weights_of(source, node_weights), object, &skin);
    if (mesh.positions.empty()) continue;
    if (skin.joints.empty())
      fail(reader.store.document.path, object, "it has no JOINTS_0 and WEIGHTS_0, but " + node + " has a skin");
    check_skin(skin, joint_matrices.size(), reader.store.document.path, object);
    move_vertices(mesh, skin, joint_matrices);
    for (const vec3& position : mesh.positions) {
      if (std::isfinite(position.x + position.y + position.z)) continue;
      fail(reader.store.document.path, object, "the skin of " + node + " moves a vertex to infinity");
    }
    drop_flat_triangles(mesh, reader.dropped);
    mesh.name = name_of(primitive, source.name);
    if (mesh.triangles.empty()) continue;
    parts.push_back(static_cast<std::uint32_t>(reader.scene.meshes.size()));
    reader.scene.meshes.push_back(std::move(mesh));
  }
  return parts;
}

void note_dropped(const Dropped& dropped, std::vector<std::string>& notes) {
  const auto add = [&](std::uint64_t number, const std::string& text) {
    if (number != 0) notes.push_back(std::to_string(number) + text);
  };
  add(dropped.zero_area, " triangles without area were left out");
  add(dropped.points_and_lines, " primitives of points or lines were left out");
  add(dropped.without_positions, " primitives without POSITION were left out");
  add(dropped.incomplete_triangles, " primitives end in an incomplete triangle, which was left out");
  add(dropped.bad_texcoords, " texture coordinates that are not finite were replaced by 0");
  add(dropped.bad_normals, " vertex normals without a direction were replaced by that of a triangle");
  if (dropped.vertex_colors) notes.emplace_back("vertex colours are not used");
  if (dropped.morphs) notes.emplace_back("morph targets keep their default weights: animations have no effect");
}

}  // namespace umbrameter::gltf
