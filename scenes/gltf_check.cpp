#include "scenes/gltf_check.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenes/gltf_emitter.h"

namespace umbrameter::gltf {
namespace {

using json = nlohmann::json;
using Path = std::filesystem::path;

constexpr int max_depth = 64;
constexpr std::uint64_t max_values = std::uint64_t{1} << 25;

/// What a parser would have to hold, found without one: what is refused never was in memory.
struct TextSize {
  std::uint64_t values = 1;  ///< at most
  int depth = 0;             ///< of lists and objects
};

TextSize measure(std::string_view text) {
  TextSize size;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
      continue;
    }
    in_string = c == '"';
    if (c == '[' || c == '{') size.depth = std::max(size.depth, ++depth);
    if (c == ']' || c == '}') --depth;
    // Each value but the first follows one of these, or a key that does.
    if (c == ',' || c == '[' || c == '{') ++size.values;
  }
  return size;
}

/// A place in the text, spelled out only when it is complained about.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::size_t index = 0;

  std::string text() const {
    if (parent == nullptr) return "";
    return parent->text() + "/" + (key.empty() ? std::to_string(index) : std::string(key.substr(0, 64)));
  }
};

enum class Kind { any, text, boolean, number, integer, size, numbers, integers, objects, integer_members, object };

struct Member {
  std::string_view name;
  Kind kind;
};
// What glTF 2.0 and the supported extensions say of a member, wherever it stands. Some names are used twice: kind_of().
constexpr auto members = std::to_array<Member>({
    {"accessors", Kind::objects},
    {"alphaCutoff", Kind::number},
    {"alphaMode", Kind::text},
    {"asset", Kind::object},
    {"attributes", Kind::integer_members},
    {"baseColorFactor", Kind::numbers},
    {"baseColorTexture", Kind::object},
    {"buffer", Kind::integer},
    {"bufferView", Kind::integer},
    {"bufferViews", Kind::objects},
    {"buffers", Kind::objects},
    {"byteLength", Kind::size},
    {"byteOffset", Kind::size},
    {"byteStride", Kind::integer},
    {"camera", Kind::integer},
    {"cameras", Kind::objects},
    {"children", Kind::integers},
    {"color", Kind::numbers},
    {"componentType", Kind::integer},
    {"count", Kind::integer},
    {"diffuseFactor", Kind::numbers},
    {"diffuseTexture", Kind::object},
    {"doubleSided", Kind::boolean},
    {"extensions", Kind::object},
    {"filter", Kind::text},
    {"glossinessFactor", Kind::number},
    {"images", Kind::objects},
    {"index", Kind::integer},
    {"indices", Kind::integer},
    {"innerConeAngle", Kind::number},
    {"intensity", Kind::number},
    {"inverseBindMatrices", Kind::integer},
    {"joints", Kind::integers},
    {"light", Kind::integer},
    {"lights", Kind::objects},
    {"magFilter", Kind::integer},
    {"material", Kind::integer},
    {"materials", Kind::objects},
    {"matrix", Kind::numbers},
    {"max", Kind::numbers},
    {"mesh", Kind::integer},
    {"meshes", Kind::objects},
    {"metallicFactor", Kind::number},
    {"min", Kind::numbers},
    {"minFilter", Kind::integer},
    {"name", Kind::text},
    {"nodes", Kind::objects},
    {"normalized", Kind::boolean},
    {"offset", Kind::numbers},
    {"orthographic", Kind::object},
    {"outerConeAngle", Kind::number},
    {"pbrMetallicRoughness", Kind::object},
    {"perspective", Kind::object},
    {"primitives", Kind::objects},
    {"range", Kind::number},
    {"rotation", Kind::numbers},
    {"roughnessFactor", Kind::number},
    {"sampler", Kind::integer},
    {"samplers", Kind::objects},
    {"scale", Kind::numbers},
    {"scene", Kind::integer},
    {"scenes", Kind::objects},
    {"skeleton", Kind::integer},
    {"skin", Kind::integer},
    {"skins", Kind::objects},
    {"source", Kind::integer},
    {"sparse", Kind::object},
    {"specularColorFactor", Kind::numbers},
    {"specularFactor", Kind::number},
    {"spot", Kind::object},
    {"targets", Kind::objects},
    {"texCoord", Kind::integer},
    {"textures", Kind::objects},
    {"translation", Kind::numbers},
    {"transmissionFactor", Kind::number},
    {"type", Kind::text},
    {"uri", Kind::text},
    {"version", Kind::text},
    {"weights", Kind::numbers},
    {"wrapS", Kind::integer},
    {"wrapT", Kind::integer},
    {"xmag", Kind::number},
    {"yfov", Kind::number},
    {"ymag", Kind::number},
    {"zfar", Kind::number},
    {"znear", Kind::number},
});

