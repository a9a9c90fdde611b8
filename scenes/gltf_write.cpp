#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "core/lists.h"
#include "scenes/gltf.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_emitter.h"
#include "scenes/gltf_json.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

using gltf::array;
using gltf::Json;
using gltf::Members;
using gltf::object;
using gltf::to_json;

// glTF 2.0: component types, buffer view targets, samplers.
constexpr std::size_t type_ushort = 5123;
constexpr std::size_t type_uint = 5125;
constexpr std::size_t type_float = 5126;
constexpr std::size_t target_vertices = 34962;
constexpr std::size_t target_indices = 34963;
constexpr std::size_t filter_linear = 9729;
constexpr std::string_view lights_name = "KHR_lights_punctual";
constexpr std::string_view specular_name = "KHR_materials_specular";
constexpr std::string_view transmission_name = "KHR_materials_transmission";

void add_name(Members& members, const std::string& name) {
  if (!name.empty()) members.emplace_back("name", to_json(std::string_view(name)));
}

template <class Vector>
Json numbers(const Vector& vector) {
  std::vector<Json> items;
  for (int i = 0; i < Vector::length(); ++i) items.push_back(to_json(static_cast<double>(vector[i])));
  return array(items);
}

/// The accessors of one Mesh.
struct MeshAccessors {
  Members attributes;
  std::size_t indices = 0;
};

struct Writer {
  const Scene& scene;
  gltf::Bytes binary;
  std::vector<Json> views;
  std::vector<Json> accessors;
  std::vector<MeshAccessors> meshes;

  std::size_t add_view(const void* data, std::size_t size, std::size_t target) {
    Members view{
        {"buffer", to_json(std::size_t{0})}, {"byteOffset", to_json(binary.size())}, {"byteLength", to_json(size)}};
    if (target != 0) view.emplace_back("target", to_json(target));
    const auto* bytes = static_cast<const unsigned char*>(data);
    binary.insert(binary.end(), bytes, bytes + size);
    binary.resize((binary.size() + 3) / 4 * 4);
    views.push_back(object(view));
    return views.size() - 1;
  }

  template <class T>
  std::size_t add_accessor(const std::vector<T>& values, std::size_t count, std::size_t component, const char* type,
                           std::size_t target, const Members& limits = {}) {
    const std::size_t view = add_view(values.data(), values.size() * sizeof(T), target);
    Members accessor{{"bufferView", to_json(view)},
                     {"componentType", to_json(component)},
                     {"count", to_json(count)},
                     {"type", to_json(std::string_view(type))}};
    accessor.insert(accessor.end(), limits.begin(), limits.end());
    accessors.push_back(object(accessor));
    return accessors.size() - 1;
  }

  std::size_t add_indices(const Mesh& mesh) {
    const std::size_t corners = 3 * mesh.triangles.size();
    // The largest value of a type would restart a strip.
    if (mesh.positions.size() >= 0xffff) {
      return add_accessor(mesh.triangles, corners, type_uint, "SCALAR", target_indices);
    }
    std::vector<std::uint16_t> narrow;
    narrow.reserve(corners);
    for (const uvec3& t : mesh.triangles) {
      for (int c = 0; c < 3; ++c) narrow.push_back(static_cast<std::uint16_t>(t[c]));
    }
    return add_accessor(narrow, corners, type_ushort, "SCALAR", target_indices);
  }

  MeshAccessors add_mesh(const Mesh& mesh) {
    assert(!mesh.positions.empty() && !mesh.triangles.empty());
    vec3 min = mesh.positions.front();
    vec3 max = min;
    for (const vec3& position : mesh.positions) {
      min = glm::min(min, position);
      max = glm::max(max, position);
    }
    const std::size_t vertices = mesh.positions.size();
    const Members limits{{"min", numbers(min)}, {"max", numbers(max)}};
    MeshAccessors stored{
        {{"POSITION", to_json(add_accessor(mesh.positions, vertices, type_float, "VEC3", target_vertices, limits))}}};
    if (!mesh.normals.empty()) {
      const std::size_t normals = add_accessor(mesh.normals, vertices, type_float, "VEC3", target_vertices);
      stored.attributes.emplace_back("NORMAL", to_json(normals));
    }
    if (!mesh.texcoords.empty()) {
      const std::size_t texcoords = add_accessor(mesh.texcoords, vertices, type_float, "VEC2", target_vertices);
      stored.attributes.emplace_back("TEXCOORD_0", to_json(texcoords));
    }
    stored.indices = add_indices(mesh);
    return stored;
  }

