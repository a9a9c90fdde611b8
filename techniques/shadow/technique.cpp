#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(ShadowParams& params) {
  return concatenate({describe(params.map), describe(params.bias), describe(params.pcf)});
}

ShadowTechnique make_technique(const ShadowParams& params) { return Pcf{make_filter(params.pcf)}; }

Parameters filtered_map_parameters(ShadowParams&) { return {}; }

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique) {
  return std::visit([](const auto& each) { return each.capabilities; }, technique);
}

}  // namespace umbrameter