Kind kind_of(std::string_view name, std::string_view parent) {
  if (name == "nodes" && parent == "scenes") return Kind::integers;
  if (name == "indices" && parent == "sparse") return Kind::object;
  if (name == "rotation" && parent == "KHR_texture_transform") return Kind::number;
  if (name == "specularFactor" && parent == "KHR_materials_pbrSpecularGlossiness") return Kind::numbers;
  if (name == "mode") return parent == "primitives" ? Kind::integer : Kind::text;
  // The parser keeps the offsets of sparse accessors in ints.
  if (name == "byteOffset" && (parent == "indices" || parent == "values")) return Kind::integer;
  const auto found =
      std::lower_bound(members.begin(), members.end(), name,
                       [](const Member& member, std::string_view wanted) { return member.name < wanted; });
  return found != members.end() && found->name == name ? found->kind : Kind::any;
}

constexpr std::array<std::string_view, 9> supported_extensions = {"EXT_mesh_gpu_instancing",
                                                                  "EXT_meshopt_compression",
                                                                  "KHR_draco_mesh_compression",
                                                                  "KHR_lights_punctual",
                                                                  "KHR_materials_pbrSpecularGlossiness",
                                                                  "KHR_materials_specular",
                                                                  "KHR_materials_transmission",
                                                                  "KHR_mesh_quantization",
                                                                  "KHR_texture_transform"};

struct Checker {
  const Path& path;

  [[noreturn]] void reject(const Place& place, const std::string& why) const { fail(path, place.text(), why); }

  void require(bool holds, const Place& place, const char* why) const {
    if (!holds) reject(place, why);
  }

  // −1 is how some writers say that there is none.
  void integer(json& value, const Place& place, std::int64_t least, std::int64_t most) const {
    if (value.is_number_float()) {
      const double number = value.get<double>();
      // Some writers give every number a fraction.
      if (number == std::floor(number) && std::abs(number) < 1e15) value = static_cast<std::int64_t>(number);
    }
    require(value.is_number_integer(), place, "it is not an integer");
    const bool is_huge = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(most);
    if (is_huge || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most) {
      reject(place, "the number " + value.dump() + " is out of range");
    }
  }

  void index(json& value, const Place& place) const { integer(value, place, -1, std::numeric_limits<int>::max()); }

  template <class Visit>
  void each(json& list, const Place& place, const Visit& visit) const {
    require(list.is_array(), place, "it is not a list");
    for (std::size_t i = 0; i < list.size(); ++i) visit(list[i], Place{&place, {}, i});
  }

  void check(json& value, Kind kind, const Place& place) const {
    switch (kind) {
      case Kind::any:
        return;
      case Kind::text:
        return require(value.is_string(), place, "it is not a text");
      case Kind::boolean:
        return require(value.is_boolean(), place, "it is neither true nor false");
      case Kind::number:
        return require(value.is_number(), place, "it is not a number");
      case Kind::object:
        return require(value.is_object(), place, "it is not an object");
      case Kind::integer:
        return index(value, place);
      case Kind::size:
        return integer(value, place, 0, std::int64_t{1} << 40);
      case Kind::numbers:
        return each(value, place, [&](json& item, const Place& at) { check(item, Kind::number, at); });
      case Kind::integers:
        return each(value, place, [&](json& item, const Place& at) { index(item, at); });
      case Kind::objects:
        return each(value, place, [&](json& item, const Place& at) { check(item, Kind::object, at); });
      case Kind::integer_members:
        check(value, Kind::object, place);
        for (auto& [name, item] : value.items()) index(item, {&place, name, 0});
        return;
    }
  }

  // A light, or a node that places one.
  static bool is_light(const json& value, std::string_view name) {
    if (name == "lights") return true;
    const auto extensions = value.find("extensions");
    return name == "nodes" && extensions != value.end() && extensions->is_object() &&
           extensions->contains("KHR_lights_punctual");
  }

