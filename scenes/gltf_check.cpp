#include "scenes/gltf_check.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "scenes/gltf_emitter.h"
#include "scenes/gltf_schema.h"

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

constexpr std::array<std::string_view, 11> supported_extensions = {"EXT_mesh_gpu_instancing",
                                                                   "EXT_meshopt_compression",
                                                                   "KHR_draco_mesh_compression",
                                                                   "KHR_lights_punctual",
                                                                   "KHR_materials_pbrSpecularGlossiness",
                                                                   "KHR_materials_specular",
                                                                   "KHR_materials_transmission",
                                                                   "KHR_mesh_quantization",
                                                                   "KHR_meshopt_compression",
                                                                   "KHR_node_visibility",
                                                                   "KHR_texture_transform"};

struct Checker {
  const Path& path;

  [[noreturn]] void reject(const Place& place, const std::string& why) const { fail(path, place.text(), why); }

  void require(bool holds, const Place& place, const char* why) const {
    if (!holds) reject(place, why);
  }

  // −1 is how some writers say that there is none.
  void integer(json& value, const Place& place, std::int64_t min, std::int64_t max) const {
    if (value.is_number_float()) {
      const double number = value.get<double>();
      // Some writers give every number a fraction.
      if (number == std::floor(number) && std::abs(number) < 1e15) value = static_cast<std::int64_t>(number);
    }
    require(value.is_number_integer(), place, "it is not an integer");
    const bool is_huge = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(max);
    if (is_huge || value.get<std::int64_t>() < min || value.get<std::int64_t>() > max) {
      reject(place, "the number " + value.dump() + " is out of range");
    }
  }

  void index(json& value, const Place& place) const { integer(value, place, -1, std::numeric_limits<int>::max()); }

  template <class Visit>
  void each(json& list, const Place& place, const Visit& visit) const {
    require(list.is_array(), place, "it is not a list");
    for (std::size_t i = 0; i < list.size(); ++i) visit(list[i], Place{&place, {}, i});
  }

  void check(json& value, const Member& member, const Place& place) const {
    switch (member.kind) {
      case Kind::anything:
        return;
      case Kind::text:
        return require(value.is_string(), place, "it is not a text");
      case Kind::texts:
        return keep_texts(value, place);
      case Kind::boolean:
        return require(value.is_boolean(), place, "it is neither true nor false");
      case Kind::number:
        return check_number(value, place);
      case Kind::integer:
        return index(value, place);
      case Kind::size:
        return integer(value, place, 0, std::int64_t{1} << 40);
      case Kind::numbers:
        return each(value, place, [&](json& item, const Place& at) { check_number(item, at); });
      case Kind::integers:
        return each(value, place, [&](json& item, const Place& at) { index(item, at); });
      case Kind::indices_by_name:
        return check_indices(value, place);
      case Kind::targets:
        return each(value, place, [&](json& item, const Place& at) { check_indices(item, at); });
      case Kind::object:
        return check_object(value, *member.shape, place);
      case Kind::objects:
        return each(value, place, [&](json& item, const Place& at) { check_object(item, *member.shape, at); });
      case Kind::extensions:
        if (!value.is_object()) value = json::object();
        return check_object(value, *member.shape, place);
      case Kind::extras_name:
        return keep_name(value);
      case Kind::extras_emitter:
        return keep_emitter(value, place);
    }
  }

  void check_number(const json& value, const Place& place) const {
    require(value.is_number(), place, "it is not a number");
    require(std::isfinite(value.get<double>()), place, "the number is out of range");
  }

  void check_indices(json& value, const Place& place) const {
    require(value.is_object(), place, "it is not an object");
    for (auto& [name, item] : value.items()) index(item, {&place, name, 0});
  }

  static const Member* find(const Shape& shape, std::string_view name) {
    const auto end = shape.members.begin() + shape.count;
    const auto found =
        std::find_if(shape.members.begin(), end, [&](const Member& member) { return member.name == name; });
    return found == end ? nullptr : &*found;
  }

