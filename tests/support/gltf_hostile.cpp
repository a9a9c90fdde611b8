#include "tests/support/gltf_hostile.h"

#include <limits>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

std::string text_of_solid() {
  GltfBuilder builder;
  add_solid(builder);
  return to_json(builder, data_uri("application/octet-stream", builder.binary));
}

HostileFile text(const std::string& name, const std::string& json) { return {name, {json.begin(), json.end()}}; }

/// The solid with some of its text replaced, once.
HostileFile changed(const std::string& name, const std::string& from, const std::string& to) {
  std::string json = text_of_solid();
  const std::size_t at = json.find(from);
  if (at != std::string::npos) json.replace(at, from.size(), to);
  return text(name, json);
}

/// The solid under these nodes.
HostileFile noded(const std::string& name, const std::vector<std::string>& nodes, const std::string& more = "") {
  GltfBuilder builder;
  add_solid(builder);
  for (const std::string& node : nodes) add(builder, "nodes", node);
  builder.more = more;
  return {name, to_binary_gltf(builder)};
}

/// The solid with a texture of these bytes.
HostileFile textured(const std::string& name, const Bytes& image) {
  GltfBuilder builder;
  add(builder, "images", R"({"bufferView":)" + std::to_string(add_view(builder, image)) + "}");
  add(builder, "textures", R"({"source":0})");
  add(builder, "materials", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  add_solid(builder, ",\"material\":0");
  add(builder, "nodes", R"({"mesh":0})");
  return {name, to_binary_gltf(builder)};
}

HostileFile positioned(const std::string& name, float value) {
  GltfBuilder builder;
  const int positions = add_values<float>(builder, "VEC3", {0, 0, 0, 1, 0, 0, 0, value, 0});
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions));
  add(builder, "nodes", R"({"mesh":0})");
  return {name, to_binary_gltf(builder)};
}

HostileFile lying_length(std::size_t offset, unsigned char value) {
  GltfBuilder builder;
  add_solid(builder);
  Bytes bytes = to_binary_gltf(builder);
  bytes[offset] = value;
  return {"a GLB that lies at byte " + std::to_string(offset), bytes};
}

Bytes huge_png() {
  Bytes image = png(1, 1, {1, 2, 3, 4});
  image[16] = 0x7f;  // the upper byte of its width
  image[20] = 0x7f;  // and of its height
  return image;
}

Bytes wide_png() {
  Bytes image = png(1, 1, {1, 2, 3, 4});
  image[18] = 0x7f;  // 32,513 by 32,513
  image[22] = 0x7f;
  image[25] = 0;  // grey: of more channels the decoder itself refuses so many
  return image;
}

// Where 256 codes are the most. Fill bytes may stand before any marker (T.81, section B.1.1.2).
Bytes jpeg_of_too_many_codes(std::size_t fill_bytes) {
  const Bytes plain = grey_jpeg(1, 1, {128});
  Bytes image(fill_bytes, 0xff);
  const auto append = [&](const Bytes& bytes, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) image.push_back(bytes[i]);
  };
  const Bytes table = huffman_table(0xff);
  append(plain, 0, 2);
  append(table, 0, table.size());
  append(plain, 2, plain.size());
  return image;
}

HostileFile two_binary_chunks() {
  GltfBuilder builder;
  add_solid(builder);
  Bytes bytes = to_binary_gltf(builder);
  bytes.insert(bytes.end(), {4, 0, 0, 0, 'B', 'I', 'N', 0, 1, 2, 3, 4});
  for (unsigned i = 0; i < 4; ++i) bytes[8 + i] = static_cast<unsigned char>((bytes.size() >> (8 * i)) & 0xffu);
  return {"two binary chunks", bytes};
}

/// A view that says it unpacks to `count` vertices of `stride` bytes.
HostileFile forged_meshopt(const std::string& name, std::size_t stride, std::size_t count) {
  GltfBuilder builder;
  add_bytes(builder, Bytes(32, 0xa0));
  const std::string size = std::to_string(stride * count);
  add(builder, "buffers", R"({"byteLength":)" + size + "}");
  add(builder, "bufferViews",
      R"({"buffer":1,"byteLength":)" + size +
          R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":32,"byteStride":)" +
          std::to_string(stride) + R"(,"count":)" + std::to_string(count) + R"(,"mode":"ATTRIBUTES"}}})");
  add_mesh(builder, "\"POSITION\":" + std::to_string(add_accessor(builder, 0, "f32", "VEC3", 3)));
  add(builder, "nodes", R"({"mesh":0})");
  return {name, to_binary_gltf(builder)};
}

