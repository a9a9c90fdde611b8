#include "techniques/shadow/technique.h"

#include <type_traits>

#include "core/error.h"

namespace umbrameter {
namespace {

MapTechnique make_map_technique(const ShadowParams& params, double light_extent) {
  const auto prefiltered = [&](int technique) {
    return make_prefiltered(technique, params.esm, params.moment_map, params.moment_lookup);
  };
  switch (params.technique) {
    case ShadowTechniqueName::pcf:
    case ShadowTechniqueName::screen_space:
      break;
    case ShadowTechniqueName::pcss:
      return Pcss{make_pcss_filter(params.pcf, params.pcss, light_extent)};
    case ShadowTechniqueName::dpcf:
      return Dpcf{make_dpcf_filter(params.pcf, params.pcss, light_extent)};
    case ShadowTechniqueName::esm:
      return prefiltered(shared::ESM);
    case ShadowTechniqueName::vsm:
      return prefiltered(shared::VSM);
    case ShadowTechniqueName::evsm2:
      return prefiltered(shared::EVSM2);
    case ShadowTechniqueName::evsm4:
      return prefiltered(shared::EVSM4);
    case ShadowTechniqueName::msm:
      return prefiltered(shared::MSM);
    case ShadowTechniqueName::csm:
      return prefiltered(shared::CSM);
  }
  return Pcf{make_filter(params.pcf)};
}

}  // namespace

Parameters describe(ShadowParams& params) {
  static constexpr std::array<std::string_view, 10> names{"pcf", "esm", "vsm",  "evsm2", "evsm4",
                                                          "msm", "csm", "pcss", "dpcf",  "screen-space"};
  Parameters technique =
      Description("shadow")
          .choice("technique", params.technique, names, {.unit = {}, .meaning = "shadow technique", .basic = true})
          .take();
  return concatenate({describe(params.map), describe(params.fit), describe(params.map_depth), describe(params.bias),
                      technique, describe(params.pcf), describe(params.pcss), describe(params.esm),
                      describe(params.moment_map), describe(params.moment_lookup), describe(params.screen_space)});
}

ShadowTechnique make_technique(const ShadowParams& params, double light_extent) {
  const ScreenSpace march = make_screen_space(params.screen_space);
  if (params.technique == ShadowTechniqueName::screen_space) {
    if (!params.screen_space.is_combined) return march;
    throw Error(ExitCode::usage, "shadow.contact-shadows", "shadow.technique screen-space already is the march",
                "set one of the two");
  }
  const MapTechnique of_map = make_map_technique(params, light_extent);
  if (params.screen_space.is_combined) return ContactShadows{of_map, march};
  return std::visit([](const auto& each) { return ShadowTechnique(each); }, of_map);
}

const FilterKernel* kernel_of(const ShadowTechnique& technique) {
  return std::visit(
      []<class T>(const T& each) -> const FilterKernel* {
        if constexpr (std::is_base_of_v<Pcf, T>) return &each.kernel;
        return nullptr;
      },
      technique);
}

const Prefiltered* prefiltered_of(const ShadowTechnique& technique) {
  const auto* combined = std::get_if<ContactShadows>(&technique);
  return combined != nullptr ? std::get_if<Prefiltered>(&combined->of_map) : std::get_if<Prefiltered>(&technique);
}

Parameters filtered_map_parameters(ShadowParams& params) {
  return concatenate(
      {{require(describe(params), "shadow.technique")}, describe(params.esm), describe(params.moment_map)});
}

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique) {
  return std::visit([](const auto& each) { return each.capabilities; }, technique);
}

}  // namespace umbrameter
