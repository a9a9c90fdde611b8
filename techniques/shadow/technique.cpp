#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(ShadowParams& params) {
  static constexpr std::array<std::string_view, 2> names{"pcf", "esm"};
  Parameters technique =
      Description("shadow")
          .choice("technique", params.technique, names, {.unit = {}, .meaning = "shadow-map technique", .basic = true})
          .take();
  return concatenate(
      {describe(params.map), describe(params.bias), technique, describe(params.pcf), describe(params.esm)});
}

ShadowTechnique make_technique(const ShadowParams& params) {
  switch (params.technique) {
    case ShadowTechniqueName::pcf:
      break;
    case ShadowTechniqueName::esm:
      return Esm{params.esm};
  }
  return Pcf{make_filter(params.pcf)};
}

Parameters filtered_map_parameters(ShadowParams& params) {
  return concatenate({{require(describe(params), "shadow.technique")}, describe(params.esm)});
}

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique) {
  return std::visit([](const auto& each) { return each.capabilities; }, technique);
}

}  // namespace umbrameter
