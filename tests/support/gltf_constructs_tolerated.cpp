// What a conforming viewer passes over: members that have a meaning elsewhere only, parts that nothing shows, textures
// that an opaque surface can do without, extensions that change no geometry; and files of other versions, which it
// refuses.
#include <limits>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

// Names of members of nodes, accessors, textures and lights, each of a type that none of them has.
constexpr const char* misused_names =
    R"({"scale":"large","rotation":{"x":1},"matrix":7,"nodes":"none","children":true,"index":[],"min":{},"max":"most",)"
    R"("weights":{"a":1},"translation":false,"mesh":"m","count":-5,"uri":5,"bufferView":0.5,"mode":{},"source":"s",)"
    R"("radius":"r","extensions":[1],"extras":3,"buffers":{},"type":1,"color":"red","version":2})";

const Bytes& ktx2_image() {
  static const Bytes bytes = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n', 0, 0, 0, 0};
  return bytes;
}

std::string image_of(GltfBuilder& builder, const Bytes& bytes) {
  return R"({"bufferView":)" + std::to_string(add_view(builder, bytes)) + "}";
}

Construct with_misused_names() {
  GltfBuilder builder;
  const std::string misused = misused_names;
  const std::string extras = ",\"extras\":" + misused + ",\"extensions\":{\"ACME_any\":" + misused + "}";
  for (const char* name : {"ACME_any", "KHR_materials_clearcoat"}) use(builder, name);
  add(builder, "images", image_of(builder, ktx2_image()));
  add(builder, "textures", R"({"source":0)" + extras + "}");
  add(builder, "samplers", R"({"minFilter":"none","name":3)" + extras + "}");
  add(builder, "materials",
      R"({"normalTexture":{"index":0,"scale":0.5},"occlusionTexture":{"index":0,"strength":0.25},"emissiveFactor":[1,1,1],)"
      R"("emissiveTexture":{"index":0},"extras":)" +
          misused + R"(,"extensions":{"KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,"scale":2}},)" +
          R"("ACME_any":)" + misused + "}}");
  const int positions = add_values(builder, "VEC3", floats(solid().corners), R"(,"min":[0,0,0],"max":"any")" + extras);
  const int indices = add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid()));
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions), indices, ",\"material\":0" + extras);
  add(builder, "cameras",
      R"({"type":"perspective","perspective":{"yfov":1,"znear":1,"aspectRatio":"wide"})" + extras + "}");
  add(builder, "nodes", R"({"mesh":0)" + extras + "}");
  add(builder, "animations", R"({"channels":"none","samplers":7})");
  add(builder, "scenes", R"({"nodes":[0])" + extras + "}");
  builder.more = ",\"scale\":0.5,\"matrix\":1,\"children\":{},\"index\":\"i\"" + extras;
  Construct construct = finished("names that mean something elsewhere", builder, placed(solid()));
  construct.notes = {"ACME_any, KHR_materials_clearcoat", "animations"};
  return construct;
}

Construct with_nulls() {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "nodes",
      R"({"mesh":0,"name":null,"camera":null,"children":null,"matrix":null,"extras":null,"extensions":[]})");
  return finished("members that are null", builder, placed(solid()));
}

/// The solid with a texture on a material of these members; the texture's own members are `texture`.
GltfBuilder textured(const std::string& texture, const std::string& image, const std::string& material = "") {
  GltfBuilder builder;
  add(builder, "images", image);
  add(builder, "textures", "{" + texture + "}");
  add(builder, "materials",
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1],"baseColorTexture":{"index":0}})" + material +
          "}");
  add_solid(builder, ",\"material\":0");
  return builder;
}

constexpr const char* basisu_texture = R"("extensions":{"KHR_texture_basisu":{"source":0}})";

