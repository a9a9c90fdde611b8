#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "scenes/gltf.h"
#include "scenes/gltf_check.h"
#include "scenes/gltf_geometry.h"
#include "scenes/gltf_nodes.h"

namespace umbrameter {
namespace {

using gltf::Document;

// Extensions without effect on what is read, by the start of their names: how surfaces shine and how the environment
// lights them, in which format their textures are (which matters only where one has holes), what is known about parts,
// how they move, sound or respond. The geometry of a file that requires them is the same without.
constexpr std::array<std::string_view, 28> harmless_extensions = {"ADOBE_materials_",
                                                                  "AGI_",
                                                                  "CESIUM_primitive_outline",
                                                                  "EXT_feature_metadata",
                                                                  "EXT_instance_features",
                                                                  "EXT_lights_",
                                                                  "EXT_materials_",
                                                                  "EXT_mesh_features",
                                                                  "EXT_property_",
                                                                  "EXT_structural_metadata",
                                                                  "EXT_texture_",
                                                                  "FB_",
                                                                  "GODOT_",
                                                                  "KHR_animation_",
                                                                  "KHR_audio_",
                                                                  "KHR_interactivity",
                                                                  "KHR_lights_",
                                                                  "KHR_materials_",
                                                                  "KHR_node_hoverability",
                                                                  "KHR_node_selectability",
                                                                  "KHR_physics_",
                                                                  "KHR_texture_",
                                                                  "KHR_xmp",
                                                                  "MSFT_packing_",
                                                                  "MSFT_texture_",
                                                                  "NV_materials_",
                                                                  "OMI_",
                                                                  "VRM"};

bool is_harmless(const std::string& extension) {
  return std::ranges::any_of(harmless_extensions, [&](std::string_view start) { return extension.starts_with(start); });
}

void check_extensions(const Document& document, std::vector<std::string>& notes) {
  const auto list = [](const std::vector<std::string>& names, const auto& is_listed) {
    std::string text;
    for (const std::string& name : names) {
      if (is_listed(name)) text += (text.empty() ? "" : ", ") + name.substr(0, 60);
    }
    return text;
  };
  const auto is_unknown = [](const std::string& name) { return !gltf::is_supported(name); };
  const auto is_missing = [&](const std::string& name) { return is_unknown(name) && !is_harmless(name); };
  if (const std::string missing = list(document.model->extensionsRequired, is_missing); !missing.empty()) {
    gltf::fail(document.path, "extensionsRequired", "it needs " + missing + ", which this program does not know",
               "export it without them, or convert it (gltf-transform copy with plain accessors)");
  }
  std::vector<std::string> used = document.model->extensionsUsed;
  for (const std::string& name : document.model->extensionsRequired) {
    if (std::ranges::find(used, name) == used.end()) used.push_back(name);
  }
  if (const std::string unused = list(used, is_unknown); !unused.empty()) {
    notes.push_back("extensions without effect here: " + unused);
  }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const std::string& part, const LoadOptions& options) {
  const gltf::Bytes bytes = gltf::read_file(path, "");
  return read_gltf(bytes, path, part, options);
}

Scene read_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& path, const std::string& part,
                const LoadOptions& options) {
  gltf::Allowance allowance{bytes.size(), options.memory};
  const Document document = gltf::parse_document(path, gltf::split_container(bytes, path), allowance);
  Scene scene;
  check_extensions(document, scene.notes);
  gltf::BufferStore store = gltf::make_buffer_store(document, allowance);
  gltf::GeometryReader geometry{store, scene, gltf::read_materials(document, options, scene), std::nullopt, {}, {}};
  gltf::read_nodes(geometry, part);
  gltf::read_textures(store, geometry.textures, options.blend_makes_holes, scene);
  gltf::note_dropped(geometry.dropped, scene.notes);
  if (scene.name.empty()) scene.name = path.stem().string();
  if (document.is_animated) scene.notes.emplace_back("animations have no effect: the rest pose is used");
  // Names in the notes come from the file.
  for (std::string& note : scene.notes) {
    std::replace_if(
        note.begin(), note.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  }
  return scene;
}

}  // namespace umbrameter