  // Erases what the shape does not list, and what is null, which readers take for absent.
  void check_object(json& value, const Shape& shape, const Place& place) const {
    require(value.is_object(), place, "it is not an object");
    if (&shape == &schema::node && !places_light(value)) value.erase("extras");
    for (auto item = value.begin(); item != value.end();) {
      const Member* const member = find(shape, item.key());
      if (member == nullptr || item->is_null()) {
        item = value.erase(item);
        continue;
      }
      const Place inside{&place, item.key(), 0};
      check(*item, *member, inside);
      // The parser takes its own preset for any other number of them.
      require(member->name != "baseColorFactor" || item->size() == 4, inside, "it is not four numbers");
      ++item;
    }
  }

  // Extras of other nodes may hold anything.
  static bool places_light(const json& node) {
    const auto extensions = node.find("extensions");
    return extensions != node.end() && extensions->is_object() && extensions->contains("KHR_lights_punctual");
  }

  void keep_texts(json& value, const Place& place) const {
    require(value.is_array(), place, "it is not a list");
    json kept = json::array();
    for (json& item : value) {
      if (item.is_string()) kept.push_back(std::move(item));
    }
    value = std::move(kept);
  }

  static void keep_name(json& extras) {
    json kept = json::object();
    if (extras.is_object() && extras.contains("name") && extras["name"].is_string()) {
      kept["name"] = std::move(extras["name"]);
    }
    extras = std::move(kept);
  }

  void keep_emitter(json& extras, const Place& place) const {
    json kept = json::object();
    for (const EmitterKey& key : emitter_keys) {
      const auto found = extras.is_object() ? extras.find(key.name) : extras.end();
      if (found == extras.end()) continue;
      check(*found, {key.name, key.is_number ? Kind::number : Kind::text}, {&place, key.name, 0});
      // As floating point, since the parser would cut integers down to its own.
      kept[key.name] = key.is_number ? json(found->get<double>()) : std::move(*found);
    }
    extras = std::move(kept);
  }
};

constexpr const char* dictionaries_of_version_1[] = {"accessors", "bufferViews", "buffers",
                                                     "meshes",    "nodes",       "scenes"};

// A text such as "2.0"; some writers give a number. Empty where there is neither.
std::string version_of(const json& root, const char* key) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains(key)) return "";
  const json& value = asset->at(key);
  if (value.is_number()) return value.dump();
  return value.is_string() ? value.get<std::string>() : "";
}

/// Major and minor number; 0 for what is none.
std::pair<int, int> numbers_of(const std::string& version) {
  std::pair<int, int> numbers{0, 0};
  const char* const end = version.data() + version.size();
  const char* const dot = std::from_chars(version.data(), end, numbers.first).ptr;
  if (dot != end && *dot == '.') std::from_chars(dot + 1, end, numbers.second);
  return numbers;
}

// glTF 1.0 keeps its things in objects, by name, and does not require the version.
bool is_version_1(const json& root) {
  return std::ranges::any_of(dictionaries_of_version_1, [&](const char* key) {
    const auto found = root.find(key);
    return found != root.end() && found->is_object();
  });
}

}  // namespace

bool is_supported(std::string_view extension) {
  return std::ranges::find(supported_extensions, extension) != supported_extensions.end();
}

json parse_text(std::string_view text, Allowance& allowance, const Path& path) {
  const TextSize size = measure(text);
  const std::string remedy = "give a complete .gltf or .glb file";
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
    const std::string message = error.what();
    const std::size_t start = message.find("] ") + 2;  // after the exception's name
    fail(path, "", "it is neither binary glTF nor JSON (" + message.substr(start, 200) + ")", remedy);
  }
}

void check_version(const json& root, const Path& path) {
  if (!root.is_object()) fail(path, "", "its JSON is not an object", "give a .gltf or .glb file");
  const std::string version = version_of(root, "version");
  if (version.empty() && !is_version_1(root)) fail(path, "asset", "it has no glTF version", "convert to glTF 2.0");
  if (const std::string known = version.empty() ? "1.0" : version; numbers_of(known).first != 2) {
    fail(path, "asset", "it is glTF " + known.substr(0, 16), "convert to 2.0");
  }
  const std::string min_version = version_of(root, "minVersion");
  if (numbers_of(min_version) > std::pair(2, 0)) {
    fail(path, "asset", "its minVersion is glTF " + min_version.substr(0, 16) + ", and this program reads 2.0",
         "export it as glTF 2.0");
  }
}

void check_document(json& root, const Path& path) { Checker{path}.check_object(root, schema::root, {}); }

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
