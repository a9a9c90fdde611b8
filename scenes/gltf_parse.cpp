// Checks the JSON text before the parser sees it: the parser takes wrong types for absent ones, cuts large integers
// and recurses without a limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>  // tiny_gltf.h forgets it without its own file access
#include <limits>

#include "scenes/gltf_document.h"

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace umbrameter::gltf {
namespace {

using json = nlohmann::json;

constexpr int max_depth = 64;

bool is_size(const std::string& key) { return key == "byteLength" || key == "byteOffset"; }

void check_number(const json& value, const std::string& key, const std::filesystem::path& path,
                  const std::string& where) {
  constexpr std::int64_t int_limit = std::numeric_limits<int>::max();
  const std::int64_t limit = is_size(key) ? std::int64_t{1} << 40 : int_limit;
  const bool fits = value.is_number_unsigned()  ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(limit)
                    : value.is_number_integer() ? value.get<std::int64_t>() >= (is_size(key) ? 0 : -limit)
                                                : std::isfinite(value.get<double>());
  if (!fits) fail(path, where, "the number " + value.dump() + " is out of range");
}

// Members whose type the parser does not insist on.
void check_type(const json& value, const std::string& key, const std::filesystem::path& path,
                const std::string& where) {
  static constexpr std::array<std::string_view, 11> index_keys = {
      "buffer", "bufferView", "byteLength", "byteOffset", "byteStride", "camera",
      "count",  "material",   "mesh",       "mode",       "indices"};
  const bool is_index = std::find(index_keys.begin(), index_keys.end(), key) != index_keys.end();
  const bool is_text = key == "name" || key == "uri";
  if (is_text && !value.is_string()) fail(path, where, "it is not a text");
  if (is_index && value.is_primitive() && !value.is_number_integer() && key != "mode") {
    fail(path, where, "it is not an integer");
  }
}

// Walks the whole text, drops extras (free-form, of no use here) and checks numbers and depth.
void check(json& value, const std::string& key, const std::filesystem::path& path, const std::string& where,
           int depth) {
  if (depth > max_depth) fail(path, where, "it is nested more than " + std::to_string(max_depth) + " levels deep");
  check_type(value, key, path, where);
  if (value.is_number()) check_number(value, key, path, where);
  if (value.is_object()) {
    // The writer keeps the name of a primitive there.
    const auto extras = value.find("extras");
    if (extras != value.end()) {
      json kept = json::object();
      if (extras->is_object() && extras->contains("name") && (*extras)["name"].is_string()) {
        kept["name"] = (*extras)["name"];
      }
      *extras = kept;
    }
    for (auto& [name, member] : value.items()) check(member, name, path, where + "/" + name, depth + 1);
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      check(value[i], "", path, where + "/" + std::to_string(i), depth + 1);
    }
  }
}

json parse_text(const std::filesystem::path& path, std::string_view text) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    fail(path, "", "it is neither binary glTF nor JSON (" + std::string(error.what()) + ")",
         "give a .gltf or .glb file that is whole");
  }
}

const json* member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::string> text_of(const json& object, const char* key) {
  const json* found = member(object, key);
  return found != nullptr && found->is_string() ? std::optional(found->get<std::string>()) : std::nullopt;
}

/// Moves an array of objects out of the text.
std::vector<json> take_array(json& root, const char* key, const std::filesystem::path& path) {
  const auto found = root.find(key);
  if (found == root.end()) return {};
  if (!found->is_array()) fail(path, key, "it is not an array");
  std::vector<json> items;
  for (json& item : *found) {
    if (!item.is_object()) fail(path, std::string(key) + " " + std::to_string(items.size()), "it is not an object");
    items.push_back(std::move(item));
  }
  root.erase(found);
  return items;
}

BufferSource buffer_source(const json& item, const std::filesystem::path& path, std::size_t index) {
  BufferSource source;
  source.uri = text_of(item, "uri");
  const json* length = member(item, "byteLength");
  if (length == nullptr || !length->is_number_unsigned()) {
    fail(path, "buffer " + std::to_string(index), "it has no byteLength");
  }
  source.byte_length = length->get<std::uint64_t>();
  if (const json* extensions = member(item, "extensions"); extensions != nullptr && extensions->is_object()) {
    // A fallback buffer may carry bytes for readers without the extension; they are not needed here.
    source.is_fallback = extensions->contains("EXT_meshopt_compression");
  }
  return source;
}

}  // namespace

Document parse_document(const std::filesystem::path& path, const Container& container) {
  json root = parse_text(path, container.json);
  if (!root.is_object()) fail(path, "", "its JSON is not an object", "give a .gltf or .glb file");
  const json* asset = member(root, "asset");
  const std::string version = asset != nullptr && asset->is_object() ? text_of(*asset, "version").value_or("") : "";
  if (!version.starts_with("2.")) {
    fail(path, "asset", version.empty() ? "it has no glTF version" : "it is glTF " + version,
         "convert the file to glTF 2.0");
  }
  Document document;
  document.path = path;
  document.binary = container.binary;
  document.is_animated = root.contains("animations") || root.contains("skins");
  root.erase("animations");
  root.erase("skins");
  check(root, "", path, "", 0);
  for (const json& item : take_array(root, "buffers", path)) {
    document.buffers.push_back(buffer_source(item, path, document.buffers.size()));
  }
  for (const json& item : take_array(root, "images", path)) {
    ImageSource source{text_of(item, "name").value_or(""), text_of(item, "uri"), -1};
    if (const json* view = member(item, "bufferView"); view != nullptr) source.buffer_view = view->get<int>();
    document.images.push_back(std::move(source));
  }
  const std::string text = root.dump();
  document.model = std::make_shared<tinygltf::Model>();
  tinygltf::TinyGLTF parser;
  std::string errors;
  std::string warnings;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(document.model.get(), &errors, &warnings, text.data(),
                                        static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!parsed) fail(path, "", "the glTF parser reports: " + (errors.empty() ? "no reason" : errors));
  return document;
}

}  // namespace umbrameter::gltf
