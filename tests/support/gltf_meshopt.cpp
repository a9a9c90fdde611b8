// Files with EXT_meshopt_compression, encoded here.
#include <meshoptimizer.h>

#include <algorithm>
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

// Both names are of one length, so that the file's own lengths stay true.
Construct under_ratified_name(Construct construct) {
  const std::string old_name = "EXT_meshopt_compression";
  const std::string new_name = "KHR_meshopt_compression";
  auto at = construct.file.begin();
  while ((at = std::search(at, construct.file.end(), old_name.begin(), old_name.end())) != construct.file.end()) {
    std::copy(new_name.begin(), new_name.end(), at);
  }
  return construct;
}

// The vertex codec of version 1, as the text of KHR_meshopt_compression gives it (appendix A, "Mode 0: attributes").
// It is no good at compressing: byte positions take the control modes in turn, and groups the widths.
struct VertexEncoder1 {
  std::size_t stride = 0;
  std::vector<unsigned char> channel_modes;  ///< one for each four bytes
  Bytes out{0xa1};

  static unsigned to_zigzag(unsigned value, unsigned bits) {
    const unsigned mask = (1u << bits) - 1u;
    return ((value >> (bits - 1u)) & 1u) != 0 ? ~(value << 1u) & mask : (value << 1u) & mask;
  }

  // Coded differences of one channel of two elements.
  static void code(unsigned mode, const unsigned char* last, const unsigned char* next, unsigned char* coded) {
    if (mode % 16 == 0) {
      for (int i = 0; i < 4; ++i) {
        coded[i] = static_cast<unsigned char>(to_zigzag(static_cast<unsigned char>(next[i] - last[i]), 8));
      }
      return;
    }
    if (mode % 16 == 1) {
      for (int i = 0; i < 4; i += 2) {
        std::uint16_t a = 0;
        std::uint16_t b = 0;
        std::memcpy(&a, last + i, 2);
        std::memcpy(&b, next + i, 2);
        const auto zigzag = static_cast<std::uint16_t>(to_zigzag(static_cast<std::uint16_t>(b - a), 16));
        std::memcpy(coded + i, &zigzag, 2);
      }
      return;
    }
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::memcpy(&a, last, 4);
    std::memcpy(&b, next, 4);
    const unsigned turn = mode / 16;
    const std::uint32_t difference = a ^ b;
    const std::uint32_t turned = (difference << turn) | (difference >> ((32u - turn) & 31u));
    std::memcpy(coded, &turned, 4);
  }

  void put_group(const unsigned char* deltas, unsigned bits) {
    if (bits == 8) {
      out.insert(out.end(), deltas, deltas + 16);
      return;
    }
    const unsigned sentinel = (1u << bits) - 1u;
    Bytes packed(2 * bits, 0);
    Bytes escaped;
    for (unsigned i = 0; i < 16; ++i) {
      const unsigned place = i * bits % 8;
      const unsigned held = std::min<unsigned>(deltas[i], sentinel);
      packed[i * bits / 8] |= static_cast<unsigned char>(held << (bits == 1 ? place : 8 - bits - place));
      if (held == sentinel) escaped.push_back(deltas[i]);
    }
    out.insert(out.end(), packed.begin(), packed.end());
    out.insert(out.end(), escaped.begin(), escaped.end());
  }

