// Where the bytes of a file lie, and what its extensions are called.
#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

Bytes bytes_of_text(const std::string& text) { return {text.begin(), text.end()}; }

Construct textual(const std::string& name, const std::string& uri, const std::string& side_file) {
  GltfBuilder builder;
  add_solid(builder);
  Construct construct = finished(name, builder, placed(solid()));
  construct.file_name = "scene.gltf";
  construct.file = bytes_of_text(to_json(builder, uri));
  construct.side_files[side_file] = builder.binary;
  return construct;
}

Construct with_data_uri() {
  GltfBuilder builder;
  add_solid(builder);
  Construct construct = finished("a buffer in a data URI", builder, placed(solid()));
  construct.file_name = "scene.gltf";
  construct.file = to_text_gltf(builder);
  return construct;
}

// Buffer 0 is the chunk, buffer 1 a data URI, buffer 2 a file.
Construct with_three_buffers() {
  GltfBuilder builder;
  const Solid split = split_solid();
  const int positions = add_values(builder, "VEC3", floats(split.corners));
  const Bytes normals = raw_bytes(floats(flat_normals(split)));
  const Bytes indices = raw_bytes<std::uint8_t>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17});
  add(builder, "buffers",
      R"({"byteLength":)" + std::to_string(normals.size()) + R"(,"uri":")" +
          data_uri("application/gltf-buffer", normals) + "\"}");
  add(builder, "buffers", R"({"byteLength":18,"uri":"indices.bin"})");
  const int normal_view =
      add(builder, "bufferViews", R"({"buffer":1,"byteLength":)" + std::to_string(normals.size()) + "}");
  const int index_view = add(builder, "bufferViews", R"({"buffer":2,"byteLength":18})");
  add_mesh(builder,
           "\"POSITION\":" + std::to_string(positions) +
               ",\"NORMAL\":" + std::to_string(add_accessor(builder, normal_view, "f32", "VEC3", 18)),
           add_accessor(builder, index_view, "u8", "SCALAR", 18));
  Construct construct = finished("three buffers", builder, placed(split));
  construct.side_files["indices.bin"] = indices;
  construct.flat_normals = true;
  return construct;
}

Construct with_image_file() {
  GltfBuilder builder;
  add(builder, "images", R"({"uri":"textures/gr%C3%BCn.png"})");
  add(builder, "textures", R"({"source":0})");
  add(builder, "materials", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const Solid split = split_solid();
  const int positions = add_values(builder, "VEC3", floats(split.corners));
  const int texcoords = add_values(builder, "VEC2", std::vector<float>(36, 0.5f));
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + ",\"TEXCOORD_0\":" + std::to_string(texcoords), -1,
           ",\"material\":0");
  Construct construct = finished("an image in a folder", builder, placed(split));
  construct.side_files["textures/gr\xC3\xBCn.png"] = png(1, 1, {0, 255, 0, 255});
  construct.base_color = dvec4(0, 1, 0, 1);
  return construct;
}

// Section 4.4.3: chunks of other types are passed over.
Construct with_unknown_chunk() {
  GltfBuilder builder;
  add_solid(builder);
  Construct construct = finished("a chunk of another kind", builder, placed(solid()));
  const Bytes chunk = {8, 0, 0, 0, 'X', 'T', 'R', 'A', 1, 2, 3, 4, 5, 6, 7, 8};
  construct.file.insert(construct.file.end(), chunk.begin(), chunk.end());
  const std::size_t length = construct.file.size();
  for (unsigned i = 0; i < 4; ++i) construct.file[8 + i] = static_cast<unsigned char>((length >> (8 * i)) & 0xffu);
  return construct;
}

Construct with_unknown_extension(bool is_required) {
  GltfBuilder builder;
  use(builder, "ACME_rubber_walls", is_required);
  add_solid(builder);
  add(builder, "nodes", R"({"mesh":0,"extensions":{"ACME_rubber_walls":{"stretch":[1,2],"deep":{"count":-5}}}})");
  Construct construct = finished(std::string("an unknown extension that is ") + (is_required ? "required" : "used"),
                                 builder, is_required ? std::vector<Triangle>() : placed(solid()));
  (is_required ? construct.refused : construct.notes) = {"ACME_rubber_walls"};
  return construct;
}

// Everything that a reader may pass over, under names of other alphabets.
Construct with_extras() {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", floats(split_solid().corners));
  add(builder, "meshes",
      R"({"name":"\u30c6\u30b9\u30c8 \"quoted\"","extras":{"count":-1,"uri":5,"a":[[],{}]},"primitives":[{"attributes":)"
      R"({"POSITION":)" +
          std::to_string(positions) + R"(,"_TEMPERATURE":)" + std::to_string(positions) + R"(},"extras":[1,2]}]})");
  add(builder, "nodes", "{\"mesh\":0,\"name\":\"d\xC3\xBCrr \xE2\x98\x83\",\"extras\":null}");
  builder.more = R"(,"extras":"anything")";
  add(builder, "scenes", R"({"nodes":[0],"extras":{"nodes":"none"}})");
  return finished("names and extras", builder, placed(split_solid()));
}

}  // namespace

std::vector<Construct> file_constructs() {
  return {with_data_uri(),
          textual("a buffer in a file", "solid.bin", "solid.bin"),
          textual("a buffer in a nested folder", "parts/deep/solid.bin", "parts/deep/solid.bin"),
          textual("a percent-encoded name", "my%20solid%23%C3%A4.bin", "my solid#\xC3\xA4.bin"),
          textual("a name in UTF-8", "d\xC3\xBCrr \xE2\x98\x83.bin", "d\xC3\xBCrr \xE2\x98\x83.bin"),
          with_three_buffers(),
          with_image_file(),
          with_unknown_chunk(),
          with_unknown_extension(false),
          with_unknown_extension(true),
          with_extras()};
}

}  // namespace umbrameter::test
