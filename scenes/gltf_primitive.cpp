// One glTF primitive to one Mesh: vertices plain or compressed, morph targets, triangles.
#include <tiny_gltf.h>

#include <cmath>
#include <numeric>

#include "scenes/flat_normals.h"
#include "scenes/gltf_draco.h"
#include "scenes/gltf_geometry.h"

namespace umbrameter::gltf {
namespace {

constexpr const char* draco_name = "KHR_draco_mesh_compression";

// glTF 2.0, section 3.7.2.1: corners that make no whole triangle are ignored.
std::vector<uvec3> assemble(const std::vector<std::uint32_t>& v, int mode, Dropped& dropped) {
  std::vector<uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (v.size() % 3 != 0) ++dropped.incomplete_triangles;
    triangles.reserve(v.size() / 3);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
    return triangles;
  }
  if (v.size() > 2) triangles.reserve(v.size() - 2);
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
    } else {
      triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    }
  }
  return triangles;
}

// A normal that is no direction takes that of the first triangle at its vertex.
void repair_normals(Mesh& mesh, Dropped& dropped) {
  constexpr float tolerance = 1e-3f;
  std::vector<std::uint8_t> bad(mesh.normals.size(), 0);
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    vec3& normal = mesh.normals[i];
    const float length = glm::length(normal);
    if (std::abs(length - 1.0f) <= tolerance) continue;
    if (std::isfinite(length) && length > 1e-6f) {
      normal /= length;
      continue;
    }
    normal = vec3(0, 1, 0);
    bad[i] = 1;
    ++found;
  }
  if (found == 0) return;
  dropped.bad_normals += found;
  for (const uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = triangle[corner];
      if (bad[vertex] == 0) continue;
      mesh.normals[vertex] = vec3(glm::normalize(area_vector(mesh, triangle)));
      bad[vertex] = 0;
    }
  }
}

// They move a texture, never the surface: those that are no numbers need not refuse the file.
void repair_texcoords(Mesh& mesh, Dropped& dropped) {
  for (vec2& texcoord : mesh.texcoords) {
    if (std::isfinite(texcoord.x) && std::isfinite(texcoord.y)) continue;
    texcoord = vec2(0.0f);
    ++dropped.bad_texcoords;
  }
}

void require_finite(const std::vector<vec3>& positions, const std::filesystem::path& path, const std::string& object) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const vec3& p = positions[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    fail(path, object, "POSITION " + std::to_string(i) + " is not a finite number",
         "repair the model and export it again");
  }
}

/// Where the vertices of one primitive come from.
struct PrimitiveSource {
  GeometryReader& reader;
  const tinygltf::Primitive& primitive;
  const std::string& object;
  std::string texcoord_name;
  std::optional<DracoMesh> draco;

  const Document& document() const { return reader.store.document; }

  /// How many sets of joints and weights it has.
  int skin_sets() const {
    int sets = 0;
    while (primitive.attributes.contains("JOINTS_" + std::to_string(sets)) &&
           primitive.attributes.contains("WEIGHTS_" + std::to_string(sets))) {
      ++sets;
    }
    return sets;
  }

  void open_draco(bool with_skin) {
    const auto extension = primitive.extensions.find(draco_name);
    if (extension == primitive.extensions.end()) return;
    const tinygltf::Value& value = extension->second;
    const bool is_whole = value.Has("bufferView") && value.Get("bufferView").IsInt() && value.Has("attributes") &&
                          value.Get("attributes").IsObject();
    if (!is_whole) fail(document().path, object, std::string(draco_name) + " has no bufferView or no attributes");
    const tinygltf::Value& ids = value.Get("attributes");
    std::map<std::string, DracoAttribute> wanted;
    const auto want = [&](const std::string& name, std::size_t components) {
      if (ids.Has(name)) wanted[name] = {ids.Get(name).GetNumberAsInt(), components};
    };
    want("POSITION", 3);
    want("NORMAL", 3);
    want(texcoord_name, 2);
    for (int set = with_skin ? skin_sets() : 0; set-- > 0;) {
      want("JOINTS_" + std::to_string(set), 4);
      want("WEIGHTS_" + std::to_string(set), 4);
    }
    draco = decode_draco(view_bytes(reader.store, value.Get("bufferView").GetNumberAsInt(), object), wanted,
                         reader.store.allowance, document().path, object);
  }

  template <class Vector>
  std::vector<Vector> attribute(const std::string& name, std::size_t vertices) {
    std::vector<Vector> values;
    if (draco && draco->attributes.contains(name)) {
      const std::vector<float>& floats = draco->attributes[name];
      values.resize(draco->vertices);
      for (std::size_t i = 0; i < floats.size(); ++i) {
        values[i / Vector::length()][static_cast<int>(i % Vector::length())] = floats[i];
      }
    } else {
      const auto found = primitive.attributes.find(name);
      if (found == primitive.attributes.end()) return {};
      values = read_elements<Vector>(reader.store, found->second, object + " " + name);
    }
    if (vertices != 0 && values.size() != vertices) {
      fail(document().path, object,
           name + " has " + std::to_string(values.size()) + " values for " + std::to_string(vertices) + " vertices");
    }
    return values;
  }

