// Textures of a glTF file: which are needed, from which images they come, and what to do where one cannot be read.
#include <tiny_gltf.h>

#include <map>
#include <tuple>

#include "scenes/gltf_materials.h"

namespace umbrameter::gltf {
namespace {

Wrap to_wrap(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
}

// The plain image first, which writers give for readers that know no other.
int image_of(const tinygltf::Texture& texture) {
  if (texture.source >= 0) return texture.source;
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    const auto extension = texture.extensions.find(name);
    if (extension != texture.extensions.end() && extension->second.Has("source")) {
      return extension->second.Get("source").GetNumberAsInt();
    }
  }
  return -1;
}

const char* name_of(ImageFormat format) {
  if (format == ImageFormat::webp) return "its image is WebP, which is not read";
  if (format == ImageFormat::ktx2) return "its image is KTX2, which is not read";
  if (format == ImageFormat::dds) return "its image is DDS, which is not read";
  return "its image is neither PNG nor JPEG";
}

/// Texels, or why there are none.
struct Picture {
  Image<glm::u8vec4> texels;
  std::string why_not;
};

/// Decodes each image once, and keeps one Texture for all that show it in the same way.
struct TextureReader {
  BufferStore& store;
  Scene& scene;
  std::map<std::tuple<std::size_t, Wrap, Wrap>, std::uint32_t> known;
  /// Reasons, and the textures that are left out for them.
  std::map<std::string, std::vector<std::size_t>> left_out;

  Picture decode(std::span<const unsigned char> bytes, const std::string& object) {
    const ImageFormat format = format_of_image(bytes);
    if (format != ImageFormat::png && format != ImageFormat::jpeg) return {{}, name_of(format)};
    return {decode_image(bytes, store.allowance, store.document.path, object), ""};
  }

  Picture read_image(std::size_t index) {
    const Document& document = store.document;
    const ImageSource& source = document.images[index];
    const std::string object = label("image", index, source.name);
    for (const auto& [key, texture] : known) {
      if (std::get<0>(key) != index) continue;
      const Image<glm::u8vec4>& texels = scene.textures[texture].texels;
      claim(store.allowance, texels.size() * sizeof(glm::u8vec4), document.path, object);
      return {texels, ""};
    }
    if (source.buffer_view >= 0) return decode(view_bytes(store, source.buffer_view, object), object);
    if (!source.uri) return {{}, "its image has neither a uri nor a bufferView"};
    const std::string objection = objection_to_uri(document.path, *source.uri);
    if (!objection.empty()) return {{}, objection};
    const Bytes bytes = read_uri(document.path, object, *source.uri);
    if (!source.uri->starts_with("data:")) store.allowance.input += bytes.size();
    return decode(bytes, object);
  }

  // `mask` is the material whose holes need the texture; empty where no material has any.
  std::optional<std::uint32_t> read(std::size_t index, const std::string& mask) {
    const Document& document = store.document;
    const tinygltf::Texture& source = document.model->textures[index];
    std::string object = label("texture", index, source.name);
    Texture texture;
    if (source.sampler != -1) {
      const auto& samplers = document.model->samplers;
      const tinygltf::Sampler& sampler =
          samplers[checked_index(source.sampler, samplers.size(), "sampler", document.path, object)];
      texture.wrap_u = to_wrap(sampler.wrapS);
      texture.wrap_v = to_wrap(sampler.wrapT);
    }
    Picture picture{{}, "it has no image that is read"};
    const int image_number = image_of(source);
    if (image_number >= 0) {
      const std::size_t image = checked_index(image_number, document.images.size(), "image", document.path, object);
      texture.name = source.name.empty() ? document.images[image].name : source.name;
      const std::tuple key(image, texture.wrap_u, texture.wrap_v);
      if (const auto found = known.find(key); found != known.end()) return found->second;
      picture = read_image(image);
      object = label("image", image, document.images[image].name) + " of " + object;
      if (picture.why_not.empty()) known.emplace(key, static_cast<std::uint32_t>(scene.textures.size()));
    }
    if (!picture.why_not.empty()) {
      if (!mask.empty()) {
        fail(document.path, object, picture.why_not + ", and the alpha of " + mask + " needs it",
             "store the image as PNG or JPEG");
      }
      left_out[picture.why_not].push_back(index);
      return std::nullopt;
    }
    texture.texels = std::move(picture.texels);
    scene.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
  }
};

bool has_holes(const Material& material, bool blend_makes_holes) {
  if (material.alpha_mode == AlphaMode::mask) return material.alpha_cutoff > 0.0f;
  return material.alpha_mode == AlphaMode::blend && blend_makes_holes;
}

void note_left_out(const TextureReader& reader, std::vector<std::string>& notes) {
  constexpr std::size_t max_listed = 6;
  for (const auto& [why, textures] : reader.left_out) {
    std::string list;
    for (std::size_t i = 0; i < textures.size() && i < max_listed; ++i) {
      list += (i == 0 ? "" : ", ") + std::to_string(textures[i]);
    }
    if (textures.size() > max_listed) list += " and " + std::to_string(textures.size() - max_listed) + " more";
    notes.push_back((textures.size() == 1 ? "texture " : "textures ") + list +
                    " left out, materials use their plain factors: " + why);
  }
}

}  // namespace

void read_textures(BufferStore& store, const std::vector<TextureReferences>& references, bool blend_makes_holes,
                   Scene& scene) {
  std::vector<char> is_used(scene.materials.size(), 0);
  std::vector<char> is_shown(scene.materials.size(), 0);
  for (const Mesh& mesh : scene.meshes) is_used[mesh.material] = 1;
  for (const Instance& instance : scene.instances) is_shown[scene.meshes[instance.mesh].material] = 1;
  TextureReader reader{store, scene, {}, {}};
  const auto for_each = [&](const auto& visit) {
    for (std::size_t i = 0; i < references.size(); ++i) {
      if (is_used[i] == 0) continue;
      const TexcoordUse texcoords = texcoords_of(references[i]);
      for (std::size_t member = 0; member < texture_members.size(); ++member) {
        const TextureReference& reference = references[i][member];
        if (reference.texture == -1) continue;
        visit(i, member, static_cast<std::size_t>(reference.texture), reference.use == texcoords);
      }
    }
  };
  // In the order of the file, each with a material that has holes, where there is one.
  std::map<std::size_t, std::string> masks;
  for_each([&](std::size_t material, std::size_t member, std::size_t texture, bool has_texcoords) {
    if (!has_texcoords) {
      reader.left_out["its texture coordinates are not those of the material's first texture"].push_back(texture);
      return;
    }
    std::string& mask = masks[texture];
    const Material& holder = scene.materials[material];
    if (member == 0 && mask.empty() && is_shown[material] != 0 && has_holes(holder, blend_makes_holes)) {
      mask = label("material", material, holder.name);
    }
  });
  std::map<std::size_t, std::optional<std::uint32_t>> read;
  for (const auto& [texture, mask] : masks) read[texture] = reader.read(texture, mask);
  for_each([&](std::size_t material, std::size_t member, std::size_t texture, bool has_texcoords) {
    if (has_texcoords) scene.materials[material].*texture_members[member] = read.at(texture);
  });
  note_left_out(reader, scene.notes);
}

}  // namespace umbrameter::gltf
