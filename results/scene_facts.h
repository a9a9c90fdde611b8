// What results say about the scene besides its pixels: names, counts, and which part each instance belongs to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/by_object.h"
#include "scenes/scene.h"

namespace umbrameter {

/// The objects, or the materials, of a scene.
struct SceneParts {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_instance;  ///< for each instance the index of its part
};

struct SceneFacts {
  std::uint64_t triangles = 0;  ///< over all instances
  std::size_t instances = 0;
  std::size_t materials = 0;
  std::vector<std::string> titles;  ///< of each light, for people: "light 2" without a name, "lamp (2)" with a namesake
  std::vector<std::string> layers;  ///< of each light: the end of its layers' names
  SceneParts by_object;
  SceneParts by_material;

  const std::string& title(std::uint32_t light) const { return titles[light]; }
  const std::string& layer(std::uint32_t light) const { return layers[light]; }
  const SceneParts& parts(PartKind kind) const { return kind == PartKind::object ? by_object : by_material; }
};

SceneFacts facts_of(const Scene& scene);

}  // namespace umbrameter
