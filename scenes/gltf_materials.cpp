#include "scenes/gltf_materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace umbrameter::gltf {
namespace {

using tinygltf::Value;

Wrap to_wrap(int wrap) {
  switch (wrap) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    default:
      return Wrap::repeat;
  }
}

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

/// A textureInfo, from either of the two places where the parser keeps them.
struct TextureReference {
  int texture = -1;
  TexcoordUse use;
};

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

void read_specular(const Value& source, Material& material, const Document& document, const std::string& object) {
  material.specular = factor<1>(member(source, "specularFactor"), {1}, "specularFactor", document, object)[0];
  material.specular_color =
      to_vec3(factor<3>(member(source, "specularColorFactor"), {1, 1, 1}, "specularColorFactor", document, object));
}

TextureReference read_metallic_roughness(const tinygltf::PbrMetallicRoughness& source, Material& material,
                                         const Document& document, const std::string& object) {
  const std::vector<double>& color = source.baseColorFactor;
  const bool usable = std::all_of(color.begin(), color.end(), [](double value) {
    return std::isfinite(static_cast<float>(value)) && value >= 0.0;
  });
  if (!usable) fail(document.path, object, "its baseColorFactor is not of finite numbers of at least 0");
  for (int i = 0; i < 4; ++i) material.base_color[i] = static_cast<float>(color[static_cast<std::size_t>(i)]);
  material.metallic = std::clamp(static_cast<float>(source.metallicFactor), 0.0f, 1.0f);
  material.roughness = std::clamp(static_cast<float>(source.roughnessFactor), 0.0f, 1.0f);
  return reference_to(source.baseColorTexture, document, object);
}

TextureReference read_material(const tinygltf::Material& source, Material& material, const Document& document,
                               const std::string& object) {
  material.name = source.name;
  material.alpha_mode = to_alpha_mode(source.alphaMode, document, object);
  material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  material.double_sided = source.doubleSided;
  TextureReference texture = read_metallic_roughness(source.pbrMetallicRoughness, material, document, object);
  if (const auto found = source.extensions.find("KHR_materials_specular"); found != source.extensions.end()) {
    read_specular(found->second, material, document, object);
  }
  if (const auto found = source.extensions.find("KHR_materials_transmission"); found != source.extensions.end()) {
    const Value* const given = member(found->second, "transmissionFactor");
    material.transmission = std::min(1.0f, factor<1>(given, {0}, "transmissionFactor", document, object)[0]);
  }
  const auto found = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (found != source.extensions.end()) {
    texture = read_specular_glossiness(found->second, material, document, object);
  }
  return texture;
}

/// Decodes each image once, and keeps one Texture for all that show it in the same way.
struct TextureReader {
  BufferStore& store;
  Scene& scene;
  std::map<std::tuple<std::size_t, Wrap, Wrap>, std::uint32_t> known;

  Image<glm::u8vec4> read_image(std::size_t index) {
    for (const auto& [key, texture] : known) {
      if (std::get<0>(key) != index) continue;
      const Image<glm::u8vec4>& texels = scene.textures[texture].texels;
      claim(store.allowance, texels.size() * sizeof(glm::u8vec4), store.document.path, label("image", index, ""));
      return texels;
    }
    const Document& document = store.document;
    const ImageSource& source = document.images[index];
    const std::string object = label("image", index, source.name);
    if (source.buffer_view >= 0) {
      return decode_image(view_bytes(store, source.buffer_view, object), store.allowance, document.path, object);
    }
    if (!source.uri) fail(document.path, object, "it has neither a uri nor a bufferView");
    const Bytes bytes = read_uri(document.path, object, *source.uri);
    if (!source.uri->starts_with("data:")) store.allowance.input += bytes.size();
    return decode_image(bytes, store.allowance, document.path, object);
  }

  std::uint32_t read(const tinygltf::Texture& source, const std::string& object) {
    const tinygltf::Model& model = *store.document.model;
    const std::size_t image =
        checked_index(source.source, store.document.images.size(), "image", store.document.path, object);
    Texture texture;
    texture.name = source.name.empty() ? store.document.images[image].name : source.name;
    if (source.sampler != -1) {
      const tinygltf::Sampler& sampler =
          model.samplers[checked_index(source.sampler, model.samplers.size(), "sampler", store.document.path, object)];
      texture.wrap_u = to_wrap(sampler.wrapS);
      texture.wrap_v = to_wrap(sampler.wrapT);
    }
    const std::tuple key(image, texture.wrap_u, texture.wrap_v);
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    texture.texels = read_image(image);
    const auto number = static_cast<std::uint32_t>(scene.textures.size());
    known.emplace(key, number);
    scene.textures.push_back(std::move(texture));
    return number;
  }
};

}  // namespace

// KHR_texture_transform, "Overview": scale, then rotation, then offset.
vec2 moved(const TexcoordUse& use, const vec2& texcoord) {
  const float c = std::cos(use.rotation);
  const float s = std::sin(use.rotation);
  const vec2 scaled = use.scale * texcoord;
  return use.offset + vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

std::vector<TexcoordUse> read_materials(BufferStore& store, Scene& scene) {
  const Document& document = store.document;
  const tinygltf::Model& model = *document.model;
  std::vector<TextureReference> references;
  std::map<std::size_t, std::uint32_t> used;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const std::string object = label("material", i, model.materials[i].name);
    Material& material = scene.materials.emplace_back();
    TextureReference& reference =
        references.emplace_back(read_material(model.materials[i], material, document, object));
    if (reference.texture == -1) continue;
    const std::size_t texture =
        checked_index(reference.texture, model.textures.size(), "texture", document.path, object);
    if (model.textures[texture].source < 0) {
      scene.notes.push_back(object + " goes without its texture " + std::to_string(texture) +
                            ", whose image is neither PNG nor JPEG");
      reference.texture = -1;
    } else {
      used.emplace(texture, 0);
    }
  }
  TextureReader reader{store, scene, {}};
  for (auto& [texture, number] : used) number = reader.read(model.textures[texture], label("texture", texture, ""));
  std::vector<TexcoordUse> uses;
  for (std::size_t i = 0; i < references.size(); ++i) {
    uses.push_back(references[i].use);
    if (references[i].texture == -1) continue;
    scene.materials[i].base_color_texture = used.at(static_cast<std::size_t>(references[i].texture));
  }
  return uses;
}

}  // namespace umbrameter::gltf