Construct with_ktx2(const std::string& name, const std::string& material, bool is_refused) {
  GltfBuilder builder =
      textured(basisu_texture, R"({"uri":")" + data_uri("image/ktx2", ktx2_image()) + "\"}", material);
  use(builder, "KHR_texture_basisu", true);
  Construct construct = finished(name, builder, is_refused ? std::vector<Triangle>() : placed(solid()));
  if (is_refused) {
    construct.refused = {"texture 0", "KTX2", "the alpha of material 0", "PNG or JPEG"};
  } else {
    construct.notes = {"KHR_texture_basisu", "KTX2"};
    construct.base_color = dvec4(0.25, 0.5, 0.75, 1);
  }
  return construct;
}

Construct with_fallback_image() {
  GltfBuilder builder = textured(R"("source":0,"extensions":{"KHR_texture_basisu":{"source":1}})",
                                 R"({"uri":")" + data_uri("image/png", png(1, 1, {255, 255, 255, 255})) + "\"}");
  add(builder, "images", R"({"uri":")" + data_uri("image/ktx2", ktx2_image()) + "\"}");
  use(builder, "KHR_texture_basisu");
  Construct construct = finished("a PNG beside a KTX2 texture", builder, placed(solid()));
  construct.notes = {"KHR_texture_basisu"};
  construct.base_color = dvec4(0.25, 0.5, 0.75, 1);
  return construct;
}

Construct without_image(const std::string& name, const std::string& image, const std::string& note) {
  GltfBuilder builder = textured("\"source\":0", image);
  Construct construct = finished(name, builder, placed(solid()));
  construct.notes = {note};
  construct.base_color = dvec4(0.25, 0.5, 0.75, 1);
  return construct;
}

// Its image is none, and its mask would need it.
Construct with_unused_material() {
  GltfBuilder builder = textured("\"source\":0", R"({"bufferView":99})", R"(,"alphaMode":"MASK")");
  add(builder, "materials", "{}");
  std::string& mesh = builder.lists["meshes"].front();
  mesh.replace(mesh.find("\"material\":0"), 12, "\"material\":1");
  return finished("a material that nothing has", builder, placed(solid()));
}

// Node 1 is hidden with its child, which says that it is visible; node 2 is shown.
Construct with_hidden_node() {
  GltfBuilder builder;
  use(builder, "KHR_node_visibility", true);
  add_solid(builder);
  add(builder, "nodes", R"({"children":[1,2]})");
  add(builder, "nodes", R"({"mesh":0,"children":[3],"extensions":{"KHR_node_visibility":{"visible":false}}})");
  add(builder, "nodes", R"({"mesh":0,"translation":[0,2,0],"extensions":{"KHR_node_visibility":{}}})");
  add(builder, "nodes", R"({"mesh":0,"translation":[9,9,9],"extensions":{"KHR_node_visibility":{"visible":true}}})");
  Construct construct = finished("a hidden node", builder, placed(solid(), translation({0, 2, 0})));
  construct.notes = {"2 nodes with a mesh or a light are hidden"};
  return construct;
}

Construct with_empty_primitives() {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  const int indices = add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid()));
  const std::string whole =
      R"({"attributes":{"POSITION":)" + std::to_string(positions) + R"(},"indices":)" + std::to_string(indices) + "}";
  const std::string bare = R"({"attributes":{"NORMAL":)" + std::to_string(positions) + "}}";
  add(builder, "meshes", R"({"primitives":[)" + bare + "," + whole + ",{}]}");
  Construct construct = finished("primitives without positions", builder, placed(solid()));
  construct.notes = {"2 primitives without POSITION"};
  return construct;
}

Construct with_incomplete_triangle(bool is_indexed) {
  GltfBuilder builder;
  Solid part = is_indexed ? solid() : split_solid();
  std::vector<std::uint16_t> indices = indices_of<std::uint16_t>(part);
  indices.pop_back();
  if (is_indexed) {
    const int positions = add_values(builder, "VEC3", floats(part.corners));
    add_mesh(builder, "\"POSITION\":" + std::to_string(positions), add_values(builder, "SCALAR", indices));
  } else {
    part.corners.pop_back();
    add_mesh(builder, "\"POSITION\":" + std::to_string(add_values(builder, "VEC3", floats(part.corners))));
  }
  part.triangles.pop_back();
  Construct construct = finished(std::string("an incomplete triangle ") + (is_indexed ? "of indices" : "of vertices"),
                                 builder, placed(part));
  construct.notes = {"incomplete triangle"};
  return construct;
}

