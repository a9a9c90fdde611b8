#include "techniques/shadow/technique.h"

#include <type_traits>

#include "core/error.h"

namespace umbrameter {
namespace {

Parameters describe(ShadowTechniques::Choice& technique) {
  return Description("shadow")
      .choice("technique", technique, ShadowTechniques::names,
              {.unit = {}, .meaning = "technique (csm: convolution, dpcf: contact-hardening)", .basic = true})
      .take();
}

}  // namespace

Parameters describe(ShadowParams& params) {
  return std::apply([](auto&... groups) { return concatenate({describe(groups)...}); }, params.groups());
}

ShadowTechnique make_technique(const ShadowParams& params, double light_extent) {
  const auto made = ShadowTechniques::apply<MapTechnique>(
      params.technique, [&]<class T>(std::type_identity<T>) { return T::make(params, light_extent); });
  if (!params.screen_space.is_combined) {
    return std::visit([](const auto& each) { return ShadowTechnique(each); }, made);
  }
  if (std::holds_alternative<ScreenSpace>(made)) {
    throw Error(ExitCode::usage, "shadow.contact-shadows", "shadow.technique screen-space already is the march",
                "set one of the two");
  }
  return ContactShadows{made, ScreenSpace::make(params, light_extent)};
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
  Parameters any;
  ShadowTechniques::for_each([&]<class T>(std::type_identity<T>) {
    if constexpr (requires { T::map_parameters(params); }) any = concatenate({any, T::map_parameters(params)});
  });
  Parameters all = describe(params);
  std::erase_if(all, [&](const Parameter& each) { return each.key != "shadow.technique" && !find(any, each.key); });
  return all;
}

TechniqueCapabilities capabilities_of(const ShadowTechnique& technique) {
  return std::visit([](const auto& each) { return each.capabilities; }, technique);
}

}  // namespace umbrameter
