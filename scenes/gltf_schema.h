// What the loader reads of a glTF file: the objects of glTF 2.0 and of the supported extensions, each with those of its
// members that count here. A name has a meaning only in its own object: "scale" is a list in a node, a number in a
// normal texture. Members that are not listed are neither checked nor read. Internal to scenes/gltf*.
#pragma once

#include <array>
#include <span>
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
  std::span<const Member> members;
};

namespace schema {

inline constexpr auto texture_transform_members = std::to_array<Member>(
    {{"offset", Kind::numbers}, {"rotation", Kind::number}, {"scale", Kind::numbers}, {"texCoord", Kind::integer}});
inline constexpr Shape texture_transform{texture_transform_members};
inline constexpr auto texture_info_extension_members =
    std::to_array<Member>({{"KHR_texture_transform", Kind::object, &texture_transform}});
inline constexpr Shape texture_info_extensions{texture_info_extension_members};
inline constexpr auto texture_info_members =
    std::to_array<Member>({{"extensions", Kind::extensions, &texture_info_extensions},
                           {"index", Kind::integer},
                           {"texCoord", Kind::integer}});
inline constexpr Shape texture_info{texture_info_members};

inline constexpr auto metallic_roughness_members =
    std::to_array<Member>({{"baseColorFactor", Kind::numbers},
                           {"baseColorTexture", Kind::object, &texture_info},
                           {"metallicFactor", Kind::number},
                           {"metallicRoughnessTexture", Kind::object, &texture_info},
                           {"roughnessFactor", Kind::number}});
inline constexpr Shape metallic_roughness{metallic_roughness_members};
inline constexpr auto specular_glossiness_members =
    std::to_array<Member>({{"diffuseFactor", Kind::numbers},
                           {"diffuseTexture", Kind::object, &texture_info},
                           {"glossinessFactor", Kind::number},
                           {"specularFactor", Kind::numbers}});
inline constexpr Shape specular_glossiness{specular_glossiness_members};
inline constexpr auto specular_members = std::to_array<Member>({{"specularColorFactor", Kind::numbers},
                                                                {"specularColorTexture", Kind::object, &texture_info},
                                                                {"specularFactor", Kind::number},
                                                                {"specularTexture", Kind::object, &texture_info}});
inline constexpr Shape specular{specular_members};
inline constexpr auto transmission_members = std::to_array<Member>({{"transmissionFactor", Kind::number}});
inline constexpr Shape transmission{transmission_members};
inline constexpr auto material_extension_members =
    std::to_array<Member>({{"KHR_materials_pbrSpecularGlossiness", Kind::object, &specular_glossiness},
                           {"KHR_materials_specular", Kind::object, &specular},
                           {"KHR_materials_transmission", Kind::object, &transmission}});
inline constexpr Shape material_extensions{material_extension_members};
inline constexpr auto material_members =
    std::to_array<Member>({{"alphaCutoff", Kind::number},
                           {"alphaMode", Kind::text},
                           {"doubleSided", Kind::boolean},
                           {"extensions", Kind::extensions, &material_extensions},
                           {"name", Kind::text},
                           {"pbrMetallicRoughness", Kind::object, &metallic_roughness}});
inline constexpr Shape material{material_members};

inline constexpr auto texture_source_members = std::to_array<Member>({{"source", Kind::integer}});
inline constexpr Shape texture_source{texture_source_members};
inline constexpr auto texture_extension_members =
    std::to_array<Member>({{"EXT_texture_avif", Kind::object, &texture_source},
                           {"EXT_texture_webp", Kind::object, &texture_source},
                           {"KHR_texture_basisu", Kind::object, &texture_source},
                           {"MSFT_texture_dds", Kind::object, &texture_source}});
inline constexpr Shape texture_extensions{texture_extension_members};
inline constexpr auto texture_members = std::to_array<Member>({{"extensions", Kind::extensions, &texture_extensions},
                                                               {"name", Kind::text},
                                                               {"sampler", Kind::integer},
                                                               {"source", Kind::integer}});
inline constexpr Shape texture{texture_members};
inline constexpr auto sampler_members = std::to_array<Member>({{"wrapS", Kind::integer}, {"wrapT", Kind::integer}});
inline constexpr Shape sampler{sampler_members};
inline constexpr auto image_members =
    std::to_array<Member>({{"bufferView", Kind::integer}, {"name", Kind::text}, {"uri", Kind::text}});
inline constexpr Shape image{image_members};

inline constexpr auto meshopt_members = std::to_array<Member>({{"buffer", Kind::integer},
                                                               {"byteLength", Kind::integer},
                                                               {"byteOffset", Kind::integer},
                                                               {"byteStride", Kind::integer},
                                                               {"count", Kind::integer},
                                                               {"filter", Kind::text},
                                                               {"mode", Kind::text}});
inline constexpr Shape meshopt{meshopt_members};
inline constexpr auto view_extension_members = std::to_array<Member>(
    {{"EXT_meshopt_compression", Kind::object, &meshopt}, {"KHR_meshopt_compression", Kind::object, &meshopt}});
inline constexpr Shape view_extensions{view_extension_members};
inline constexpr auto view_members = std::to_array<Member>({{"buffer", Kind::integer},
                                                            {"byteLength", Kind::size},
                                                            {"byteOffset", Kind::size},
                                                            {"byteStride", Kind::integer},
                                                            {"extensions", Kind::extensions, &view_extensions},
                                                            {"name", Kind::text}});
inline constexpr Shape view{view_members};
inline constexpr auto buffer_extension_members =
    std::to_array<Member>({{"EXT_meshopt_compression"}, {"KHR_meshopt_compression"}});
inline constexpr Shape buffer_extensions{buffer_extension_members};
inline constexpr auto buffer_members = std::to_array<Member>(
    {{"byteLength", Kind::size}, {"extensions", Kind::extensions, &buffer_extensions}, {"uri", Kind::text}});
inline constexpr Shape buffer{buffer_members};

// The parser keeps the offsets of sparse accessors in ints.
inline constexpr auto sparse_indices_members = std::to_array<Member>(
    {{"bufferView", Kind::integer}, {"byteOffset", Kind::integer}, {"componentType", Kind::integer}});
inline constexpr Shape sparse_indices{sparse_indices_members};
inline constexpr auto sparse_values_members =
    std::to_array<Member>({{"bufferView", Kind::integer}, {"byteOffset", Kind::integer}});
inline constexpr Shape sparse_values{sparse_values_members};
inline constexpr auto sparse_members = std::to_array<Member>(
    {{"count", Kind::integer}, {"indices", Kind::object, &sparse_indices}, {"values", Kind::object, &sparse_values}});
inline constexpr Shape sparse{sparse_members};
inline constexpr auto accessor_members = std::to_array<Member>({{"bufferView", Kind::integer},
                                                                {"byteOffset", Kind::size},
                                                                {"componentType", Kind::integer},
                                                                {"count", Kind::integer},
                                                                {"name", Kind::text},
                                                                {"normalized", Kind::boolean},
                                                                {"sparse", Kind::object, &sparse},
                                                                {"type", Kind::text}});
inline constexpr Shape accessor{accessor_members};

inline constexpr auto draco_members =
    std::to_array<Member>({{"attributes", Kind::indices_by_name}, {"bufferView", Kind::integer}});
inline constexpr Shape draco{draco_members};
inline constexpr auto primitive_extension_members =
    std::to_array<Member>({{"KHR_draco_mesh_compression", Kind::object, &draco}});
inline constexpr Shape primitive_extensions{primitive_extension_members};
inline constexpr auto primitive_members =
    std::to_array<Member>({{"attributes", Kind::indices_by_name},
                           {"extensions", Kind::extensions, &primitive_extensions},
                           {"extras", Kind::extras_name},
                           {"indices", Kind::integer},
                           {"material", Kind::integer},
                           {"mode", Kind::integer},
                           {"targets", Kind::targets}});
inline constexpr Shape primitive{primitive_members};
inline constexpr auto mesh_members = std::to_array<Member>(
    {{"name", Kind::text}, {"primitives", Kind::objects, &primitive}, {"weights", Kind::numbers}});
inline constexpr Shape mesh{mesh_members};
inline constexpr auto skin_members =
    std::to_array<Member>({{"inverseBindMatrices", Kind::integer}, {"joints", Kind::integers}, {"name", Kind::text}});
inline constexpr Shape skin{skin_members};

inline constexpr auto perspective_members =
    std::to_array<Member>({{"yfov", Kind::number}, {"zfar", Kind::number}, {"znear", Kind::number}});
inline constexpr Shape perspective{perspective_members};
inline constexpr auto orthographic_members = std::to_array<Member>(
    {{"xmag", Kind::number}, {"ymag", Kind::number}, {"zfar", Kind::number}, {"znear", Kind::number}});
inline constexpr Shape orthographic{orthographic_members};
inline constexpr auto camera_members = std::to_array<Member>({{"name", Kind::text},
                                                              {"orthographic", Kind::object, &orthographic},
                                                              {"perspective", Kind::object, &perspective},
                                                              {"type", Kind::text}});
inline constexpr Shape camera{camera_members};

inline constexpr auto spot_members =
    std::to_array<Member>({{"innerConeAngle", Kind::number}, {"outerConeAngle", Kind::number}});
inline constexpr Shape spot{spot_members};
inline constexpr auto light_members = std::to_array<Member>({{"color", Kind::numbers},
                                                             {"extras", Kind::extras_emitter},
                                                             {"intensity", Kind::number},
                                                             {"name", Kind::text},
                                                             {"range", Kind::number},
                                                             {"spot", Kind::object, &spot},
                                                             {"type", Kind::text}});
inline constexpr Shape light{light_members};

inline constexpr auto instancing_members = std::to_array<Member>({{"attributes", Kind::indices_by_name}});
inline constexpr Shape instancing{instancing_members};
inline constexpr auto light_reference_members = std::to_array<Member>({{"light", Kind::integer}});
inline constexpr Shape light_reference{light_reference_members};
inline constexpr auto visibility_members = std::to_array<Member>({{"visible", Kind::boolean}});
inline constexpr Shape visibility{visibility_members};
inline constexpr auto node_extension_members =
    std::to_array<Member>({{"EXT_mesh_gpu_instancing", Kind::object, &instancing},
                           {"KHR_lights_punctual", Kind::object, &light_reference},
                           {"KHR_node_visibility", Kind::object, &visibility}});
inline constexpr Shape node_extensions{node_extension_members};
inline constexpr auto node_members = std::to_array<Member>({{"camera", Kind::integer},
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
                                                            {"weights", Kind::numbers}});
inline constexpr Shape node{node_members};
inline constexpr auto scene_members = std::to_array<Member>({{"name", Kind::text}, {"nodes", Kind::integers}});
inline constexpr Shape scene{scene_members};

inline constexpr auto lights_members = std::to_array<Member>({{"lights", Kind::objects, &light}});
inline constexpr Shape lights{lights_members};
inline constexpr auto root_extension_members = std::to_array<Member>({{"KHR_lights_punctual", Kind::object, &lights}});
inline constexpr Shape root_extensions{root_extension_members};
inline constexpr auto asset_members = std::to_array<Member>({{"version", Kind::anything}});
inline constexpr Shape asset{asset_members};
inline constexpr auto root_members = std::to_array<Member>({{"accessors", Kind::objects, &accessor},
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
                                                            {"textures", Kind::objects, &texture}});
inline constexpr Shape root{root_members};

}  // namespace schema
}  // namespace umbrameter::gltf
