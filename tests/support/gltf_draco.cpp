// Files with KHR_draco_mesh_compression, encoded here.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

constexpr int position_bits = 14;
constexpr double longest_side = 3.5;

/// 392 triangles over a sheet that rises from one corner, each with its own corners.
Solid hill() {
  constexpr int side = 14;
  Solid split;
  const auto at = [](int x, int z) { return dvec3(0.25 * x, 0.01 * x * z, 0.25 * z); };
  for (int x = 0; x < side; ++x) {
    for (int z = 0; z < side; ++z) {
      for (const dvec3& corner : {at(x, z), at(x, z + 1), at(x + 1, z), at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)}) {
        split.corners.push_back(corner);
      }
    }
  }
  for (std::uint32_t i = 0; i < split.corners.size(); i += 3) split.triangles.emplace_back(i, i + 1, i + 2);
  return split;
}

struct Encoded {
  Bytes bytes;
  std::size_t points = 0;
  int position = 0;  ///< ids of the attributes
  int normal = -1;
};

Encoded encode(const Solid& split, int method, bool has_normals, bool has_metadata) {
  const std::vector<float> positions = floats(split.corners);
  const std::vector<float> normals = floats(flat_normals(split));
  draco::TriangleSoupMeshBuilder soup;
  soup.Start(static_cast<int>(split.triangles.size()));
  Encoded result;
  result.position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  if (has_normals) result.normal = soup.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  for (std::uint32_t face = 0; face < split.triangles.size(); ++face) {
    const auto set = [&](int attribute, const std::vector<float>& values) {
      const float* first = &values[std::size_t{9} * face];
      soup.SetAttributeValuesForFace(attribute, draco::FaceIndex(face), first, first + 3, first + 6);
    };
    set(result.position, positions);
    if (has_normals) set(result.normal, normals);
  }
  const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
  if (has_metadata) {
    auto about = std::make_unique<draco::GeometryMetadata>();
    about->AddEntryString("made by", "a test");
    auto inner = std::make_unique<draco::Metadata>();
    inner->AddEntryInt("depth", 1);
    about->AddSubMetadata("inner", std::move(inner));
    mesh->AddMetadata(std::move(about));
    auto attribute = std::make_unique<draco::AttributeMetadata>();
    attribute->AddEntryString("name", std::string(200, 'p'));
    mesh->AddAttributeMetadata(result.position, std::move(attribute));
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco could not encode the solid");
  result.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  result.points = encoder.num_encoded_points();
  result.position = static_cast<int>(mesh->attribute(result.position)->unique_id());
  if (has_normals) result.normal = static_cast<int>(mesh->attribute(result.normal)->unique_id());
  return result;
}

// How much of a corner follows the second of two joints; the rest follows the first.
float share_of_second(const dvec3& corner) { return static_cast<float>(0.25 * std::floor(corner.x)); }

// Joints and weights as Draco attributes. The accessors count the corners before Draco joins the equal ones, as the
// files of some exporters do: the Draco data counts (KHR_draco_mesh_compression, "Conformance").
Construct skinned(const std::string& name, int method) {
  const Solid split = split_solid();
  draco::TriangleSoupMeshBuilder soup;
  soup.Start(static_cast<int>(split.triangles.size()));
  const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int joint = soup.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const int weight = soup.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  const std::vector<float> positions = floats(split.corners);
  const std::array<std::uint8_t, 4> joints{0, 1, 0, 0};
  for (std::uint32_t face = 0; face < split.triangles.size(); ++face) {
    const draco::FaceIndex at(face);
    const float* first = &positions[std::size_t{9} * face];
    soup.SetAttributeValuesForFace(position, at, first, first + 3, first + 6);
    soup.SetAttributeValuesForFace(joint, at, joints.data(), joints.data(), joints.data());
    std::array<std::array<float, 4>, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
      const float share = share_of_second(split.corners[std::size_t{3} * face + i]);
      weights[i] = {1.0f - share, share, 0.0f, 0.0f};
    }
    soup.SetAttributeValuesForFace(weight, at, weights[0].data(), weights[1].data(), weights[2].data());
  }
  const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
  if (mesh->num_points() >= split.corners.size()) throw std::runtime_error("Draco joined no corners");
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco could not encode the skin");
  GltfBuilder builder;
  use(builder, "KHR_draco_mesh_compression", true);
  const int view = add_view(builder, Bytes(buffer.data(), buffer.data() + buffer.size()));
  std::string attributes;
  std::string ids;
  const auto add_attribute = [&](const std::string& key, int id, std::string_view component, std::string_view type) {
    const char* comma = ids.empty() ? "\"" : ",\"";
    const int accessor = add_accessor(builder, -1, component, type, split.corners.size());
    attributes += comma + key + "\":" + std::to_string(accessor);
    ids += comma + key + "\":" + std::to_string(mesh->attribute(id)->unique_id());
  };
  add_attribute("POSITION", position, "f32", "VEC3");
  add_attribute("JOINTS_0", joint, "u8", "VEC4");
  add_attribute("WEIGHTS_0", weight, "f32", "VEC4");
  add_mesh(builder, attributes, add_accessor(builder, -1, "u16", "SCALAR", 3 * split.triangles.size()),
           R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" + std::to_string(view) +
               R"(,"attributes":{)" + ids + "}}}");
  const dmat4 first = translation({0, 1, 0});
  const dmat4 second = rotation({0, 1, 0}, 0.5);
  add(builder, "skins", R"({"joints":[1,2]})");
  add(builder, "nodes", R"({"mesh":0,"skin":0,"children":[1,2]})");
  add(builder, "nodes", R"({"matrix":)" + list_of(first) + "}");
  add(builder, "nodes", R"({"matrix":)" + list_of(second) + "}");
  Solid moved = split;
  for (dvec3& corner : moved.corners) {
    const double share = static_cast<double>(share_of_second(corner));
    corner = dvec3(((1.0 - share) * first + share * second) * dvec4(corner, 1.0));
  }
  Construct construct = finished(name, builder, placed(moved));
  construct.tolerance = longest_side / ((1 << position_bits) - 1);
  construct.in_order = false;
  construct.notes = {"skin"};
  return construct;
}

