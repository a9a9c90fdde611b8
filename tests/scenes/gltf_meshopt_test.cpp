#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstdlib>

#include "gltf_files.h"

namespace umbrameter {
namespace {

using test::append;
using test::Bytes;
using test::expect_unreadable;
using test::glb;
using test::load;
using test::TemporaryFolder;

constexpr unsigned side = 9;
constexpr unsigned vertices = side * side;

vec3 position(unsigned i) {
  const float x = static_cast<float>(i % side);
  const float y = static_cast<float>(i / side);
  return {x, y, 0.25f * x * y};
}

std::vector<unsigned> grid_indices() {
  std::vector<unsigned> indices;
  for (unsigned y = 0; y + 1 < side; ++y) {
    for (unsigned x = 0; x + 1 < side; ++x) {
      const unsigned i = y * side + x;
      indices.insert(indices.end(), {i, i + 1, i + side, i + side, i + 1, i + side + 1});
    }
  }
  return indices;
}

Bytes encoded_vertices(const void* data, std::size_t stride) {
  Bytes bytes(meshopt_encodeVertexBufferBound(vertices, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, vertices, stride));
  return bytes;
}

Bytes encoded_indices(bool as_triangles) {
  const std::vector<unsigned> indices = grid_indices();
  Bytes bytes(as_triangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                           : meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  bytes.resize(as_triangles ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size())
                            : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

/// Puts compressed views into one file whose second buffer is the fallback without bytes.
struct CompressedFile {
  Bytes binary;
  std::string views;
  std::size_t fallback_size = 0;

  void add(const Bytes& encoded, std::size_t count, std::size_t stride, const std::string& mode,
           const std::string& filter = "NONE") {
    const auto text = [](std::size_t value) { return std::to_string(value); };
    const std::string declared = mode == "ATTRIBUTES" ? R"(,"byteStride":)" + text(stride) : "";
    views += std::string(views.empty() ? "" : ",") + R"({"buffer":1,"byteOffset":)" + text(fallback_size) +
             R"(,"byteLength":)" + text(count * stride) + declared +
             R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + text(binary.size()) +
             R"(,"byteLength":)" + text(encoded.size()) + R"(,"byteStride":)" + text(stride) + R"(,"count":)" +
             text(count) + R"(,"mode":")" + mode + R"(","filter":")" + filter + R"("}}})";
    binary.insert(binary.end(), encoded.begin(), encoded.end());
    binary.resize((binary.size() + 3) / 4 * 4);
    fallback_size += (count * stride + 3) / 4 * 4;
  }
  Bytes with(const std::string& accessors, const std::string& primitive) const {
    return glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression","KHR_mesh_quantization"],)"
               R"("buffers":[{"byteLength":)" +
                   std::to_string(binary.size()) + R"(},{"byteLength":)" + std::to_string(fallback_size) +
                   R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[)" + views +
                   R"(],"accessors":[)" + accessors + R"(],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
                   primitive + "]}]}",
               binary);
  }
};

const std::string position_accessor = R"({"bufferView":0,"componentType":5126,"count":81,"type":"VEC3"})";
const std::string index_accessor = R"(,{"bufferView":1,"componentType":5123,"count":384,"type":"SCALAR"})";
const std::string indexed_primitive = R"({"attributes":{"POSITION":0},"indices":1})";

std::vector<vec3> grid_positions() {
  std::vector<vec3> positions;
  for (unsigned i = 0; i < vertices; ++i) positions.push_back(position(i));
  return positions;
}

CompressedFile grid_file(bool as_triangles) {
  CompressedFile file;
  file.add(encoded_vertices(grid_positions().data(), 12), vertices, 12, "ATTRIBUTES");
  file.add(encoded_indices(as_triangles), grid_indices().size(), 2, as_triangles ? "TRIANGLES" : "INDICES");
  return file;
}

TEST(Meshopt, Both_index_modes_give_the_vertices_and_triangles_that_went_in) {
  for (const bool as_triangles : {true, false}) {
    const TemporaryFolder folder;
    const Mesh mesh =
        load(folder, grid_file(as_triangles).with(position_accessor + index_accessor, indexed_primitive)).meshes.at(0);
    EXPECT_EQ(mesh.positions, grid_positions());
    const std::vector<unsigned> indices = grid_indices();
    ASSERT_EQ(mesh.triangles.size() * 3, indices.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      // The triangle codec may rotate the corners of a triangle, never turn it round.
      const uvec3 t = mesh.triangles[i];
      const uvec3 wanted(indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]);
      EXPECT_TRUE(t == wanted || uvec3(t.y, t.z, t.x) == wanted || uvec3(t.z, t.x, t.y) == wanted) << i;
    }
  }
}

TEST(Meshopt, The_exponential_filter_gives_floats_to_its_precision) {
  std::vector<std::uint32_t> packed(std::size_t{3} * vertices);
  const std::vector<vec3> positions = grid_positions();
#if MESHOPTIMIZER_VERSION >= 190
  meshopt_encodeFilterExp(packed.data(), vertices, 12, 20, &positions[0].x, meshopt_EncodeExpSharedVector);
#else
  meshopt_encodeFilterExp(packed.data(), vertices, 12, 20, &positions[0].x);
#endif
  CompressedFile file;
  file.add(encoded_vertices(packed.data(), 12), vertices, 12, "ATTRIBUTES", "EXPONENTIAL");
  file.add(encoded_indices(true), grid_indices().size(), 2, "TRIANGLES");
  const TemporaryFolder folder;
  const Mesh mesh = load(folder, file.with(position_accessor + index_accessor, indexed_primitive)).meshes.at(0);
  for (unsigned i = 0; i < vertices; ++i) EXPECT_NEAR(glm::distance(mesh.positions[i], position(i)), 0.0, 1e-4);
}

TEST(Meshopt, The_octahedral_filter_gives_unit_normals_to_its_precision) {
  std::vector<vec4> normals;
  for (unsigned i = 0; i < vertices; ++i) {
    normals.emplace_back(glm::normalize(vec3(std::cos(i), std::sin(i), 0.1f * static_cast<float>(i % 7) - 0.3f)), 0.0f);
  }
  Bytes packed(std::size_t{4} * vertices);
  meshopt_encodeFilterOct(packed.data(), vertices, 4, 8, &normals[0].x);
  CompressedFile file;
  file.add(encoded_vertices(grid_positions().data(), 12), vertices, 12, "ATTRIBUTES");
  file.add(encoded_indices(true), grid_indices().size(), 2, "TRIANGLES");
  file.add(encoded_vertices(packed.data(), 4), vertices, 4, "ATTRIBUTES", "OCTAHEDRAL");
  const TemporaryFolder folder;
  const std::string normal_accessor =
      R"(,{"bufferView":2,"componentType":5120,"normalized":true,"count":81,"type":"VEC3"})";
  const Mesh mesh = load(folder, file.with(position_accessor + index_accessor + normal_accessor,
                                           R"({"attributes":{"POSITION":0,"NORMAL":2},"indices":1})"))
                        .meshes.at(0);
  for (unsigned i = 0; i < vertices; ++i) {
    // Octahedral coordinates of 8 bits: half a step of 1/127, stretched by less than two.
    EXPECT_NEAR(glm::distance(mesh.normals[i], vec3(normals[i])), 0.0, 0.02);
    EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0, 1e-3);
  }
}

TEST(Meshopt, The_quaternion_filter_gives_unit_quaternions) {
  // Quaternions serve animations; their x and y are looked at as texture coordinates.
  std::vector<vec4> quaternions;
  for (unsigned i = 0; i < vertices; ++i) {
    const float half = 0.01f * static_cast<float>(i) + 0.1f;
    quaternions.emplace_back(std::sin(half), 0.0f, 0.0f, std::cos(half));
  }
  Bytes packed(std::size_t{8} * vertices);
  meshopt_encodeFilterQuat(packed.data(), vertices, 8, 16, &quaternions[0].x);
  CompressedFile file;
  file.add(encoded_vertices(packed.data(), 8), vertices, 8, "ATTRIBUTES", "QUATERNION");
  file.add(encoded_vertices(grid_positions().data(), 12), vertices, 12, "ATTRIBUTES");
  const TemporaryFolder folder;
  const Mesh mesh =
      load(folder, file.with(R"({"bufferView":1,"componentType":5126,"count":81,"type":"VEC3"},)"
                             R"({"bufferView":0,"componentType":5122,"normalized":true,"count":81,"type":"VEC2"})",
                             R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"mode":5})"))
          .meshes.at(0);
  for (unsigned i = 0; i < vertices; ++i) {
    // A quaternion and its negative are the same rotation.
    EXPECT_NEAR(std::abs(mesh.texcoords[i].x), std::sin(0.01 * i + 0.1), 1e-3);
    EXPECT_NEAR(mesh.texcoords[i].y, 0.0, 1e-3);
  }
}

TEST(Meshopt, Damaged_and_forged_views_are_refused) {
  const std::string accessors = position_accessor + index_accessor;
  const auto with = [&](const std::string& from, const std::string& to) {
    CompressedFile file = grid_file(true);
    const std::size_t at = file.views.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    file.views.replace(at, from.size(), to);
    return file.with(accessors, indexed_primitive);
  };
  expect_unreadable(with(R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTE")"), {"bufferView 0", "mode 'ATTRIBUTE'"});
  expect_unreadable(with(R"("filter":"NONE")", R"("filter":"SQUARE")"), {"bufferView 0", "filter 'SQUARE'"});
  expect_unreadable(with(R"("filter":"NONE")", R"("filter":"QUATERNION")"), {"bufferView 0", "byteStride 12"});
  expect_unreadable(with(R"("count":81)", R"("count":82)"), {"bufferView 0", "count * byteStride"});
  expect_unreadable(with(R"("extensions":{"EXT_meshopt_compression":{"buffer":0)",
                         R"("extensions":{"EXT_meshopt_compression":{"buffer":1)"),
                    {"buffer 1", "fallback without bytes"});
  CompressedFile damaged = grid_file(true);
  damaged.binary[0] ^= 0xffu;
  expect_unreadable(damaged.with(accessors, indexed_primitive), {"bufferView 0", "damaged"});
  CompressedFile forged;
  forged.add(Bytes(16), 100000000, 252, "ATTRIBUTES");
  expect_unreadable(forged.with(position_accessor, R"({"attributes":{"POSITION":0}})"),
                    {"bufferView 0", "does not fit"});
}

TEST(Meshopt, Every_flipped_byte_gives_an_error_or_a_scene) {
  const TemporaryFolder folder;
  const CompressedFile whole = grid_file(true);
  for (std::size_t i = 0; i < whole.binary.size(); ++i) {
    CompressedFile damaged = whole;
    damaged.binary[i] ^= static_cast<unsigned char>(1u << (i % 8));
    const auto path = folder.write("damaged.glb", damaged.with(position_accessor + index_accessor, indexed_primitive));
    try {
      load_gltf(path);
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::unreadable_input);
    }
  }
}