// Each position is followed by one more byte.
Construct with_odd_stride() {
  GltfBuilder builder;
  Bytes bytes;
  for (const dvec3& corner : solid().corners) {
    const Bytes position = raw_bytes(floats({corner}));
    bytes.insert(bytes.end(), position.begin(), position.end());
    bytes.push_back(0xff);
  }
  const int positions = add_accessor(builder, add_view(builder, bytes, ",\"byteStride\":13"), "f32", "VEC3", 8);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  return finished("a stride that is no multiple of four", builder, placed(solid()));
}

Construct with_bad_texcoords() {
  GltfBuilder builder;
  std::vector<float> texcoords(16, 0.5f);
  texcoords[3] = std::numeric_limits<float>::quiet_NaN();
  texcoords[8] = std::numeric_limits<float>::infinity();
  add(builder, "materials", "{}");
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  const int values = add_values(builder, "VEC2", texcoords);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + ",\"TEXCOORD_0\":" + std::to_string(values),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())), ",\"material\":0");
  Construct construct = finished("texture coordinates that are no numbers", builder, placed(solid()));
  construct.notes = {"2 texture coordinates that are not finite"};
  return construct;
}

// Joints whose weight is zero may be any.
Construct with_unused_joints() {
  GltfBuilder builder;
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t i = 0; i < solid().corners.size(); ++i) {
    joints.insert(joints.end(), {0, 99, 255, 7});
    weights.insert(weights.end(), {1, 0, 0, 0});
  }
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  const int joint_values = add_values(builder, "VEC4", joints);
  const int weight_values = add_values(builder, "VEC4", weights);
  add_mesh(builder,
           "\"POSITION\":" + std::to_string(positions) + ",\"JOINTS_0\":" + std::to_string(joint_values) +
               ",\"WEIGHTS_0\":" + std::to_string(weight_values),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  add(builder, "skins", R"({"joints":[1]})");
  add(builder, "nodes", R"({"mesh":0,"skin":0,"children":[1]})");
  add(builder, "nodes", R"({"translation":[1,2,3]})");
  Construct construct = finished("joints without weight", builder, placed(solid(), translation({1, 2, 3})));
  construct.notes = {"skin"};
  return construct;
}

// Buffers 1 and 2 have no bytes: a view and an accessor of the one are used by a mesh that no node shows.
Construct with_absent_buffers() {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "buffers", R"({"byteLength":96})");
  add(builder, "buffers", "{}");
  const int view = add(builder, "bufferViews", R"({"buffer":1,"byteLength":96})");
  add(builder, "bufferViews", R"({"buffer":2,"byteLength":96})");
  const int positions = add_accessor(builder, view, "f32", "VEC3", 8);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions));
  Construct construct = finished("buffers without bytes that nothing shows", builder, placed(solid()));
  construct.notes = {"mesh 1, which no node shows"};
  return construct;
}

Construct with_harmless_requirements() {
  GltfBuilder builder;
  for (const char* name : {"KHR_materials_clearcoat", "KHR_xmp_json_ld", "KHR_animation_pointer", "KHR_texture_basisu",
                           "EXT_texture_webp", "EXT_structural_metadata"}) {
    builder.extensions_required.emplace_back(name);
  }
  add_solid(builder);
  Construct construct = finished("required extensions that change no geometry", builder, placed(solid()));
  construct.notes = {"KHR_materials_clearcoat, KHR_xmp_json_ld, KHR_animation_pointer, KHR_texture_basisu"};
  return construct;
}

