#include <tiny_gltf.h>

#include "scenes/gltf.h"
#include "scenes/gltf_check.h"
#include "scenes/gltf_geometry.h"
#include "scenes/gltf_nodes.h"

namespace umbrameter {
namespace {

using gltf::Document;

// They change how a surface shines, never where it is.
bool is_shading_only(const std::string& extension) { return extension.starts_with("KHR_materials_"); }

void check_extensions(const Document& document, std::vector<std::string>& notes) {
  const auto list = [](const std::vector<std::string>& names, const auto& is_listed) {
    std::string text;
    for (const std::string& name : names) {
      if (is_listed(name)) text += (text.empty() ? "" : ", ") + name.substr(0, 60);
    }
    return text;
  };
  const auto is_unknown = [](const std::string& name) { return !gltf::is_supported(name); };
  const auto is_missing = [&](const std::string& name) { return is_unknown(name) && !is_shading_only(name); };
  if (const std::string missing = list(document.model->extensionsRequired, is_missing); !missing.empty()) {
    gltf::fail(document.path, "extensionsRequired", "it needs " + missing + ", which this program does not know",
               "export it without them, or convert it (gltf-transform copy with plain accessors)");
  }
  if (const std::string unused = list(document.model->extensionsUsed, is_unknown); !unused.empty()) {
    notes.push_back("extensions without effect here: " + unused);
  }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const std::string& part) {
  const gltf::Bytes bytes = gltf::read_file(path, "");
  return read_gltf(bytes, path, part);
}

Scene read_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& path, const std::string& part) {
  gltf::Allowance allowance{bytes.size()};
  const Document document = gltf::parse_document(path, gltf::split_container(bytes, path), allowance);
  Scene scene;
  check_extensions(document, scene.notes);
  gltf::BufferStore store = gltf::make_buffer_store(document, allowance);
  gltf::GeometryReader geometry{store, scene, gltf::read_materials(store, scene), std::nullopt, {}, {}};
  gltf::read_nodes(geometry, part);
  gltf::note_dropped(geometry.dropped, scene.notes);
  if (scene.name.empty()) scene.name = path.stem().string();
  if (document.is_animated) scene.notes.emplace_back("animations have no effect: the rest pose is used");
  return scene;
}

}  // namespace umbrameter
