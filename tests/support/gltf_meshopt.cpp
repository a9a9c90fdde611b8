// Files with EXT_meshopt_compression, encoded here.
#include <meshoptimizer.h>

#include <cmath>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

/// The compressed view that decodes to count elements of `stride` bytes; buffer 1 is the fallback without bytes.
int add_compressed(GltfBuilder& builder, const Bytes& encoded, std::size_t count, std::size_t stride,
                   const std::string& mode, const std::string& filter = "") {
  const std::size_t offset = add_bytes(builder, encoded);
  const std::string shape = ",\"byteStride\":" + std::to_string(stride);
  const std::string length = std::to_string(count * stride);
  return add(builder, "bufferViews",
             R"({"buffer":1,"byteLength":)" + length + (mode == "ATTRIBUTES" ? shape : "") +
                 R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + std::to_string(offset) +
                 R"(,"byteLength":)" + std::to_string(encoded.size()) + shape + R"(,"count":)" + std::to_string(count) +
                 R"(,"mode":")" + mode + "\"" + (filter.empty() ? "" : R"(,"filter":")" + filter + "\"") + "}}}");
}

void add_fallback(GltfBuilder& builder) {
  use(builder, "EXT_meshopt_compression", true);
  add(builder, "buffers", R"({"byteLength":65536,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})");
}

template <class T>
Bytes encode_attributes(const std::vector<T>& values, std::size_t count, std::size_t stride) {
  Bytes encoded(meshopt_encodeVertexBufferBound(count, stride));
  encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), values.data(), count, stride));
  return encoded;
}

Bytes encode_triangles(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  meshopt_encodeIndexVersion(1);
  Bytes encoded(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), indices.size()));
  return encoded;
}

Bytes encode_sequence(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  meshopt_encodeIndexVersion(1);
  Bytes encoded(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  encoded.resize(meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), indices.size()));
  return encoded;
}

int add_positions(GltfBuilder& builder, const Solid& from) {
  const std::vector<float> values = floats(from.corners);
  const int view = add_compressed(builder, encode_attributes(values, from.corners.size(), 12), from.corners.size(), 12,
                                  "ATTRIBUTES");
  return add_accessor(builder, view, "f32", "VEC3", from.corners.size());
}

Construct compressed(const std::string& name, const std::string& mode, std::size_t index_size) {
  GltfBuilder builder;
  add_fallback(builder);
  const int positions = add_positions(builder, solid());
  const std::vector<std::uint32_t> all = indices_of<std::uint32_t>(solid());
  const Bytes encoded = mode == "TRIANGLES" ? encode_triangles(all, 8) : encode_sequence(all, 8);
  const int indices = add_accessor(builder, add_compressed(builder, encoded, all.size(), index_size, mode),
                                   index_size == 2 ? "u16" : "u32", "SCALAR", all.size());
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions), indices);
  return finished(name, builder, placed(solid()));
}

template <class T>
Construct octahedral(const std::string& name) {
  GltfBuilder builder;
  add_fallback(builder);
  use(builder, "KHR_mesh_quantization", true);
  const Solid split = split_solid();
  const std::size_t count = split.corners.size();
  const int positions = add_positions(builder, split);
  std::vector<float> normals;
  for (const dvec3& normal : flat_normals(split)) {
    for (int i = 0; i < 3; ++i) normals.push_back(static_cast<float>(normal[i]));
    normals.push_back(0.0f);
  }
  std::vector<T> filtered(4 * count);
  meshopt_encodeFilterOct(filtered.data(), count, 4 * sizeof(T), 8 * sizeof(T), normals.data());
  const int view = add_compressed(builder, encode_attributes(filtered, count, 4 * sizeof(T)), count, 4 * sizeof(T),
                                  "ATTRIBUTES", "OCTAHEDRAL");
  const int accessor = add_accessor(builder, view, component_name<T>(), "VEC3", count, ",\"normalized\":true");
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + ",\"NORMAL\":" + std::to_string(accessor));
  Construct construct = finished(name, builder, placed(split));
  construct.flat_normals = true;
  construct.normal_tolerance = sizeof(T) == 1 ? 0.02 : 1e-3;
  return construct;
}

// EXT_meshopt_compression, "Exponential filter": the upper 8 bits are the exponent e, the lower 24 the integer m of
// m · 2^e, both signed. Coordinates are multiples of 1/4: e = −2 holds them exactly. (The library's own encoder changed
// its arguments between versions.)
Construct exponential() {
  GltfBuilder builder;
  add_fallback(builder);
  std::vector<std::uint32_t> filtered;
  for (const float value : floats(solid().corners)) {
    const auto mantissa = static_cast<std::uint32_t>(static_cast<std::int32_t>(value * 4.0f));
    filtered.push_back((0xFEu << 24u) | (mantissa & 0xFFFFFFu));
  }
  const int view = add_compressed(builder, encode_attributes(filtered, 8, 12), 8, 12, "ATTRIBUTES", "EXPONENTIAL");
  const int positions = add_accessor(builder, view, "f32", "VEC3", 8);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  return finished("meshopt with the exponential filter", builder, placed(solid()));
}

// Rotations of instances: turns of 0.3, 1.7 and -2.5 radians about three axes.
Construct quaternions() {
  GltfBuilder builder;
  add_fallback(builder);
  use(builder, "EXT_mesh_gpu_instancing", true);
  const std::vector<std::pair<dvec3, double>> turns = {{{0, 1, 0}, 0.3}, {{1, 1, 0}, 1.7}, {{-1, 0.5, 2}, -2.5}};
  std::vector<float> values;
  std::vector<Triangle> triangles;
  for (const auto& [axis, angle] : turns) {
    const dvec3 v = glm::normalize(axis) * std::sin(0.5 * angle);
    for (const double part : {v.x, v.y, v.z, std::cos(0.5 * angle)}) values.push_back(static_cast<float>(part));
    for (const Triangle& triangle : placed(solid(), rotation(axis, angle))) triangles.push_back(triangle);
  }
  std::vector<std::int16_t> filtered(12);
  meshopt_encodeFilterQuat(filtered.data(), 3, 8, 16, values.data());
  const int view = add_compressed(builder, encode_attributes(filtered, 3, 8), 3, 8, "ATTRIBUTES", "QUATERNION");
  const int accessor = add_accessor(builder, view, "i16", "VEC4", 3, ",\"normalized\":true");
  const int positions = add_positions(builder, solid());
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  add(builder, "nodes",
      R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"ROTATION":)" + std::to_string(accessor) +
          "}}}}");
  Construct construct = finished("meshopt with the quaternion filter", builder, std::move(triangles));
  construct.tolerance = 1e-3;
  return construct;
}

}  // namespace

std::vector<Construct> meshopt_constructs() {
  return {compressed("meshopt with 16-bit triangles", "TRIANGLES", 2),
          compressed("meshopt with 32-bit triangles", "TRIANGLES", 4),
          compressed("meshopt with a sequence of 16-bit indices", "INDICES", 2),
          compressed("meshopt with a sequence of 32-bit indices", "INDICES", 4),
          octahedral<std::int8_t>("meshopt with the octahedral filter on bytes"),
          octahedral<std::int16_t>("meshopt with the octahedral filter on shorts"),
          exponential(),
          quaternions()};
}

}  // namespace umbrameter::test
