#include "raster/shadow/filtered_map.h"

#include "raster/shadow/technique_passes.h"

namespace umbrameter {

FilteredMap filter(const DrawnMap&, const Pcf&) { return {}; }

FilteredMap filter_map(const DrawnMap& drawn, const ShadowTechnique& technique) {
  return std::visit([&](const auto& each) { return filter(drawn, each); }, technique);
}

}  // namespace umbrameter