  Json primitive(std::uint32_t index, const std::string& mesh_name) const {
    const Mesh& mesh = scene.meshes[index];
    Members members{{"attributes", object(meshes[index].attributes)},
                    {"indices", to_json(meshes[index].indices)},
                    {"material", to_json(std::size_t{mesh.material})}};
    // glTF gives primitives no name of their own.
    if (mesh.name != mesh_name) {
      members.emplace_back("extras", object({{"name", to_json(std::string_view(mesh.name))}}));
    }
    return object(members);
  }
};

/// One node with a mesh: instances of one object at one place.
struct Placed {
  std::uint32_t object = 0;
  dmat4 transform{1.0};
  std::vector<std::uint32_t> meshes;
};

using Bits = std::array<std::uint64_t, 16>;

bool same_bits(const dmat4& a, const dmat4& b) { return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b); }

std::vector<Placed> placed_objects(const Scene& scene) {
  std::vector<std::vector<const Instance*>> of_object(scene.objects.size());
  for (const Instance& instance : scene.instances) of_object[instance.object].push_back(&instance);
  std::vector<Placed> placed;
  for (std::uint32_t number = 0; number < of_object.size(); ++number) {
    std::map<Bits, std::size_t> places;
    for (const Instance* instance : of_object[number]) {
      const auto [place, is_new] = places.try_emplace(std::bit_cast<Bits>(instance->world_from_mesh), placed.size());
      if (is_new) placed.push_back({number, instance->world_from_mesh, {}});
      placed[place->second].meshes.push_back(instance->mesh);
    }
  }
  return placed;
}

using Groups = std::vector<std::vector<std::uint32_t>>;

/// The glTF meshes: a distinct list of Scene meshes each, in an order that numbers those as the scene does.
Groups mesh_groups(const Scene& scene, const std::vector<Placed>& placed) {
  std::set<std::vector<std::uint32_t>> distinct;
  std::vector<char> used(scene.meshes.size(), 0);
  for (const Placed& node : placed) {
    distinct.insert(node.meshes);
    for (const std::uint32_t mesh : node.meshes) used[mesh] = 1;
  }
  for (std::uint32_t mesh = 0; mesh < used.size(); ++mesh) {
    if (used[mesh] == 0) distinct.insert({mesh});
  }
  Groups groups(distinct.begin(), distinct.end());
  std::uint32_t next = 0;
  std::vector<char> seen(scene.meshes.size(), 0);
  bool in_order = true;
  for (const auto& group : groups) {
    for (const std::uint32_t mesh : group) {
      if (seen[mesh] != 0) continue;
      seen[mesh] = 1;
      in_order = in_order && mesh == next++;
    }
  }
  if (in_order) return groups;
  Groups singles;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) singles.push_back({mesh});
  for (auto& group : groups) {
    if (group.size() > 1) singles.push_back(std::move(group));
  }
  return singles;
}

Json matrix(const dmat4& transform) {
  std::vector<Json> items;
  for (int i = 0; i < 16; ++i) items.push_back(to_json(transform[i / 4][i % 4]));
  return array(items);
}

Json node(const std::string& name, const dmat4& transform, std::string_view key, const Json& value,
          const Members& extras = {}) {
  Members members;
  add_name(members, name);
  if (!same_bits(transform, dmat4(1.0))) members.emplace_back("matrix", matrix(transform));
  members.emplace_back(key, value);
  if (!extras.empty()) members.emplace_back("extras", object(extras));
  return object(members);
}

std::size_t wrap_code(Wrap wrap) {
  switch (wrap) {
    case Wrap::mirrored_repeat:
      return 33648;
    case Wrap::clamp_to_edge:
      return 33071;
    case Wrap::repeat:
      break;
  }
  return 10497;
}