  void keep_emitter(json& extras, json& kept, const Place& place) const {
    for (const EmitterKey& key : emitter_keys) {
      const auto found = extras.find(key.name);
      if (found == extras.end()) continue;
      const Place at{&place, key.name, 0};
      check(*found, key.is_number ? Kind::number : Kind::text, at);
      // As floating point, since the parser would cut integers down to its own.
      kept[key.name] = key.is_number ? json(found->get<double>()) : std::move(*found);
    }
  }

  void walk(json& value, std::string_view name, const Place& place) const {
    if (value.is_number()) require(std::isfinite(value.get<double>()), place, "the number is out of range");
    if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        const Place item{&place, {}, i};
        if (name == "targets") check(value[i], Kind::integer_members, item);
        walk(value[i], name, item);
      }
    }
    if (!value.is_object()) return;
    if (const auto extras = value.find("extras"); extras != value.end()) {
      // The writer keeps the name of a primitive there.
      json kept = json::object();
      if (extras->is_object() && extras->contains("name") && (*extras)["name"].is_string()) {
        kept["name"] = std::move((*extras)["name"]);
      }
      if (extras->is_object() && is_light(value, name)) keep_emitter(*extras, kept, {&place, "extras", 0});
      *extras = std::move(kept);
    }
    for (auto& [member, held] : value.items()) {
      const Place inside{&place, member, 0};
      if (name == "extensions") {
        if (!is_supported(member)) held = json::object();
        check(held, Kind::object, inside);
      } else {
        check(held, kind_of(member, name), inside);
        // The parser takes its own preset for any other number of them.
        require(member != "baseColorFactor" || held.size() == 4, inside, "it is not four numbers");
      }
      walk(held, member, inside);
    }
  }
};

}  // namespace

bool is_supported(std::string_view extension) {
  return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

json parse_text(std::string_view text, Allowance& allowance, const Path& path) {
  const TextSize size = measure(text);
  const std::string remedy = "give a .gltf or .glb file that is whole";
  if (size.depth > max_depth) {
    fail(path, "JSON text", "it is nested more than " + std::to_string(max_depth) + " levels deep", remedy);
  }
  if (size.values > max_values) {
    fail(path, "JSON text", "it holds more than " + std::to_string(max_values) + " values", remedy);
  }
  // A value with its share of the list or object that holds it.
  claim(allowance, size.values * 48, path, "JSON text");
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& error) {
    fail(path, "", "it is neither binary glTF nor JSON (" + std::string(error.what()).substr(0, 200) + ")", remedy);
  }
}

void check_document(json& root, const Path& path) {
  if (!root.is_object()) fail(path, "", "its JSON is not an object", "give a .gltf or .glb file");
  static constexpr auto unused = [](const std::string& key) {
    return kind_of(key, {}) == Kind::any && key != "extensionsUsed" && key != "extensionsRequired";
  };
  for (auto member = root.begin(); member != root.end();) {
    member = unused(member.key()) && member.key() != "animations" ? root.erase(member) : std::next(member);
  }
  Checker{path}.walk(root, {}, {});
}

void claim_model(const json& root, Allowance& allowance, const Path& path) {
  const auto claim_list = [&](const json& holder, const char* key, std::size_t bytes, const std::string& where) {
    const auto found = holder.find(key);
    if (found == holder.end() || !found->is_array()) return;
    // Lists grow by doubling.
    claim(allowance, 2 * std::uint64_t{bytes} * found->size(), path, where + key);
  };
  claim_list(root, "accessors", sizeof(tinygltf::Accessor), "");
  claim_list(root, "bufferViews", sizeof(tinygltf::BufferView), "");
  claim_list(root, "cameras", sizeof(tinygltf::Camera), "");
  claim_list(root, "materials", sizeof(tinygltf::Material), "");
  claim_list(root, "meshes", sizeof(tinygltf::Mesh), "");
  claim_list(root, "nodes", sizeof(tinygltf::Node), "");
  claim_list(root, "samplers", sizeof(tinygltf::Sampler), "");
  claim_list(root, "scenes", sizeof(tinygltf::Scene), "");
  claim_list(root, "skins", sizeof(tinygltf::Skin), "");
  claim_list(root, "textures", sizeof(tinygltf::Texture), "");
  const auto meshes = root.find("meshes");
  if (meshes == root.end()) return;
  for (const json& mesh : *meshes) claim_list(mesh, "primitives", sizeof(tinygltf::Primitive), "meshes: ");
}

}  // namespace umbrameter::gltf