  std::vector<uvec3> triangles(std::size_t vertices) {
    if (draco) {
      for (const uvec3& t : draco->triangles) {
        if (t.x < vertices && t.y < vertices && t.z < vertices) continue;
        fail(document().path, object,
             "its Draco data names a vertex beyond the " + std::to_string(vertices) + " that it has",
             "copy or export the file again");
      }
      return std::move(draco->triangles);
    }
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
      corners.resize(vertices);
      std::iota(corners.begin(), corners.end(), 0u);
    } else {
      corners = read_indices(reader.store, primitive.indices, object);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] < vertices) continue;
      fail(document().path, object,
           "index " + std::to_string(i) + " (accessor " + std::to_string(primitive.indices) + ") names vertex " +
               std::to_string(corners[i]) + " of " + std::to_string(vertices));
    }
    claim(reader.store.allowance, std::uint64_t{corners.size()} * sizeof(uvec3), document().path, object);
    return assemble(corners, mode, reader.dropped);
  }
};

// glTF 2.0, section 3.7.2.2: each target adds its weight times its displacements.
void add_morph_targets(GeometryReader& reader, const tinygltf::Primitive& primitive, std::span<const double> weights,
                       const std::string& object, Mesh& mesh) {
  const auto add = [&](std::size_t target, const std::string& name, std::vector<vec3>& values) {
    const auto found = primitive.targets[target].find(name);
    if (found == primitive.targets[target].end() || values.empty()) return;
    const std::string user = object + " target " + std::to_string(target) + " " + name;
    const std::vector<vec3> moves = read_elements<vec3>(reader.store, found->second, user);
    if (moves.size() != values.size()) {
      fail(reader.store.document.path, user,
           "it has " + std::to_string(moves.size()) + " values for " + std::to_string(values.size()) + " vertices");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = vec3(dvec3(values[i]) + weights[target] * dvec3(moves[i]));
    }
  };
  reader.dropped.morphs |= !primitive.targets.empty();
  for (std::size_t target = 0; target < primitive.targets.size() && target < weights.size(); ++target) {
    if (weights[target] == 0.0) continue;
    add(target, "POSITION", mesh.positions);
    add(target, "NORMAL", mesh.normals);
  }
}

std::uint32_t material_of(GeometryReader& reader, const tinygltf::Primitive& primitive, const std::string& object) {
  if (primitive.material != -1) {
    return static_cast<std::uint32_t>(
        checked_index(primitive.material, reader.textures.size(), "material", reader.store.document.path, object));
  }
  if (!reader.default_material) {
    reader.default_material = static_cast<std::uint32_t>(reader.scene.materials.size());
    reader.scene.materials.emplace_back().metallic = 1.0f;  // glTF 2.0, section 3.7.2.1: the default material
  }
  return *reader.default_material;
}

}  // namespace

void drop_flat_triangles(Mesh& mesh, Dropped& dropped) {
  dropped.zero_area +=
      std::erase_if(mesh.triangles, [&](const uvec3& t) { return area_vector(mesh, t) == dvec3(0.0); });
}

Mesh read_primitive(GeometryReader& reader, const tinygltf::Primitive& primitive, std::span<const double> weights,
                    const std::string& object, SkinAttributes* skin) {
  const std::filesystem::path& path = reader.store.document.path;
  Mesh mesh;
  mesh.material = material_of(reader, primitive, object);
  const bool is_own = mesh.material < reader.textures.size();
  const TexcoordUse texcoords = is_own ? texcoords_of(reader.textures[mesh.material]) : TexcoordUse{};
  PrimitiveSource source{reader, primitive, object, "TEXCOORD_" + std::to_string(texcoords.set), std::nullopt};
  source.open_draco(skin != nullptr);
  mesh.positions = source.attribute<vec3>("POSITION", 0);
  if (mesh.positions.empty()) {
    ++reader.dropped.without_positions;
    return mesh;
  }
  if (mesh.positions.size() >= std::numeric_limits<std::uint32_t>::max()) {
    fail(path, object, "it has " + std::to_string(mesh.positions.size()) + " vertices",
         "split the mesh below 2^32 vertices");
  }
  const std::size_t vertices = mesh.positions.size();
  mesh.normals = source.attribute<vec3>("NORMAL", vertices);
  mesh.texcoords = source.attribute<vec2>(source.texcoord_name, vertices);
  for (int set = 0; skin != nullptr && set < source.skin_sets(); ++set) {
    skin->joints.push_back(source.attribute<vec4>("JOINTS_" + std::to_string(set), vertices));
    skin->weights.push_back(source.attribute<vec4>("WEIGHTS_" + std::to_string(set), vertices));
  }
  mesh.triangles = source.triangles(vertices);
  add_morph_targets(reader, primitive, weights, object, mesh);
  require_finite(mesh.positions, path, object);
  if (texcoords.is_moved) {
    for (vec2& texcoord : mesh.texcoords) texcoord = moved(texcoords, texcoord);
  }
  repair_texcoords(mesh, reader.dropped);
  drop_flat_triangles(mesh, reader.dropped);
  reader.dropped.vertex_colors |= primitive.attributes.contains("COLOR_0");
  repair_normals(mesh, reader.dropped);
  return mesh;
}

}  // namespace umbrameter::gltf