/// A triangle among vertices that are all at the origin.
HostileFile many_vertices() {
  GltfBuilder builder;
  const int places = add_view(builder, raw_bytes<std::uint8_t>({0, 1, 2}));
  const int values = add_view(builder, raw_bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const int positions =
      add_accessor(builder, -1, "f32", "VEC3", 70000,
                   R"(,"sparse":{"count":3,"indices":{"bufferView":)" + std::to_string(places) +
                       R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}");
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions),
           add_values<std::uint8_t>(builder, "SCALAR", {0, 1, 2}));
  add(builder, "nodes", R"({"mesh":0})");
  return {"more vertices than 16 bits count", to_binary_gltf(builder)};
}

/// Thirty scenes, `named` of them of one name. The target takes the length modulo 8 for what else to try.
HostileFile many_scenes(const std::string& name, int named, std::size_t length) {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "nodes", R"({"mesh":0})");
  for (int i = 0; i < 30; ++i) {
    add(builder, "scenes", i < named ? R"({"nodes":[0],"name":"second"})" : R"({"nodes":[0]})");
  }
  HostileFile file{name, to_text_gltf(builder)};
  while (file.bytes.size() % 8 != length) file.bytes.push_back(' ');
  return file;
}

/// A skin of one joint whose weights and bind matrix are these.
HostileFile skinned(const std::string& name, float weight, float bind) {
  GltfBuilder builder;
  const int positions = add_values<float>(builder, "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int joints = add_values<std::uint8_t>(builder, "VEC4", std::vector<std::uint8_t>(12, 0));
  const int weights = add_values(builder, "VEC4", std::vector<float>(12, weight));
  const int matrices = add_values(builder, "MAT4", std::vector<float>(16, bind));
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + ",\"JOINTS_0\":" + std::to_string(joints) +
                        ",\"WEIGHTS_0\":" + std::to_string(weights));
  add(builder, "skins", R"({"joints":[1],"inverseBindMatrices":)" + std::to_string(matrices) + "}");
  add(builder, "nodes", R"({"mesh":0,"skin":0,"children":[1]})");
  add(builder, "nodes", R"({"scale":[1e30,1e30,1e30]})");
  return {name, to_binary_gltf(builder)};
}

// Draco bitstream specification, "Metadata Decoder": no entries and one nested metadata without a name, twenty times.
HostileFile deep_metadata() {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", std::vector<float>(9, 0.0f));
  std::vector<std::uint8_t> data = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0x80, 0};
  for (int depth = 0; depth < 20; ++depth) data.insert(data.end(), {0, 1, 0});
  add_values<std::uint8_t>(builder, "SCALAR", data);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions), -1,
           R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":1,"attributes":{"POSITION":0}}})");
  add(builder, "nodes", R"({"mesh":0})");
  return {"metadata within metadata", to_binary_gltf(builder)};
}

// A light whose extras tell its extent, once at the node and once at the light itself.
HostileFile with_extent(const std::string& name, const std::string& type, const std::string& extras) {
  const std::string reference = R"("extensions":{"KHR_lights_punctual":{"light":)";
  return noded(name, {R"({"extras":)" + extras + "," + reference + "0}}}", "{" + reference + "1}}}"},
               R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":")" + type + R"("},{"type":")" + type +
                   R"(","extras":)" + extras + "}]}}");
}

}  // namespace

