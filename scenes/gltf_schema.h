// What the loader reads of a glTF file: the objects of glTF 2.0 and of the supported extensions, each with those of its
// members that count here. A name has a meaning only in its own object: "scale" is a list in a node, a number in a
// normal texture. Members that are not listed are neither checked nor read. Internal to scenes/gltf*.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

namespace umbrameter::gltf {

enum class Kind {
  anything,  ///< only its presence counts
  text,
  texts,  ///< a list; items of other types are left out
  boolean,
  number,
  integer,          ///< an index, a size or a code; −1 is how some writers say that there is none
  size,             ///< bytes
  numbers,          ///< a list
  integers,         ///< a list
  indices_by_name,  ///< an object of integers: attributes
  targets,          ///< a list of those: morph targets
  object,
  objects,        ///< a list
  extensions,     ///< an object of extensions; of another type it is ignored
  extras_name,    ///< extras of which only a "name" is kept; our writer puts that of a primitive there
  extras_emitter  ///< extras of which only the extent of a light is kept
};

struct Shape;

struct Member {
  std::string_view name;
  Kind kind = Kind::anything;
  const Shape* shape = nullptr;  ///< of an object, of each item of objects, or of the extensions by name
};

struct Shape {
  std::array<Member, 18> members{};  ///< room for those of the largest
  std::size_t count;                 ///< of them
  constexpr Shape(std::initializer_list<Member> list) : count(list.size()) {
    std::copy(list.begin(), list.end(), members.begin());
  }
};

namespace schema {

inline constexpr Shape texture_transform{
    {"offset", Kind::numbers}, {"rotation", Kind::number}, {"scale", Kind::numbers}, {"texCoord", Kind::integer}};
inline constexpr Shape texture_info_extensions{{"KHR_texture_transform", Kind::object, &texture_transform}};
inline constexpr Shape texture_info{
    {"extensions", Kind::extensions, &texture_info_extensions}, {"index", Kind::integer}, {"texCoord", Kind::integer}};

inline constexpr Shape metallic_roughness{{"baseColorFactor", Kind::numbers},
                                          {"baseColorTexture", Kind::object, &texture_info},
                                          {"metallicFactor", Kind::number},
                                          {"metallicRoughnessTexture", Kind::object, &texture_info},
                                          {"roughnessFactor", Kind::number}};
inline constexpr Shape specular_glossiness{{"diffuseFactor", Kind::numbers},
                                           {"diffuseTexture", Kind::object, &texture_info},
                                           {"glossinessFactor", Kind::number},
                                           {"specularFactor", Kind::numbers}};
inline constexpr Shape specular{{"specularColorFactor", Kind::numbers},
                                {"specularColorTexture", Kind::object, &texture_info},
                                {"specularFactor", Kind::number},
                                {"specularTexture", Kind::object, &texture_info}};
inline constexpr Shape transmission{{"transmissionFactor", Kind::number}};
inline constexpr Shape material_extensions{{"KHR_materials_pbrSpecularGlossiness", Kind::object, &specular_glossiness},
                                           {"KHR_materials_specular", Kind::object, &specular},
                                           {"KHR_materials_transmission", Kind::object, &transmission}};
inline constexpr Shape material{
    {"alphaCutoff", Kind::number},  {"alphaMode", Kind::text},
    {"doubleSided", Kind::boolean}, {"extensions", Kind::extensions, &material_extensions},
    {"name", Kind::text},           {"pbrMetallicRoughness", Kind::object, &metallic_roughness}};

inline constexpr Shape texture_source{{"source", Kind::integer}};
inline constexpr Shape texture_extensions{{"EXT_texture_avif", Kind::object, &texture_source},
                                          {"EXT_texture_webp", Kind::object, &texture_source},
                                          {"KHR_texture_basisu", Kind::object, &texture_source},
                                          {"MSFT_texture_dds", Kind::object, &texture_source}};
inline constexpr Shape texture{{"extensions", Kind::extensions, &texture_extensions},
                               {"name", Kind::text},
                               {"sampler", Kind::integer},
                               {"source", Kind::integer}};
inline constexpr Shape sampler{{"wrapS", Kind::integer}, {"wrapT", Kind::integer}};
inline constexpr Shape image{{"bufferView", Kind::integer}, {"name", Kind::text}, {"uri", Kind::text}};

inline constexpr Shape meshopt{{"buffer", Kind::integer},     {"byteLength", Kind::integer},
                               {"byteOffset", Kind::integer}, {"byteStride", Kind::integer},
                               {"count", Kind::integer},      {"filter", Kind::text},
                               {"mode", Kind::text}};
inline constexpr Shape view_extensions{{"EXT_meshopt_compression", Kind::object, &meshopt},
                                       {"KHR_meshopt_compression", Kind::object, &meshopt}};
inline constexpr Shape view{{"buffer", Kind::integer},
                            {"byteLength", Kind::size},
                            {"byteOffset", Kind::size},
                            {"byteStride", Kind::integer},
                            {"extensions", Kind::extensions, &view_extensions},
                            {"name", Kind::text}};
inline constexpr Shape buffer_extensions{{"EXT_meshopt_compression"}, {"KHR_meshopt_compression"}};
inline constexpr Shape buffer{
    {"byteLength", Kind::size}, {"extensions", Kind::extensions, &buffer_extensions}, {"uri", Kind::text}};

// The parser keeps the offsets of sparse accessors in ints.
inline constexpr Shape sparse_indices{
    {"bufferView", Kind::integer}, {"byteOffset", Kind::integer}, {"componentType", Kind::integer}};
inline constexpr Shape sparse_values{{"bufferView", Kind::integer}, {"byteOffset", Kind::integer}};
inline constexpr Shape sparse{
    {"count", Kind::integer}, {"indices", Kind::object, &sparse_indices}, {"values", Kind::object, &sparse_values}};
inline constexpr Shape accessor{
    {"bufferView", Kind::integer},     {"byteOffset", Kind::size}, {"componentType", Kind::integer},
    {"count", Kind::integer},          {"name", Kind::text},       {"normalized", Kind::boolean},
    {"sparse", Kind::object, &sparse}, {"type", Kind::text}};

inline constexpr Shape draco{{"attributes", Kind::indices_by_name}, {"bufferView", Kind::integer}};
inline constexpr Shape primitive_extensions{{"KHR_draco_mesh_compression", Kind::object, &draco}};
inline constexpr Shape primitive{{"attributes", Kind::indices_by_name},
                                 {"extensions", Kind::extensions, &primitive_extensions},
                                 {"extras", Kind::extras_name},
                                 {"indices", Kind::integer},
                                 {"material", Kind::integer},
                                 {"mode", Kind::integer},
                                 {"targets", Kind::targets}};
inline constexpr Shape mesh{
    {"name", Kind::text}, {"primitives", Kind::objects, &primitive}, {"weights", Kind::numbers}};
inline constexpr Shape skin{{"inverseBindMatrices", Kind::integer}, {"joints", Kind::integers}, {"name", Kind::text}};

inline constexpr Shape perspective{{"yfov", Kind::number}, {"zfar", Kind::number}, {"znear", Kind::number}};
inline constexpr Shape orthographic{
    {"xmag", Kind::number}, {"ymag", Kind::number}, {"zfar", Kind::number}, {"znear", Kind::number}};
inline constexpr Shape camera{{"name", Kind::text},
                              {"orthographic", Kind::object, &orthographic},
                              {"perspective", Kind::object, &perspective},
                              {"type", Kind::text}};

inline constexpr Shape spot{{"innerConeAngle", Kind::number}, {"outerConeAngle", Kind::number}};
inline constexpr Shape light{{"color", Kind::numbers}, {"extras", Kind::extras_emitter}, {"intensity", Kind::number},
                             {"name", Kind::text},     {"range", Kind::number},          {"spot", Kind::object, &spot},
                             {"type", Kind::text}};

inline constexpr Shape instancing{{"attributes", Kind::indices_by_name}};
inline constexpr Shape light_reference{{"light", Kind::integer}};
inline constexpr Shape visibility{{"visible", Kind::boolean}};
inline constexpr Shape node_extensions{{"EXT_mesh_gpu_instancing", Kind::object, &instancing},
                                       {"KHR_lights_punctual", Kind::object, &light_reference},
                                       {"KHR_node_visibility", Kind::object, &visibility}};
inline constexpr Shape node{{"camera", Kind::integer},
                            {"children", Kind::integers},
                            {"extensions", Kind::extensions, &node_extensions},
                            {"extras", Kind::extras_emitter},
                            {"matrix", Kind::numbers},
                            {"mesh", Kind::integer},
                            {"name", Kind::text},
                            {"rotation", Kind::numbers},
                            {"scale", Kind::numbers},
                            {"skin", Kind::integer},
                            {"translation", Kind::numbers},
                            {"weights", Kind::numbers}};
inline constexpr Shape scene{{"name", Kind::text}, {"nodes", Kind::integers}};

inline constexpr Shape lights{{"lights", Kind::objects, &light}};
inline constexpr Shape root_extensions{{"KHR_lights_punctual", Kind::object, &lights}};
inline constexpr Shape asset{{"version", Kind::anything}};
inline constexpr Shape root{{"accessors", Kind::objects, &accessor},
                            {"animations", Kind::anything},
                            {"asset", Kind::object, &asset},
                            {"bufferViews", Kind::objects, &view},
                            {"buffers", Kind::objects, &buffer},
                            {"cameras", Kind::objects, &camera},
                            {"extensions", Kind::extensions, &root_extensions},
                            {"extensionsRequired", Kind::texts},
                            {"extensionsUsed", Kind::texts},
                            {"images", Kind::objects, &image},
                            {"materials", Kind::objects, &material},
                            {"meshes", Kind::objects, &mesh},
                            {"nodes", Kind::objects, &node},
                            {"samplers", Kind::objects, &sampler},
                            {"scene", Kind::integer},
                            {"scenes", Kind::objects, &scene},
                            {"skins", Kind::objects, &skin},
                            {"textures", Kind::objects, &texture}};

}  // namespace schema
}  // namespace umbrameter::gltf