Construct compressed(const std::string& name, const Solid& split, int method, bool has_normals,
                     bool has_metadata = false) {
  GltfBuilder builder;
  use(builder, "KHR_draco_mesh_compression", true);
  const Encoded encoded = encode(split, method, has_normals, has_metadata);
  const int view = add_view(builder, encoded.bytes);
  std::string attributes = "\"POSITION\":" + std::to_string(add_accessor(builder, -1, "f32", "VEC3", encoded.points));
  std::string ids = "\"POSITION\":" + std::to_string(encoded.position);
  if (has_normals) {
    attributes += ",\"NORMAL\":" + std::to_string(add_accessor(builder, -1, "f32", "VEC3", encoded.points));
    ids += ",\"NORMAL\":" + std::to_string(encoded.normal);
  }
  const int indices = add_accessor(builder, -1, "u16", "SCALAR", 3 * split.triangles.size());
  add_mesh(builder, attributes, indices,
           R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" + std::to_string(view) +
               R"(,"attributes":{)" + ids + "}}}");
  Construct construct = finished(name, builder, placed(split));
  // One step of the quantisation over the longest side of the bounds.
  construct.tolerance = longest_side / ((1 << position_bits) - 1);
  construct.in_order = false;
  construct.flat_normals = has_normals;
  return construct;
}

}  // namespace

std::vector<Construct> draco_constructs() {
  return {compressed("Draco with edgebreaker", split_solid(), draco::MESH_EDGEBREAKER_ENCODING, false),
          compressed("Draco with edgebreaker and normals", split_solid(), draco::MESH_EDGEBREAKER_ENCODING, true),
          compressed("Draco in sequence", split_solid(), draco::MESH_SEQUENTIAL_ENCODING, false),
          compressed("Draco in sequence with normals", split_solid(), draco::MESH_SEQUENTIAL_ENCODING, true),
          compressed("Draco with metadata", split_solid(), draco::MESH_EDGEBREAKER_ENCODING, false, true),
          skinned("Draco with a skin and edgebreaker", draco::MESH_EDGEBREAKER_ENCODING),
          skinned("Draco with a skin in sequence", draco::MESH_SEQUENTIAL_ENCODING),
          compressed("Draco with many triangles", hill(), draco::MESH_EDGEBREAKER_ENCODING, false)};
}

}  // namespace umbrameter::test
