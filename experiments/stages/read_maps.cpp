#include "experiments/stages/stages.h"
#include "raster/texture_image.h"

namespace umbrameter {

ShadowMapImages Stages::read_map(const Experiment& experiment, std::uint32_t light) {
  return read_back(context(), *map(experiment, light));
}

std::vector<Image<vec4>> Stages::read_filtered_map(const Experiment& experiment, std::uint32_t light) {
  const HeldLookup held = shadow_lookup(experiment, light, false);
  const ShadowLookup& lookup = held.lookup;
  const Prefiltered* technique = prefiltered_of(lookup.technique);
  if (technique == nullptr) return {};
  const int layers = static_cast<int>(lookup.map.layout.views.size()) * technique->groups;
  return read_layers<vec4>(std::get<FilteredMap>(lookup.drawn->of_technique).values, gl::Format::rgba32f, layers);
}

}  // namespace umbrameter