std::vector<HostileFile> hostile_files() {
  const Bytes whole = png(2, 2, Bytes(16, 200));
  return {
      text("nothing but a bracket", "{"),
      text("another version", R"({"asset":{"version":"1.0"}})"),
      text("nested lists", R"({"asset":{"version":"2.0"},"x":)" + std::string(200, '[') + std::string(200, ']') + "}"),
      changed("an index beyond the vertices", "\"count\":18", "\"count\":1800000000"),
      changed("an offset beyond the buffer", "\"byteOffset\":96", "\"byteOffset\":4294967295"),
      changed("a stride of nothing", "\"byteLength\":96", "\"byteLength\":96,\"byteStride\":1"),
      changed("another type", "VEC3", "MAT4"),
      changed("another component type", "5126", "5130"),
      changed("an absent accessor", "\"POSITION\":0", "\"POSITION\":77"),
      changed("a buffer that is not base64", "base64,", "base64,%%%"),
      changed("a file elsewhere", "data:", "file:"),
      noded("a cycle", {R"({"children":[1]})", R"({"children":[0],"mesh":0})"}),
      noded("a node twice", {R"({"children":[1,1]})", R"({"mesh":0})"}),
      noded("a scale beyond all numbers",
            {R"({"scale":[1e300,1,1],"children":[1]})", R"({"mesh":0,"scale":[1e300,1,1]})"}),
      noded("no rotation", {R"({"mesh":0,"rotation":[0,0,0,0]})"}),
      noded("a flat node", {R"({"mesh":0,"scale":[1,0,1]})"}),
      noded("a scene that is not there", {R"({"mesh":0})"}, R"(,"scene":9)"),
      noded("a camera without an angle", {R"({"camera":0})"},
            R"(,"cameras":[{"type":"perspective","perspective":{"yfov":0,"znear":0}}])"),
      noded("a light of no kind", {R"({"extensions":{"KHR_lights_punctual":{"light":0}}})"},
            R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"laser"}]}})"),
      with_extent("a sphere", "point", R"({"radius":0.5})"),
      with_extent("a disk", "point", R"({"radius":0.5,"shape":"disk"})"),
      with_extent("a disk across the axis", "spot", R"({"radius":0.5,"other":1,"name":"lamp"})"),
      with_extent("a sphere of a spot light", "spot", R"({"radius":0.5,"shape":"sphere"})"),
      with_extent("a rectangle", "spot", R"({"width":0.5,"height":2})"),
      with_extent("a sun", "directional", R"({"angularDiameter":0.01})"),
      with_extent("half a rectangle", "spot", R"({"width":0.5})"),
      with_extent("a rectangle and a radius", "spot", R"({"width":0.5,"height":1,"radius":1})"),
      with_extent("a radius below nothing", "point", R"({"radius":-1})"),
      with_extent("a radius beyond everything", "point", R"({"radius":1e300})"),
      with_extent("a radius in words", "point", R"({"radius":"one"})"),
      with_extent("a shape that is none", "point", R"({"radius":1,"shape":"torus"})"),
      with_extent("a shape that is a number", "point", R"({"radius":1,"shape":7})"),
      with_extent("a shape without a size", "point", R"({"shape":"disk"})"),
      with_extent("nothing of an extent", "point", R"({"radius":0})"),
      with_extent("a sun with a radius", "directional", R"({"radius":1,"angularDiameter":0.01})"),
      with_extent("a lamp with an angle", "point", R"({"radius":1,"angularDiameter":0.01})"),
      with_extent("a sun of half the sky", "directional", R"({"angularDiameter":3.2})"),
      noded("a skin without joints", {R"({"mesh":0,"skin":0})"}, R"(,"skins":[{"joints":[]}])"),
      positioned("a position that is no number", std::numeric_limits<float>::quiet_NaN()),
      positioned("a position that is infinite", std::numeric_limits<float>::infinity()),
      positioned("a triangle without area", 0.0f),
      lying_length(8, 0xff),
      lying_length(12, 0x01),
      lying_length(4, 0x07),
      textured("an image of gigabytes", huge_png()),
      textured("an image of a thousand million texels", wide_png()),
      two_binary_chunks(),
      skinned("weights that are no number", std::numeric_limits<float>::quiet_NaN(), 1.0f),
      skinned("weights that are zero", 0.0f, 0.0f),
      skinned("a skin that leads to infinity", 1.0f, 3e38f),
      skinned("a skin that is no number", 1.0f, std::numeric_limits<float>::quiet_NaN()),
      textured("a JPEG of too many codes", jpeg_of_too_many_codes(0)),
      textured("a JPEG of too many codes behind fill bytes", jpeg_of_too_many_codes(3)),
      deep_metadata(),
      forged_meshopt("a meshopt stride beyond all vertices", 260, 3),
      forged_meshopt("a meshopt stride of half a word", 6, 16),
      forged_meshopt("a meshopt count beyond its bytes", 12, 1000000),
      many_vertices(),
      many_scenes("a scene by its name", 1, 1),
      many_scenes("a scene by a name of two", 2, 1),
      many_scenes("a scene by its number", 1, 2),
      many_scenes("a scene by no number", 1, 3),
      noded("a lamp with other extras",
            {R"({"extras":{"name":"lamp"},"extensions":{"KHR_lights_punctual":{"light":0}}})"},
            R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})"),
      textured("half an image", {whole.begin(), whole.begin() + 40}),
      textured("an image that is none", {'G', 'I', 'F', '8', '9', 'a'}),
  };
}

}  // namespace umbrameter::test
