#include "scenes/transparency.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace umbrameter {
namespace {

constexpr float half = 0.5f;

/// Materials by index, and how many triangles they have over all instances.
class MaterialGroup {
 public:
  explicit MaterialGroup(const Scene& scene)
      : is_member_(scene.materials.size(), 0), is_used_(scene.materials.size(), 0) {}

  void add(std::size_t material) { is_member_[material] = 1; }
  bool contains(std::size_t material) const { return is_member_[material] != 0; }

  void count_triangles(const Scene& scene) {
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = scene.meshes[instance.mesh];
      if (!contains(mesh.material) || mesh.triangles.empty()) continue;
      triangles_ += mesh.triangles.size();
      is_used_[mesh.material] = 1;
    }
  }
  std::uint64_t triangles() const { return triangles_; }

  /// "12 triangles of the materials 'glass' and 'water'"; long lists and names are cut.
  std::string text(const Scene& scene) const {
    constexpr std::size_t max_listed = 6;
    constexpr std::size_t longest_name = 40;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < is_used_.size(); ++i) {
      if (is_used_[i] == 0) continue;
      const std::string name = scene.materials[i].name.substr(0, longest_name);
      names.push_back(name.empty() ? std::to_string(i) : "'" + name + "'");
    }
    std::string list;
    const std::size_t listed = std::min(names.size(), max_listed);
    for (std::size_t i = 0; i < listed; ++i) {
      const bool is_last = i + 1 == listed && names.size() == listed;
      list += (i == 0 ? "" : is_last ? " and " : ", ") + names[i];
    }
    if (names.size() > listed) list += " and " + std::to_string(names.size() - listed) + " more";
    return std::to_string(triangles_) + (triangles_ == 1 ? " triangle" : " triangles") +
           (names.size() == 1 ? " of the material " : " of the materials ") + list;
  }

 private:
  std::vector<char> is_member_;
  std::vector<char> is_used_;
  std::uint64_t triangles_ = 0;
};

// Meshes of the group and their instances; objects stay, so that the numbers of the others do not change.
void remove(Scene& scene, const MaterialGroup& group) {
  constexpr std::uint32_t gone = 0xffffffffu;
  std::vector<std::uint32_t> new_index(scene.meshes.size(), gone);
  std::vector<Mesh> kept;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (group.contains(scene.meshes[i].material)) continue;
    new_index[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(std::move(scene.meshes[i]));
  }
  scene.meshes = std::move(kept);
  std::erase_if(scene.instances, [&](const Instance& instance) { return new_index[instance.mesh] == gone; });
  for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh];
}

}  // namespace

bool is_transparent(const Material& material) {
  return material.alpha_mode == AlphaMode::blend || material.transmission > 0.0f;
}

void apply_blend_mode(Scene& scene, BlendMode mode) {
  MaterialGroup opaque(scene);
  MaterialGroup masked(scene);
  MaterialGroup left_out(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (!is_transparent(material)) continue;
    if (mode == BlendMode::leave_out || (mode == BlendMode::mask && material.transmission > half)) {
      left_out.add(i);
    } else if (mode == BlendMode::mask && material.alpha_mode == AlphaMode::blend) {
      masked.add(i);
    } else {
      opaque.add(i);
    }
  }
  for (MaterialGroup* group : {&opaque, &masked, &left_out}) group->count_triangles(scene);
  if (opaque.triangles() > 0 && mode == BlendMode::opaque) {
    scene.notes.push_back(opaque.text(scene) +
                          " are alpha-blended or transmit light; they count as opaque; set --scene.blend leave-out or "
                          "mask to change that");
  } else if (opaque.triangles() > 0) {
    scene.notes.push_back(opaque.text(scene) + " transmit at most half of the light; they count as opaque");
  }
  if (masked.triangles() > 0) {
    scene.notes.push_back(masked.text(scene) + " are alpha-blended; they have holes where alpha is below 0.5");
  }
  if (left_out.triangles() > 0) {
    scene.notes.push_back(left_out.text(scene) + (mode == BlendMode::mask
                                                      ? " transmit more than half of the light; they are left out"
                                                      : " are alpha-blended or transmit light; they are left out"));
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!masked.contains(i)) continue;
    scene.materials[i].alpha_mode = AlphaMode::mask;
    scene.materials[i].alpha_cutoff = half;
  }
  if (left_out.triangles() > 0) remove(scene, left_out);
}

}  // namespace umbrameter
