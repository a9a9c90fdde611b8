#include "scenes/gltf_draco.h"

#include <draco/compression/decode.h>

#include <memory>

namespace umbrameter::gltf {
namespace {

/// Reads ahead in the compressed bytes; past the end everything is zero.
struct Cursor {
  std::span<const unsigned char> bytes;
  std::size_t at = 0;
  bool is_past_end = false;

  std::uint32_t byte() {
    if (at < bytes.size()) return bytes[at++];
    is_past_end = true;
    return 0;
  }
  std::uint32_t varint() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint32_t next = byte();
      value |= (next & 0x7fu) << shift;
      if ((next & 0x80u) == 0) break;
    }
    return value;
  }
  void skip(std::size_t count) {
    if (count > bytes.size() - at) is_past_end = true;
    at = is_past_end ? bytes.size() : at + count;
  }
};

// Draco bitstream specification, "Metadata Decoder": entries, then nested metadata.
void skip_metadata(Cursor& cursor, int depth) {
  for (std::uint32_t entries = cursor.varint(); entries > 0 && !cursor.is_past_end; --entries) {
    cursor.skip(cursor.byte());
    cursor.skip(cursor.varint());
  }
  for (std::uint32_t nested = cursor.varint(); nested > 0 && !cursor.is_past_end; --nested) {
    if (depth > 16) {
      cursor.is_past_end = true;
      return;
    }
    cursor.skip(cursor.byte());
    skip_metadata(cursor, depth + 1);
  }
}

struct Counts {
  std::uint64_t faces = 0;
  std::uint64_t vertices = 0;
};

// Draco bitstream specification, "Draco Decoder" and "Connectivity Decoder": what the data says of its own size, so
// that memory is claimed before the decoder takes it.
Counts announced_counts(std::span<const unsigned char> bytes, const std::filesystem::path& path,
                        const std::string& object) {
  constexpr std::size_t flags_at = 9;
  constexpr std::size_t header_size = 11;
  constexpr unsigned has_metadata = 0x80;  // of the upper byte
  const bool is_draco = bytes.size() > header_size && std::equal(bytes.begin(), bytes.begin() + 5, "DRACO");
  if (!is_draco) fail(path, object, "its bytes are not Draco data", "copy or export the file again");
  if (bytes[5] != 2 || bytes[6] != 2 || bytes[7] != 1) {
    fail(path, object,
         "its Draco data is " + std::string(bytes[7] == 1 ? "a mesh" : "no mesh") + " of version " +
             std::to_string(bytes[5]) + "." + std::to_string(bytes[6]),
         "compress it again as a mesh of Draco bitstream 2.2");
  }
  Cursor cursor{bytes, header_size};
  if ((bytes[flags_at + 1] & has_metadata) != 0) {
    for (std::uint32_t attributes = cursor.varint(); attributes > 0 && !cursor.is_past_end; --attributes) {
      cursor.varint();
      skip_metadata(cursor, 0);
    }
    skip_metadata(cursor, 0);
  }
  Counts counts;
  if (bytes[8] == 0) {  // sequential
    counts.faces = cursor.varint();
    counts.vertices = cursor.varint();
  } else {  // edgebreaker, after its kind of traversal
    cursor.byte();
    counts.vertices = cursor.varint();
    counts.faces = cursor.varint();
  }
  if (cursor.is_past_end) fail(path, object, "its Draco data is cut short", "copy or export the file again");
  return counts;
}

std::vector<float> read_attribute(const draco::Mesh& mesh, const std::string& name, const DracoAttribute& wanted,
                                  const std::filesystem::path& path, const std::string& object) {
  const draco::PointAttribute* attribute =
      mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(std::max(0, wanted.unique_id)));
  if (attribute == nullptr || wanted.unique_id < 0) {
    fail(path, object, "its Draco data has no attribute " + std::to_string(wanted.unique_id) + " for " + name);
  }
  const auto components = static_cast<std::int8_t>(wanted.components);
  const int found = attribute->num_components();
  if (found != int{components}) {
    fail(path, object,
         name + " has " + std::to_string(found) + " components in the Draco data where " + std::to_string(components) +
             " are expected");
  }
  std::vector<float> values(mesh.num_points() * wanted.components);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
    const bool is_there = value.value() < attribute->size();
    if (!is_there || !attribute->ConvertValue<float>(value, components, &values[i * wanted.components])) {
      fail(path, object, "its Draco data is damaged at vertex " + std::to_string(i) + " of " + name,
           "copy or export the file again");
    }
  }
  return values;
}

}  // namespace

DracoMesh decode_draco(std::span<const unsigned char> bytes, const std::map<std::string, DracoAttribute>& wanted,
                       Allowance& allowance, const std::filesystem::path& path, const std::string& object) {
  const Counts counts = announced_counts(bytes, path, object);
  // Our own copy, and what the decoder keeps: a corner table of some 100 bytes a face, and for each vertex both copies
  // of its values, 4 bytes each; positions, normals and texture coordinates are there even where they are not wanted.
  std::uint64_t components = 3 + 3 + 2;
  for (const auto& [name, attribute] : wanted) {
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) components += attribute.components;
  }
  claim(allowance, 112 * counts.faces + 2 * 4 * components * counts.vertices, path, object);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    fail(path, object, "its Draco data is damaged (" + decoded.status().error_msg_string() + ")",
         "copy or export the file again");
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  DracoMesh result;
  result.vertices = mesh->num_points();
  result.triangles.reserve(mesh->num_faces());
  for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(i));
    result.triangles.emplace_back(face[0].value(), face[1].value(), face[2].value());
  }
  for (const auto& [name, attribute] : wanted) {
    result.attributes[name] = read_attribute(*mesh, name, attribute, path, object);
  }
  return result;
}

}  // namespace umbrameter::gltf
