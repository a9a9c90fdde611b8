#include "raster/shadow/filtered_map.h"

#include "raster/shadow/technique_passes.h"

namespace umbrameter {

FilteredMap filter(const gl::Context&, const ShadowMap&, const Pcf&) { return {}; }

FilteredMap filter_map(const gl::Context& context, const ShadowMap& map, const ShadowTechnique& technique) {
  return std::visit([&](const auto& each) { return filter(context, map, each); }, technique);
}

}  // namespace umbrameter
