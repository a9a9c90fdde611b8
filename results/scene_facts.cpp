#include "results/scene_facts.h"

#include <algorithm>

#include "scenes/view.h"

namespace umbrameter {
namespace {

std::string title_of(const std::vector<Light>& lights, std::size_t index) {
  const std::string& name = lights[index].name;
  if (name.empty()) return "light " + std::to_string(index);
  const auto namesakes = std::ranges::count_if(lights, [&](const Light& other) { return other.name == name; });
  return namesakes > 1 ? name + " (" + std::to_string(index) + ")" : name;
}

SceneParts parts_of(const Scene& scene, PartKind kind) {
  SceneParts parts;
  const std::size_t count = kind == PartKind::object ? scene.objects.size() : scene.materials.size();
  for (std::uint32_t i = 0; i < count; ++i) parts.names.push_back(part_name(scene, kind, i));
  for (const Instance& instance : scene.instances) {
    parts.of_instance.push_back(kind == PartKind::object ? instance.object : scene.meshes[instance.mesh].material);
  }
  return parts;
}

}  // namespace

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  facts.triangles = count(scene).triangles;
  facts.instances = scene.instances.size();
  facts.materials = scene.materials.size();
  for (std::size_t i = 0; i < scene.lights.size(); ++i) facts.titles.push_back(title_of(scene.lights, i));
  facts.layers = layer_names(scene.lights);
  facts.by_object = parts_of(scene, PartKind::object);
  facts.by_material = parts_of(scene, PartKind::material);
  return facts;
}

}  // namespace umbrameter