  void put_bytes(const Bytes& deltas, std::size_t elements, unsigned control) {
    if (control == 2) return;
    if (control == 3) {
      out.insert(out.end(), deltas.begin(), deltas.begin() + static_cast<std::ptrdiff_t>(elements));
      return;
    }
    const std::size_t groups = deltas.size() / 16;
    const unsigned widths[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
    const auto mode_of = [&](std::size_t group) { return control == 0 ? 1 + group % 3 : group % 4; };
    Bytes header((groups + 3) / 4, 0);
    for (std::size_t group = 0; group < groups; ++group) {
      header[group / 4] |= static_cast<unsigned char>(mode_of(group) << (2 * (group % 4)));
    }
    out.insert(out.end(), header.begin(), header.end());
    for (std::size_t group = 0; group < groups; ++group)
      put_group(&deltas[16 * group], widths[control][mode_of(group)]);
  }

  Bytes encode(const Bytes& elements) {
    const std::size_t count = elements.size() / stride;
    const std::size_t most = std::min<std::size_t>(8192 / stride / 16 * 16, 256);
    const unsigned char* last = elements.data();
    for (std::size_t first = 0; first < count; first += most) {
      const std::size_t size = std::min(most, count - first);
      std::vector<Bytes> deltas(stride, Bytes((size + 15) / 16 * 16, 0));
      for (std::size_t i = 0; i < size; ++i) {
        const unsigned char* next = &elements[(first + i) * stride];
        for (std::size_t at = 0; at < stride; at += 4) {
          unsigned char coded[4];
          code(channel_modes[at / 4], last + at, next + at, coded);
          for (std::size_t k = 0; k < 4; ++k) deltas[at + k][i] = coded[k];
        }
        last = next;
      }
      std::vector<unsigned> controls(stride);
      Bytes packed(stride / 4, 0);
      for (std::size_t at = 0; at < stride; ++at) {
        const bool is_zero = std::all_of(deltas[at].begin(), deltas[at].end(), [](unsigned char d) { return d == 0; });
        controls[at] = is_zero ? 2 : at % 4 == 2 ? 3 : at % 2;
        packed[at / 4] |= static_cast<unsigned char>(controls[at] << (2 * (at % 4)));
      }
      out.insert(out.end(), packed.begin(), packed.end());
      for (std::size_t at = 0; at < stride; ++at) put_bytes(deltas[at], size, controls[at]);
    }
    Bytes tail(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(stride));
    tail.insert(tail.end(), channel_modes.begin(), channel_modes.end());
    if (tail.size() < 24) tail.insert(tail.begin(), 24 - tail.size(), 0);
    out.insert(out.end(), tail.begin(), tail.end());
    return out;
  }
};

// 300 vertices, which are two blocks, of which the solid uses the last eight.
Construct version_1(const std::string& name, const std::vector<unsigned char>& channel_modes) {
  GltfBuilder builder;
  add_fallback(builder);
  constexpr std::uint32_t unused = 292;
  std::vector<float> positions;
  for (std::uint32_t i = 0; i < 3 * unused; ++i) positions.push_back(static_cast<float>((i * i) % 97) * 0.01f);
  for (const float value : floats(solid().corners)) positions.push_back(value);
  const Bytes encoded = VertexEncoder1{12, channel_modes}.encode(raw_bytes(positions));
  const int view = add_compressed(builder, encoded, unused + 8, 12, "ATTRIBUTES", "");
  std::vector<std::uint16_t> indices = indices_of<std::uint16_t>(solid());
  for (std::uint16_t& index : indices) index = static_cast<std::uint16_t>(index + unused);
  const int accessor = add_accessor(builder, view, "f32", "VEC3", unused + 8);
  add_mesh(builder, "\"POSITION\":" + std::to_string(accessor), add_values(builder, "SCALAR", indices));
  return under_ratified_name(finished("meshopt of version 1 with " + name, builder, placed(solid())));
}

}  // namespace

std::vector<Construct> meshopt_constructs() {
  return {under_ratified_name(compressed("meshopt under its ratified name", "TRIANGLES", 2)),
          compressed("meshopt with 16-bit triangles", "TRIANGLES", 2),
          compressed("meshopt with 32-bit triangles", "TRIANGLES", 4),
          compressed("meshopt with a sequence of 16-bit indices", "INDICES", 2),
          compressed("meshopt with a sequence of 32-bit indices", "INDICES", 4),
          octahedral<std::int8_t>("meshopt with the octahedral filter on bytes"),
          octahedral<std::int16_t>("meshopt with the octahedral filter on shorts"),
          exponential(),
          quaternions(),
          version_1("byte deltas", {0, 0, 0}),
          version_1("short deltas", {1, 1, 1}),
          version_1("exclusive or and rotation", {2, 0x52, 0xf2}),
          version_1("all kinds of deltas", {0, 1, 0x92})};
}

}  // namespace umbrameter::test