bool has_specular(const Material& material) {
  return material.specular != 1.0f || material.specular_color != vec3(1.0f) || material.specular_texture ||
         material.specular_color_texture;
}

bool transmits(const Material& material) { return material.transmission > 0.0f; }

void add_texture(Members& members, std::string_view key, const std::optional<std::uint32_t>& texture) {
  if (texture) members.emplace_back(key, object({{"index", to_json(std::size_t{*texture})}}));
}

Json specular(const Material& source) {
  Members members{{"specularFactor", to_json(static_cast<double>(source.specular))},
                  {"specularColorFactor", numbers(source.specular_color)}};
  add_texture(members, "specularTexture", source.specular_texture);
  add_texture(members, "specularColorTexture", source.specular_color_texture);
  return object(members);
}

Json material(const Material& source) {
  Members surface{{"baseColorFactor", numbers(source.base_color)},
                  {"metallicFactor", to_json(static_cast<double>(source.metallic))},
                  {"roughnessFactor", to_json(static_cast<double>(source.roughness))}};
  add_texture(surface, "baseColorTexture", source.base_color_texture);
  add_texture(surface, "metallicRoughnessTexture", source.metallic_roughness_texture);
  Members members;
  add_name(members, source.name);
  members.emplace_back("pbrMetallicRoughness", object(surface));
  if (source.alpha_mode == AlphaMode::blend) members.emplace_back("alphaMode", "\"BLEND\"");
  // Only MASK may carry a cutoff (glTF 2.0, section 5.19.8).
  if (source.alpha_mode == AlphaMode::mask) {
    members.emplace_back("alphaMode", "\"MASK\"");
    members.emplace_back("alphaCutoff", to_json(static_cast<double>(source.alpha_cutoff)));
  }
  if (source.double_sided) members.emplace_back("doubleSided", "true");
  Members extensions;
  if (has_specular(source)) extensions.insert(extensions.end(), {{specular_name, specular(source)}});
  if (transmits(source)) {
    const Json factor = to_json(static_cast<double>(source.transmission));
    extensions.insert(extensions.end(), {{transmission_name, object({{"transmissionFactor", factor}})}});
  }
  if (!extensions.empty()) members.emplace_back("extensions", object(extensions));
  return object(members);
}

Json camera(const Camera& source) {
  Members members;
  add_name(members, source.name);
  if (const auto* parallel = std::get_if<OrthographicProjection>(&source.projection)) {
    members.emplace_back("type", "\"orthographic\"");
    members.emplace_back("orthographic", object({{"xmag", to_json(parallel->half_width)},
                                                 {"ymag", to_json(parallel->half_height)},
                                                 {"znear", to_json(parallel->near_plane)},
                                                 {"zfar", to_json(parallel->far_plane)}}));
    return object(members);
  }
  const auto& lens = std::get<PerspectiveProjection>(source.projection);
  Members perspective{{"yfov", to_json(lens.vertical_fov)}, {"znear", to_json(lens.near_plane)}};
  if (std::isfinite(lens.far_plane)) perspective.emplace_back("zfar", to_json(lens.far_plane));
  members.emplace_back("type", "\"perspective\"");
  members.emplace_back("perspective", object(perspective));
  return object(members);
}

Json light(const Light& source) {
  Members members;
  add_name(members, source.name);
  members.emplace_back("color", numbers(source.color));
  members.emplace_back("intensity", to_json(source.intensity));
  double range = 0.0;
  if (const auto* point = std::get_if<PointLight>(&source.shape)) {
    range = point->range;
  } else if (const auto* spot = std::get_if<SpotLight>(&source.shape)) {
    range = spot->range;
    members.emplace_back("spot", object({{"innerConeAngle", to_json(spot->inner_cone_angle)},
                                         {"outerConeAngle", to_json(spot->outer_cone_angle)}}));
  }
  members.emplace_back("type", to_json(kind_of(source)));
  if (range > 0.0) members.emplace_back("range", to_json(range));
  return object(members);
}

void add_array(Members& members, std::string_view key, const std::vector<Json>& items) {
  if (!items.empty()) members.emplace_back(key, array(items));
}

}  // namespace

