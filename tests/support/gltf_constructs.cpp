#include "tests/support/gltf_constructs.h"

#include <charconv>
#include <cmath>
#include <fstream>

#include "scenes/gltf.h"

namespace umbrameter::test {
namespace {

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

Scene load(const Construct& construct, const std::filesystem::path& folder) {
  for (const auto& [name, bytes] : construct.side_files) write(folder / name, bytes);
  write(folder / construct.file_name, construct.file);
  return load_gltf(folder / construct.file_name, construct.part, construct.options);
}

std::vector<Construct> all_constructs() {
  std::vector<Construct> all;
  for (const auto family : {topology_constructs, accessor_constructs, quantized_constructs, draco_constructs,
                            meshopt_constructs, material_constructs, mask_constructs, node_constructs,
                            instancing_constructs, deformed_constructs, file_constructs, tolerated_constructs}) {
    for (Construct& construct : family()) all.push_back(std::move(construct));
  }
  return all;
}

Solid solid() {
  return {{{0, 0, 0},
           {2, 0, 0},
           {0, 1, 0},
           {0, 0, 0.5},
           {2.5, 0, 0.25},
           {3.5, 0, 0.25},
           {3.5, 1.5, 0.25},
           {2.5, 1.5, 0.25}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
}

Solid split_solid() {
  const Solid shared = solid();
  Solid split;
  for (const uvec3& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(split.corners.size());
    for (int i = 0; i < 3; ++i) split.corners.push_back(shared.corners[t[i]]);
    split.triangles.emplace_back(first, first + 1, first + 2);
  }
  return split;
}

std::vector<dvec3> flat_normals(const Solid& split) {
  std::vector<dvec3> normals(split.corners.size());
  for (const uvec3& t : split.triangles) {
    const dvec3 a = split.corners[t.x];
    const dvec3 normal = glm::normalize(glm::cross(split.corners[t.y] - a, split.corners[t.z] - a));
    for (int i = 0; i < 3; ++i) normals[t[i]] = normal;
  }
  return normals;
}

std::vector<Triangle> placed(const Solid& solid, const dmat4& world_from_mesh) {
  std::vector<Triangle> triangles;
  const bool is_mirrored = glm::determinant(dmat3(world_from_mesh)) < 0.0;
  for (const uvec3& t : solid.triangles) {
    const auto corner = [&](std::uint32_t i) { return dvec3(world_from_mesh * dvec4(solid.corners[i], 1.0)); };
    triangles.push_back({corner(t.x), corner(is_mirrored ? t.z : t.y), corner(is_mirrored ? t.y : t.z)});
  }
  return triangles;
}

std::vector<float> floats(const std::vector<dvec3>& points) {
  std::vector<float> values;
  for (const dvec3& point : points) {
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(point[i]));
  }
  return values;
}

std::string text_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string list_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(text_of(value));
  return std::string("[").append(join(texts)).append("]");
}

std::string list_of(const dmat4& matrix) {
  std::vector<double> values;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) values.push_back(matrix[column][row]);
  }
  return list_of(values);
}

dmat4 translation(const dvec3& offset) {
  dmat4 matrix(1.0);
  matrix[3] = dvec4(offset, 1.0);
  return matrix;
}

dmat4 scaling(const dvec3& factors) {
  dmat4 matrix(1.0);
  for (int i = 0; i < 3; ++i) matrix[i][i] = factors[i];
  return matrix;
}

// Rodrigues' formula: the columns are the turned axes.
dmat4 rotation(const dvec3& axis, double angle) {
  const dvec3 k = glm::normalize(axis);
  dmat4 matrix(1.0);
  for (int i = 0; i < 3; ++i) {
    dvec3 v(0.0);
    v[i] = 1.0;
    matrix[i] = dvec4(
        v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) + k * glm::dot(k, v) * (1.0 - std::cos(angle)), 0.0);
  }
  return matrix;
}

std::string quaternion(const dvec3& axis, double angle) {
  const dvec3 v = glm::normalize(axis) * std::sin(0.5 * angle);
  return list_of({v.x, v.y, v.z, std::cos(0.5 * angle)});
}

int add_mesh(GltfBuilder& builder, const std::string& attributes, int indices, const std::string& more) {
  return add(builder, "meshes",
             R"({"primitives":[{"attributes":{)" + attributes + "}" +
                 (indices < 0 ? "" : ",\"indices\":" + std::to_string(indices)) + more + "}]}");
}

int add_solid(GltfBuilder& builder, const std::string& more) {
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  const int indices = add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid()));
  return add_mesh(builder, "\"POSITION\":" + std::to_string(positions), indices, more);
}

void use(GltfBuilder& builder, const std::string& extension, bool is_required) {
  builder.extensions_used.push_back(extension);
  if (is_required) builder.extensions_required.push_back(extension);
}

Construct finished(const std::string& name, GltfBuilder& builder, std::vector<Triangle> triangles) {
  if (builder.lists["nodes"].empty()) add(builder, "nodes", R"({"mesh":0})");
  if (builder.lists["scenes"].empty()) {
    add(builder, "scenes", R"({"nodes":[0]})");
    builder.more += R"(,"scene":0)";
  }
  Construct construct;
  construct.name = name;
  construct.file = to_binary_gltf(builder);
  construct.triangles = std::move(triangles);
  return construct;
}

}  // namespace umbrameter::test
