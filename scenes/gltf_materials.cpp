#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/gltf_geometry.h"

namespace umbrameter::gltf {
namespace {

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

Image<glm::u8vec4> read_image(BufferStore& store, int index, const std::string& user) {
  const Document& document = *store.document;
  if (static_cast<std::size_t>(index) >= document.images.size()) {
    fail(
        document.path, user,
        "it refers to image " + std::to_string(index) + ", but the file has " + std::to_string(document.images.size()));
  }
  const ImageSource& source = document.images[static_cast<std::size_t>(index)];
  const std::string object = "image " + std::to_string(index) + (source.name.empty() ? "" : " '" + source.name + "'");
  if (source.buffer_view >= 0) {
    return decode_image(view_bytes(store, source.buffer_view, object), document.path, object);
  }
  if (!source.uri) fail(document.path, object, "it has neither a uri nor a bufferView");
  return decode_image(read_uri(document.path, object, *source.uri), document.path, object);
}

Texture read_texture(BufferStore& store, int index) {
  const tinygltf::Model& model = *store.document->model;
  const tinygltf::Texture& source = model.textures[static_cast<std::size_t>(index)];
  Texture texture;
  texture.texels = read_image(store, source.source, "texture " + std::to_string(index));
  const std::string& image_name = store.document->images[static_cast<std::size_t>(source.source)].name;
  texture.name = source.name.empty() ? image_name : source.name;
  if (source.sampler >= 0 && static_cast<std::size_t>(source.sampler) < model.samplers.size()) {
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
    texture.wrap_u = to_wrap(sampler.wrapS);
    texture.wrap_v = to_wrap(sampler.wrapT);
  }
  return texture;
}

AlphaMode to_alpha_mode(const std::string& mode, const Document& document, const std::string& object) {
  if (mode.empty() || mode == "OPAQUE") return AlphaMode::opaque;
  if (mode == "MASK") return AlphaMode::mask;
  if (mode == "BLEND") return AlphaMode::blend;
  fail(document.path, object, "unknown alphaMode '" + mode + "'");
}

Material read_material(const tinygltf::Material& source, const Document& document, std::size_t index) {
  const std::string object =
      "material " + std::to_string(index) + (source.name.empty() ? "" : " '" + source.name + "'");
  const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
  const bool usable = factor.size() == 4 && std::all_of(factor.begin(), factor.end(), [](double value) {
                        return std::isfinite(static_cast<float>(value)) && value >= 0.0;
                      });
  if (!usable) fail(document.path, object, "its baseColorFactor is not four numbers from 0 to 1");
  Material material;
  material.name = source.name;
  for (int i = 0; i < 4; ++i) material.base_color[i] = static_cast<float>(factor[static_cast<std::size_t>(i)]);
  material.alpha_mode = to_alpha_mode(source.alphaMode, document, object);
  material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  material.double_sided = source.doubleSided;
  return material;
}

}  // namespace

void read_materials(BufferStore& store, Scene& scene) {
  const Document& document = *store.document;
  const tinygltf::Model& model = *document.model;
  std::map<int, std::uint32_t> used;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    scene.materials.push_back(read_material(model.materials[i], document, i));
    const int texture = model.materials[i].pbrMetallicRoughness.baseColorTexture.index;
    if (texture == -1) continue;
    const std::string object = "material " + std::to_string(i);
    if (texture < 0 || static_cast<std::size_t>(texture) >= model.textures.size()) {
      fail(document.path, object,
           "it refers to texture " + std::to_string(texture) + ", but the file has " +
               std::to_string(model.textures.size()));
    }
    if (model.textures[static_cast<std::size_t>(texture)].source < 0) {
      scene.notes.push_back(object + " goes without its texture " + std::to_string(texture) +
                            ", whose image is neither PNG nor JPEG");
      continue;
    }
    used.emplace(texture, 0);
  }
  for (auto& [texture, stored] : used) {
    stored = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(read_texture(store, texture));
  }
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const auto found = used.find(model.materials[i].pbrMetallicRoughness.baseColorTexture.index);
    if (found != used.end()) scene.materials[i].base_color_texture = found->second;
  }
}

}  // namespace umbrameter::gltf