TEST(Meshopt, A_model_from_the_web_is_the_same_compressed_and_plain) {
  const char* folder = std::getenv("UMBRAMETER_ASSETS");
  if (folder == nullptr) GTEST_SKIP() << "UMBRAMETER_ASSETS names no folder with temple.glb and temple_meshopt.gltf";
  const Scene plain = load_gltf(std::filesystem::path(folder) / "temple.glb");
  const Scene compressed = load_gltf(std::filesystem::path(folder) / "temple_meshopt.gltf");
  ASSERT_EQ(plain.meshes.size(), 1u);
  ASSERT_EQ(compressed.meshes.size(), 1u);
  EXPECT_EQ(count(plain).triangles, 29696u);
  EXPECT_EQ(plain.meshes[0].positions, compressed.meshes[0].positions);
  EXPECT_EQ(plain.meshes[0].normals, compressed.meshes[0].normals);
  EXPECT_EQ(plain.meshes[0].texcoords, compressed.meshes[0].texcoords);
  EXPECT_EQ(plain.meshes[0].triangles, compressed.meshes[0].triangles);
  EXPECT_EQ(plain.lights.size(), 3u);
  EXPECT_EQ(plain.cameras.size(), 1u);
  EXPECT_TRUE(compressed.lights.empty());
  EXPECT_TRUE(compressed.cameras.empty());
}

}  // namespace
}  // namespace umbrameter
