#include <fstream>  // tiny_gltf.h forgets it without its own file access

#include "scenes/gltf_check.h"
#include "scenes/gltf_document.h"

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace umbrameter::gltf {
namespace {

using json = nlohmann::json;

void require_version(const json& root, const std::filesystem::path& path) {
  const auto asset = root.find("asset");
  const std::string version = asset != root.end() ? asset->value("version", "") : "";
  if (version.starts_with("2.")) return;
  fail(path, "asset", version.empty() ? "it has no glTF version" : "it is glTF " + version.substr(0, 16),
       "convert the file to glTF 2.0");
}

std::optional<std::string> take_text(json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional(std::move(found->get_ref<std::string&>()));
}

/// Moves a list out of the text.
json take_list(json& root, const char* key) {
  const auto found = root.find(key);
  if (found == root.end()) return json::array();
  json items = std::move(*found);
  root.erase(found);
  return items;
}

BufferSource buffer_source(json& item, const std::filesystem::path& path, std::size_t index) {
  BufferSource source;
  source.uri = take_text(item, "uri");
  const auto length = item.find("byteLength");
  if (length == item.end()) fail(path, label("buffer", index, ""), "it has no byteLength");
  source.byte_length = length->get<std::uint64_t>();
  // A fallback buffer may carry bytes for readers without the extension; they are not needed here.
  const auto extensions = item.find("extensions");
  source.is_fallback = extensions != item.end() && extensions->contains("EXT_meshopt_compression");
  return source;
}

/// The parser insists on a bufferView of every index accessor; compressed and sparse ones have none.
int stand_in_view(json& root) {
  if (!root.contains("accessors")) return -1;
  const std::size_t number = root.contains("bufferViews") ? root["bufferViews"].size() : 0;
  bool is_needed = false;
  for (json& accessor : root["accessors"]) {
    if (accessor.contains("bufferView")) continue;
    accessor["bufferView"] = number;
    is_needed = true;
  }
  if (!is_needed) return -1;
  root["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 0}});
  return static_cast<int>(number);
}

void parse(tinygltf::Model& model, const json& root, const std::filesystem::path& path) {
  const std::string text = root.dump();
  tinygltf::TinyGLTF parser;
  std::string errors;
  std::string warnings;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned int>(text.size()),
                                        "", tinygltf::NO_REQUIRE);
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!parsed) fail(path, "", "the glTF parser reports: " + (errors.empty() ? "no reason" : errors.substr(0, 400)));
}

}  // namespace

Document parse_document(const std::filesystem::path& path, const Container& container, Allowance& allowance) {
  json root = parse_text(container.json, allowance, path);
  check_document(root, path);
  require_version(root, path);
  Document document;
  document.path = path;
  document.binary = container.binary;
  document.is_animated = root.erase("animations") != 0;
  for (json& item : take_list(root, "buffers")) {
    document.buffers.push_back(buffer_source(item, path, document.buffers.size()));
  }
  for (json& item : take_list(root, "images")) {
    document.images.push_back(
        {take_text(item, "name").value_or(""), take_text(item, "uri"), item.value("bufferView", -1)});
  }
  claim_model(root, allowance, path);
  document.no_view = stand_in_view(root);
  document.model = std::make_shared<tinygltf::Model>();
  parse(*document.model, root, path);
  return document;
}

}  // namespace umbrameter::gltf
