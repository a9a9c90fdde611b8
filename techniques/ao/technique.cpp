#include "techniques/ao/technique.h"

#include <fmt/format.h>

namespace umbrameter {
namespace {

Parameters describe(AoTechniques::Choice& technique) {
  return Description("ao")
      .choice("technique", technique, AoTechniques::names, {.unit = {}, .meaning = "AO technique", .basic = true})
      .take();
}

// The parameters of all members, in order; without ao.samples where the technique says so.
template <class T>
Parameters describe_members(T& technique) {
  const auto all = [](auto&... members) { return concatenate({describe(members)...}); };
  Parameters read;
  if constexpr (count_fields<T>() == 3) {
    auto& [a, b, c] = technique;
    read = all(a, b, c);
  } else if constexpr (count_fields<T>() == 4) {
    auto& [a, b, c, d] = technique;
    read = all(a, b, c, d);
  } else {
    auto& [a, b, c, d, e] = technique;
    read = all(a, b, c, d, e);
  }
  if constexpr (requires { T::reads_samples; }) {
    std::erase_if(read, [](const Parameter& each) { return each.key == "ao.samples"; });
  }
  return read;
}

// Converts to the member of that type.
struct GroupOfType {
  AoParams& params;
  template <class Group>
  operator Group() const {
    return std::get<Group&>(params.groups());
  }
};

}  // namespace

Parameters describe(AoParams& params) {
  return std::apply([](auto&... groups) { return concatenate({describe(groups)...}); }, params.groups());
}

AoParams in_metres(AoParams params, double scene_size) {
  params.sampling.radius = to_metres(params.sampling.radius, scene_size);
  params.bias.depth = to_metres(params.bias.depth, scene_size);
  return params;
}

AoTechnique make_technique(AoParams params) {
  return AoTechniques::apply<AoTechnique>(params.technique, [&]<class T>(std::type_identity<T>) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return T{(static_cast<void>(I), GroupOfType{params})...};
    }
    (std::make_index_sequence<count_fields<T>()>{});
  });
}

Parameters describe(AoTechnique& technique) {
  return std::visit([](auto& each) { return describe_members(each); }, technique);
}

AoBlurParams blur_of(const AoParams& params) {
  AoBlurParams blur = params.blur;
  if (blur.kind == AoBlur::own) {
    blur.kind = std::visit([](const auto& each) { return each.denoiser; }, make_technique(params));
  }
  return blur;
}

AoCapabilities capabilities_of(const AoTechnique& technique) {
  if (const auto* ssao = std::get_if<Ssao>(&technique)) {
    return {true, ssao->kernel.kind == AoKernel::progressive, 0};
  }
  if (const auto* alchemy = std::get_if<Alchemy>(&technique)) return {false, false, settings_of(*alchemy).mip_levels};
  return {};
}

std::vector<vec4> kernel_of(const AoTechnique& technique, std::uint32_t seed) {
  const auto* ssao = std::get_if<Ssao>(&technique);
  if (ssao == nullptr) return {};
  return hemisphere_kernel(ssao->kernel, ssao->sampling.samples, seed);
}

std::vector<vec4> noise_of(const AoTechnique& technique, std::uint32_t seed) {
  const AoNoiseParams& noise =
      std::visit([](const auto& each) -> const AoNoiseParams& { return each.noise; }, technique);
  return std::holds_alternative<Ssao>(technique) ? rotation_tile(noise, seed) : stratified_tile(noise, seed);
}

std::string sampling_text(AoTechnique technique) {
  const Parameters parameters = describe(technique);
  std::string text;
  for (const auto& [key, format] : {std::pair("ao.samples", "{} samples"), std::pair("ao.slices", "{} slices × 2"),
                                    std::pair("ao.hbao-directions", "{} directions"), std::pair("ao.steps", "{} steps"),
                                    std::pair("ao.hbao-steps", "{} steps")}) {
    const Parameter* parameter = find(parameters, key);
    if (parameter == nullptr) continue;
    text += (text.empty() ? "" : " × ") + fmt::format(fmt::runtime(format), to_string(parameter->value()));
  }
  return text;
}

std::string_view title_of(const AoTechnique& technique) {
  return std::visit([](const auto& each) { return each.title; }, technique);
}

}  // namespace umbrameter