std::vector<unsigned char> to_glb(const Scene& scene) {
  Writer writer{scene, {}, {}, {}, {}};
  for (const Mesh& mesh : scene.meshes) writer.meshes.push_back(writer.add_mesh(mesh));

  const std::vector<Placed> placed = placed_objects(scene);
  const Groups groups = mesh_groups(scene, placed);
  std::vector<Json> meshes;
  for (const auto& group : groups) {
    const std::string& name = scene.meshes[group.front()].name;
    const std::vector<Json> primitives =
        mapped(group, [&](const std::uint32_t index) { return writer.primitive(index, name); });
    Members members;
    add_name(members, name);
    members.emplace_back("primitives", array(primitives));
    meshes.push_back(object(members));
  }

  std::map<std::vector<std::uint32_t>, std::size_t> numbers_of_groups;
  for (std::size_t i = 0; i < groups.size(); ++i) numbers_of_groups.emplace(groups[i], i);
  std::vector<Json> nodes = mapped(placed, [&](const Placed& place) {
    return node(scene.objects[place.object].name, place.transform, "mesh", to_json(numbers_of_groups.at(place.meshes)));
  });
  std::vector<Json> cameras;
  for (const Camera& source : scene.cameras) {
    nodes.push_back(node(source.name, source.world_from_camera, "camera", to_json(cameras.size())));
    cameras.push_back(camera(source));
  }
  std::vector<Json> lights;
  for (const Light& source : scene.lights) {
    const Json reference = object({{lights_name, object({{"light", to_json(lights.size())}})}});
    nodes.push_back(node(source.name, source.world_from_light, "extensions", reference, gltf::emitter_extras(source)));
    lights.push_back(light(source));
  }
  std::vector<Json> materials = mapped(scene.materials, [](const Material& source) { return material(source); });
  std::vector<Json> images, samplers, textures;
  for (const Texture& source : scene.textures) {
    const gltf::Bytes png = gltf::encode_png(source.texels);
    const Json index = to_json(images.size());
    images.push_back(
        object({{"bufferView", to_json(writer.add_view(png.data(), png.size(), 0))}, {"mimeType", "\"image/png\""}}));
    samplers.push_back(object({{"magFilter", to_json(filter_linear)},
                               {"minFilter", to_json(filter_linear)},
                               {"wrapS", to_json(wrap_code(source.wrap_u))},
                               {"wrapT", to_json(wrap_code(source.wrap_v))}}));
    Members members;
    add_name(members, source.name);
    members.emplace_back("sampler", index);
    members.emplace_back("source", index);
    textures.push_back(object(members));
  }

  std::vector<Json> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(to_json(i));
  Members stage;
  add_name(stage, scene.name);
  add_array(stage, "nodes", roots);
  Members root{{"asset", object({{"version", "\"2.0\""}, {"generator", "\"umbrameter\""}})},
               {"scene", to_json(std::size_t{0})},
               {"scenes", array({object(stage)})}};
  std::vector<Json> extensions;
  const auto declare = [&](std::string_view name, bool is_used) {
    if (is_used) extensions.push_back(to_json(name));
  };
  declare(lights_name, !lights.empty());
  declare(specular_name, std::ranges::any_of(scene.materials, has_specular));
  declare(transmission_name, std::ranges::any_of(scene.materials, transmits));
  add_array(root, "extensionsUsed", extensions);
  if (!lights.empty()) {
    root.emplace_back("extensions", object({{lights_name, object({{"lights", array(lights)}})}}));
  }
  add_array(root, "nodes", nodes);
  add_array(root, "meshes", meshes);
  add_array(root, "cameras", cameras);
  add_array(root, "materials", materials);
  add_array(root, "textures", textures);
  add_array(root, "images", images);
  add_array(root, "samplers", samplers);
  add_array(root, "accessors", writer.accessors);
  add_array(root, "bufferViews", writer.views);
  if (!writer.binary.empty())
    root.emplace_back("buffers", array({object({{"byteLength", to_json(writer.binary.size())}})}));
  return gltf::join_container(object(root), writer.binary);
}

}  // namespace umbrameter