Construct with_backslashes() {
  GltfBuilder builder;
  add_solid(builder);
  Construct construct = finished("a name with a backslash", builder, placed(solid()));
  const std::string text = to_json(builder, R"(parts\\solid.bin)");
  construct.file_name = "scene.gltf";
  construct.file = {text.begin(), text.end()};
  construct.side_files["parts/solid.bin"] = builder.binary;
  return construct;
}

/// The solid with another asset; refused where `words` are given.
Construct of_version(const std::string& name, const std::string& asset, const std::vector<std::string>& words) {
  GltfBuilder builder;
  add_solid(builder);
  Construct construct = finished(name, builder, words.empty() ? placed(solid()) : std::vector<Triangle>());
  std::string json = to_json(builder, data_uri("application/octet-stream", builder.binary));
  const std::string usual = R"({"asset":{"version":"2.0"})";
  json.replace(0, usual.size(), "{\"asset\":" + asset);
  construct.file_name = "scene.gltf";
  construct.file = {json.begin(), json.end()};
  construct.refused = words;
  return construct;
}

// As glTF 1.0 has it: things by name, in objects.
Construct of_version_1(const std::string& name, const std::string& asset) {
  const std::string json = "{" + asset +
                           R"("accessors":{"a":{"bufferView":"v","count":3}},"meshes":{"m":{"primitives":[]}},)"
                           R"("nodes":{"n":{"meshes":["m"]}},"scenes":{"s":{"nodes":["n"]}},"scene":"s"})";
  Construct construct;
  construct.name = name;
  construct.file_name = "scene.gltf";
  construct.file = {json.begin(), json.end()};
  construct.refused = {"glTF 1.", "; convert to 2.0"};
  return construct;
}

Construct of_binary_version_1() {
  Construct construct;
  construct.name = "binary glTF 1";
  // Magic, version, length, length and format of the content.
  construct.file = {'g', 'l', 'T', 'F', 1, 0, 0, 0, 24, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, '{', '}', ' ', ' '};
  construct.refused = {"glTF 1.0; convert to 2.0"};
  return construct;
}

}  // namespace

std::vector<Construct> tolerated_constructs() {
  return {with_misused_names(),
          with_nulls(),
          with_ktx2("a KTX2 texture of an opaque material", "", false),
          with_ktx2("a KTX2 texture of a blended material", R"(,"alphaMode":"BLEND")", false),
          with_ktx2("a KTX2 texture of a mask", R"(,"alphaMode":"MASK")", true),
          with_fallback_image(),
          without_image("an image that is not there", R"({"uri":"gone.png"})", "gone.png"),
          without_image("an image elsewhere", R"({"uri":"../gone.png"})", "leaves the folder"),
          without_image("an image of another kind", R"({"uri":"data:image/gif;base64,R0lGODlhAQABAAAAACw="})",
                        "neither PNG nor JPEG"),
          without_image("an image of nothing", "{}", "neither a uri nor a bufferView"),
          with_unused_material(),
          with_hidden_node(),
          with_empty_primitives(),
          with_incomplete_triangle(true),
          with_incomplete_triangle(false),
          with_absent_buffers(),
          with_odd_stride(),
          with_bad_texcoords(),
          with_unused_joints(),
          with_harmless_requirements(),
          with_backslashes(),
          of_version("version 2.1 that 2.0 reads", R"({"version":"2.1","minVersion":"2.0"})", {}),
          of_version("a version as a number", R"({"version":2.0})", {}),
          of_version("a version that is too new", R"({"version":"2.1","minVersion":"2.1"})",
                     {"minVersion is glTF 2.1", "reads 2.0"}),
          of_version("version 3", R"({"version":"3.0"})", {"glTF 3.0"}),
          of_version_1("glTF 1.0", R"("asset":{"version":"1.0"},)"),
          of_version_1("glTF 1.1", R"("asset":{"version":"1.1","profile":{"api":"WebGL"}},)"),
          of_version_1("glTF 1.0 without a version", ""),
          of_binary_version_1()};
}

}  // namespace umbrameter::test
