#include <algorithm>
#include <fstream>  // tiny_gltf.h forgets it without its own file access

#include "scenes/gltf_check.h"
#include "scenes/gltf_document.h"

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace umbrameter::gltf {
namespace {

using json = nlohmann::json;

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

/// Visits the items of a list that stays in the text, where there is one.
template <class Visit>
void for_each_in(json& holder, const char* key, const Visit& visit) {
  const auto found = holder.find(key);
  if (found == holder.end()) return;
  for (json& item : *found) visit(item);
}

BufferSource buffer_source(json& item) {
  BufferSource source;
  source.uri = take_text(item, "uri");
  if (const auto length = item.find("byteLength"); length != item.end()) {
    source.byte_length = length->get<std::uint64_t>();
  }
  // A fallback buffer may carry bytes for readers without the extension; they are not needed here.
  const auto extensions = item.find("extensions");
  source.is_fallback = extensions != item.end() &&
                       std::ranges::any_of(meshopt_names, [&](const char* name) { return extensions->contains(name); });
  return source;
}

/// Takes the strides out of the text: the parser refuses a file for any that is no multiple of four, which a viewer
/// only minds where it reads that view.
std::vector<std::size_t> take_strides(json& root) {
  std::vector<std::size_t> strides;
  for_each_in(root, "bufferViews", [&](json& view) {
    strides.push_back(static_cast<std::size_t>(std::max<std::int64_t>(0, view.value("byteStride", std::int64_t{0}))));
    view.erase("byteStride");
  });
  return strides;
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

/// The parser insists on some members that the specification gives a meaning without, or that only a part needs.
void add_required_members(json& root) {
  for_each_in(root, "meshes", [](json& mesh) {
    for_each_in(mesh, "primitives", [](json& primitive) { primitive.emplace("attributes", json::object()); });
  });
  for_each_in(root, "materials", [](json& material) {
    const auto surface = material.find("pbrMetallicRoughness");
    if (surface == material.end()) return;
    const auto texture = surface->find("baseColorTexture");
    if (texture != surface->end() && !texture->contains("index")) surface->erase(texture);
  });
  if (!root.contains("extensions") || !root["extensions"].contains("KHR_lights_punctual")) return;
  for_each_in(root["extensions"]["KHR_lights_punctual"], "lights", [](json& light) {
    if (light.value("type", "") == "spot") light.emplace("spot", json::object());
  });
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
  check_version(root, path);
  check_document(root, path);
  Document document;
  document.path = path;
  document.binary = container.binary;
  document.is_animated = root.erase("animations") != 0;
  for (json& item : take_list(root, "buffers")) {
    document.buffers.push_back(buffer_source(item));
  }
  for (json& item : take_list(root, "images")) {
    document.images.push_back(
        {take_text(item, "name").value_or(""), take_text(item, "uri"), item.value("bufferView", -1)});
  }
  claim_model(root, allowance, path);
  add_required_members(root);
  document.no_view = stand_in_view(root);
  const std::vector<std::size_t> strides = take_strides(root);
  document.model = std::make_shared<tinygltf::Model>();
  parse(*document.model, root, path);
  for (std::size_t i = 0; i < strides.size(); ++i) document.model->bufferViews[i].byteStride = strides[i];
  return document;
}

}  // namespace umbrameter::gltf
