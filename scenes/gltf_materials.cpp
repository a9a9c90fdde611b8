#include "scenes/gltf_materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace umbrameter::gltf {
namespace {

using tinygltf::Value;

AlphaMode to_alpha_mode(const std::string& mode, const Document& document, const std::string& object) {
  if (mode.empty() || mode == "OPAQUE") return AlphaMode::opaque;
  if (mode == "MASK") return AlphaMode::mask;
  if (mode == "BLEND") return AlphaMode::blend;
  fail(document.path, object, "unknown alphaMode '" + mode.substr(0, 60) + "'");
}

const Value* member(const Value& object, const char* key) { return object.Has(key) ? &object.Get(key) : nullptr; }

/// Numbers of a factor, `preset` where it is absent; `what` names it in messages.
template <std::size_t Count>
std::array<float, Count> factor(const Value* value, const std::array<float, Count>& preset, const char* what,
                                const Document& document, const std::string& object) {
  if (value == nullptr) return preset;
  std::array<float, Count> numbers{};
  bool fits = Count == 1 ? value->IsNumber() : value->IsArray() && value->ArrayLen() == Count;
  for (std::size_t i = 0; fits && i < Count; ++i) {
    const Value& number = Count == 1 ? *value : value->Get<Value::Array>()[i];
    numbers[i] = number.IsNumber() ? static_cast<float>(number.GetNumberAsDouble()) : -1.0f;
    fits = std::isfinite(numbers[i]) && numbers[i] >= 0.0f;
  }
  if (!fits) {
    fail(document.path, object,
         std::string("its ") + what + " is not " + std::to_string(Count) + " finite numbers of at least 0");
  }
  return numbers;
}

vec3 to_vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
vec4 to_vec4(const std::array<float, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

vec2 pair_of(const Value& transform, const char* key, vec2 preset, const Document& document,
             const std::string& object) {
  const Value* value = member(transform, key);
  if (value == nullptr) return preset;
  const bool fits = value->IsArray() && value->ArrayLen() == 2 && value->Get(0).IsNumber() && value->Get(1).IsNumber();
  if (!fits) fail(document.path, object, std::string("the ") + key + " of its texture transform is not two numbers");
  return {static_cast<float>(value->Get(0).GetNumberAsDouble()), static_cast<float>(value->Get(1).GetNumberAsDouble())};
}

void read_transform(const Value& transform, TexcoordUse& use, const Document& document, const std::string& object) {
  use.is_moved = true;
  use.offset = pair_of(transform, "offset", use.offset, document, object);
  use.scale = pair_of(transform, "scale", use.scale, document, object);
  if (const Value* rotation = member(transform, "rotation")) {
    use.rotation = static_cast<float>(rotation->GetNumberAsDouble());
  }
  if (const Value* set = member(transform, "texCoord")) use.set = set->GetNumberAsInt();
  const float sum = use.offset.x + use.offset.y + use.scale.x + use.scale.y + use.rotation;
  if (!std::isfinite(sum)) fail(document.path, object, "its texture transform is not finite");
}

TextureReference reference_to(const tinygltf::TextureInfo& info, const Document& document, const std::string& object) {
  TextureReference reference{info.index, {info.texCoord}};
  const auto transform = info.extensions.find("KHR_texture_transform");
  if (transform != info.extensions.end()) read_transform(transform->second, reference.use, document, object);
  return reference;
}

TextureReference reference_to(const Value* info, const Document& document, const std::string& object) {
  TextureReference reference;
  if (info == nullptr) return reference;
  if (const Value* index = member(*info, "index")) reference.texture = index->GetNumberAsInt();
  if (const Value* set = member(*info, "texCoord")) reference.use.set = set->GetNumberAsInt();
  const Value* extensions = member(*info, "extensions");
  const Value* transform = extensions == nullptr ? nullptr : member(*extensions, "KHR_texture_transform");
  if (transform != nullptr) read_transform(*transform, reference.use, document, object);
  return reference;
}

// KHR_materials_pbrSpecularGlossiness as the material that reflects the same: no metal, F0 = 0.04 · specular colour.
TextureReference read_specular_glossiness(const Value& source, Material& material, const Document& document,
                                          const std::string& object) {
  const auto number = [&](const char* key) { return member(source, key); };
  material.base_color = to_vec4(factor<4>(number("diffuseFactor"), {1, 1, 1, 1}, "diffuseFactor", document, object));
  const vec3 f0 = to_vec3(factor<3>(number("specularFactor"), {1, 1, 1}, "specularFactor", document, object));
  material.metallic = 0.0f;
  material.roughness =
      1.0f - std::min(1.0f, factor<1>(number("glossinessFactor"), {1}, "glossinessFactor", document, object)[0]);
  material.specular_color = f0 / dielectric_f0;
  return reference_to(number("diffuseTexture"), document, object);
}

void read_specular(const Value& source, Material& material, TextureReferences& textures, const Document& document,
                   const std::string& object) {
  textures[2] = reference_to(member(source, "specularTexture"), document, object);
  textures[3] = reference_to(member(source, "specularColorTexture"), document, object);
  material.specular = factor<1>(member(source, "specularFactor"), {1}, "specularFactor", document, object)[0];
  material.specular_color =
      to_vec3(factor<3>(member(source, "specularColorFactor"), {1, 1, 1}, "specularColorFactor", document, object));
}

TextureReferences read_metallic_roughness(const tinygltf::PbrMetallicRoughness& source, Material& material,
                                          const Document& document, const std::string& object) {
  const std::vector<double>& color = source.baseColorFactor;
  const bool usable =
      std::ranges::all_of(color, [](double value) { return std::isfinite(static_cast<float>(value)) && value >= 0.0; });
  if (!usable) fail(document.path, object, "its baseColorFactor is not of finite numbers of at least 0");
  for (int i = 0; i < 4; ++i) material.base_color[i] = static_cast<float>(color[static_cast<std::size_t>(i)]);
  material.metallic = std::clamp(static_cast<float>(source.metallicFactor), 0.0f, 1.0f);
  material.roughness = std::clamp(static_cast<float>(source.roughnessFactor), 0.0f, 1.0f);
  return {reference_to(source.baseColorTexture, document, object),
          reference_to(source.metallicRoughnessTexture, document, object),
          {},
          {}};
}

TextureReferences read_material(const tinygltf::Material& source, Material& material, const Document& document,
                                const std::string& object) {
  material.name = source.name;
  material.alpha_mode = to_alpha_mode(source.alphaMode, document, object);
  material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  material.double_sided = source.doubleSided;
  TextureReferences textures = read_metallic_roughness(source.pbrMetallicRoughness, material, document, object);
  if (const auto found = source.extensions.find("KHR_materials_specular"); found != source.extensions.end()) {
    read_specular(found->second, material, textures, document, object);
  }
  if (const auto found = source.extensions.find("KHR_materials_transmission"); found != source.extensions.end()) {
    const Value* const given = member(found->second, "transmissionFactor");
    material.transmission = std::min(1.0f, factor<1>(given, {0}, "transmissionFactor", document, object)[0]);
  }
  const auto found = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (found != source.extensions.end()) {
    textures = {read_specular_glossiness(found->second, material, document, object), {}, {}, {}};
  }
  return textures;
}

}  // namespace

// KHR_texture_transform, "Overview": scale, then rotation, then offset.
vec2 moved(const TexcoordUse& use, const vec2& texcoord) {
  const float c = std::cos(use.rotation);
  const float s = std::sin(use.rotation);
  const vec2 scaled = use.scale * texcoord;
  return use.offset + vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

TexcoordUse texcoords_of(const TextureReferences& references) {
  for (const TextureReference& reference : references) {
    if (reference.texture != -1) return reference.use;
  }
  return {};
}

std::vector<TextureReferences> read_materials(const Document& document, const LoadOptions& options, Scene& scene) {
  const tinygltf::Model& model = *document.model;
  std::vector<TextureReferences> all;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const std::string object = label("material", i, model.materials[i].name);
    Material& material = scene.materials.emplace_back();
    TextureReferences& references = all.emplace_back(read_material(model.materials[i], material, document, object));
    if (!options.materials) references = {references.front(), {}, {}, {}};
    for (const TextureReference& reference : references) {
      if (reference.texture == -1) continue;
      checked_index(reference.texture, model.textures.size(), "texture", document.path, object);
    }
  }
  return all;
}

}  // namespace umbrameter::gltf
