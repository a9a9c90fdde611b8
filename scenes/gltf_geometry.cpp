#include "scenes/gltf_geometry.h"

#include <tiny_gltf.h>

#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace umbrameter::gltf {
namespace {

struct Dropped {
  std::uint64_t zero_area = 0;
  std::uint64_t points_and_lines = 0;
  std::uint64_t bad_normals = 0;
  bool vertex_colors = false;
};

bool is_drawn(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// glTF 2.0, section 3.7.2.1.
std::vector<uvec3> assemble(const std::vector<std::uint32_t>& v, int mode, const std::filesystem::path& path,
                            const std::string& object) {
  std::vector<uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (v.size() % 3 != 0) fail(path, object, "its " + std::to_string(v.size()) + " corners are no whole triangles");
    triangles.reserve(v.size() / 3);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
    } else {
      triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    }
  }
  return triangles;
}

dvec3 area_vector(const Mesh& mesh, const uvec3& t) {
  const dvec3 a(mesh.positions[t.x]);
  return glm::cross(dvec3(mesh.positions[t.y]) - a, dvec3(mesh.positions[t.z]) - a);
}

template <class Vector>
std::vector<Vector> grouped(const std::vector<float>& values) {
  constexpr auto length = static_cast<std::size_t>(Vector::length());
  std::vector<Vector> vectors(values.size() / length);
  for (std::size_t i = 0; i < values.size(); ++i) {
    vectors[i / length][static_cast<int>(i % length)] = values[i];
  }
  return vectors;
}

void require_finite(const std::vector<float>& values, std::size_t components, const char* what,
                    const std::filesystem::path& path, const std::string& object) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    fail(path, object, std::string(what) + " " + std::to_string(i / components) + " is not a finite number",
         "repair the model and export it again");
  }
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

struct Reader {
  BufferStore& store;
  Scene& scene;
  Dropped dropped;
  std::optional<std::uint32_t> default_material;

  const Document& document() const { return *store.document; }

  std::uint32_t material_of(const tinygltf::Primitive& primitive, const std::string& object) {
    const std::size_t count = document().model->materials.size();
    if (primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < count) {
      return static_cast<std::uint32_t>(primitive.material);
    }
    if (primitive.material != -1) {
      fail(document().path, object,
           "it refers to material " + std::to_string(primitive.material) + ", but the file has " +
               std::to_string(count));
    }
    if (!default_material) {
      default_material = static_cast<std::uint32_t>(scene.materials.size());
      scene.materials.emplace_back();
    }
    return *default_material;
  }

  std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, std::size_t vertices,
                                        const std::string& object) {
    if (primitive.indices < 0) {
      std::vector<std::uint32_t> all(vertices);
      std::iota(all.begin(), all.end(), 0u);
      return all;
    }
    std::vector<std::uint32_t> corners = read_indices(store, primitive.indices, object);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] < vertices) continue;
      fail(document().path, object,
           "index " + std::to_string(i) + " (accessor " + std::to_string(primitive.indices) + ") names vertex " +
               std::to_string(corners[i]) + " of " + std::to_string(vertices));
    }
    return corners;
  }

  template <class Vector>
  std::vector<Vector> attribute(const tinygltf::Primitive& primitive, const std::string& name, std::size_t vertices,
                                const std::string& object) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return {};
    auto values = read_floats(store, found->second, static_cast<std::size_t>(Vector::length()), object + " " + name);
    auto vectors = grouped<Vector>(values);
    if (name != "NORMAL")
      require_finite(values, static_cast<std::size_t>(Vector::length()), name.c_str(), document().path, object);
    if (vertices != 0 && vectors.size() != vertices) {
      fail(document().path, object,
           name + " has " + std::to_string(vectors.size()) + " values for " + std::to_string(vertices) + " vertices");
    }
    return vectors;
  }

  Mesh read(const tinygltf::Primitive& primitive, const std::string& object) {
    if (!primitive.attributes.contains("POSITION")) fail(document().path, object, "it has no POSITION");
    Mesh mesh;
    mesh.material = material_of(primitive, object);
    mesh.positions = attribute<vec3>(primitive, "POSITION", 0, object);
    if (mesh.positions.size() >= std::numeric_limits<std::uint32_t>::max()) {
      fail(document().path, object, "it has " + std::to_string(mesh.positions.size()) + " vertices",
           "split the mesh below 2^32 vertices");
    }
    mesh.normals = attribute<vec3>(primitive, "NORMAL", mesh.positions.size(), object);
    const auto& materials = document().model->materials;
    const int set =
        mesh.material < materials.size() ? materials[mesh.material].pbrMetallicRoughness.baseColorTexture.texCoord : 0;
    mesh.texcoords = attribute<vec2>(primitive, "TEXCOORD_" + std::to_string(set), mesh.positions.size(), object);
    mesh.triangles =
        assemble(corners_of(primitive, mesh.positions.size(), object), primitive.mode, document().path, object);
    dropped.zero_area +=
        std::erase_if(mesh.triangles, [&](const uvec3& t) { return area_vector(mesh, t) == dvec3(0.0); });
    dropped.vertex_colors |= primitive.attributes.contains("COLOR_0");
    repair_normals(mesh, dropped);
    return mesh;
  }
};

std::string name_of(const tinygltf::Primitive& primitive, const std::string& mesh_name) {
  const bool named = primitive.extras.IsObject() && primitive.extras.Has("name");
  return named && primitive.extras.Get("name").IsString() ? primitive.extras.Get("name").Get<std::string>() : mesh_name;
}

void note(const Dropped& dropped, std::vector<std::string>& notes) {
  const auto add = [&](std::uint64_t number, const std::string& text) {
    if (number != 0) notes.push_back(std::to_string(number) + text);
  };
  add(dropped.zero_area, " triangles without area were left out");
  add(dropped.points_and_lines, " primitives of points or lines were left out");
  add(dropped.bad_normals, " vertex normals without a direction were replaced by that of a triangle");
  if (dropped.vertex_colors) notes.emplace_back("vertex colours are not used");
}

}  // namespace

Geometry read_geometry(BufferStore& store, Scene& scene) {
  const tinygltf::Model& model = *store.document->model;
  Reader reader{store, scene, {}, std::nullopt};
  Geometry geometry;
  using Key = std::tuple<std::map<std::string, int>, int, int, int, std::string>;
  std::map<Key, std::optional<std::uint32_t>> known;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const tinygltf::Mesh& source = model.meshes[m];
    geometry.names.push_back(source.name);
    std::vector<std::uint32_t>& parts = geometry.meshes_of.emplace_back();
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = source.primitives[p];
      const std::string object = "mesh " + std::to_string(m) + (source.name.empty() ? "" : " '" + source.name + "'") +
                                 " primitive " + std::to_string(p);
      const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
      if (!is_drawn(mode)) {
        ++reader.dropped.points_and_lines;
        continue;
      }
      const std::string name = name_of(primitive, source.name);
      const auto [entry, is_new] =
          known.try_emplace(Key{primitive.attributes, primitive.indices, primitive.material, mode, name});
      if (is_new) {
        Mesh mesh = reader.read(primitive, object);
        mesh.name = name;
        if (!mesh.triangles.empty()) {
          entry->second = static_cast<std::uint32_t>(scene.meshes.size());
          scene.meshes.push_back(std::move(mesh));
        }
      }
      if (entry->second) parts.push_back(*entry->second);
    }
  }
  note(reader.dropped, scene.notes);
  return geometry;
}

}  // namespace umbrameter::gltf
