#include "techniques/ao/technique.h"

#include <array>

namespace umbrameter {

Parameters describe(AoParams& params) {
  static constexpr std::array<std::string_view, 7> names{"ssao",   "gtao",    "hbao",       "alchemy",
                                                         "crytek", "bitmask", "ray-marched"};
  Parameters technique =
      Description("ao")
          .choice("technique", params.technique, names, {.unit = {}, .meaning = "AO technique", .basic = true})
          .take();
  return concatenate({describe(params.sampling), describe(params.bias), describe(params.noise), describe(params.inputs),
                      technique, describe(params.ssao), describe(params.kernel), describe(params.slices),
                      describe(params.gtao), describe(params.hbao), describe(params.alchemy), describe(params.bitmask),
                      describe(params.marched), describe(params.blur), describe(params.resolution),
                      describe(params.tone)});
}

AoParams in_metres(AoParams params, double scene_size) {
  params.sampling.radius = to_metres(params.sampling.radius, scene_size);
  params.bias.depth = to_metres(params.bias.depth, scene_size);
  return params;
}

AoTechnique make_technique(const AoParams& params) {
  switch (params.technique) {
    case AoTechniqueName::ssao:
      break;
    case AoTechniqueName::gtao:
      return Gtao{params.sampling, params.noise, params.slices, params.gtao};
    case AoTechniqueName::hbao:
      return Hbao{params.sampling, params.noise, params.hbao};
    case AoTechniqueName::alchemy:
      return Alchemy{params.sampling, params.noise, params.alchemy};
    case AoTechniqueName::crytek:
      return Crytek{params.sampling, params.bias, params.noise, params.ssao};
    case AoTechniqueName::bitmask:
      return Bitmask{params.sampling, params.noise, params.slices, params.bitmask};
    case AoTechniqueName::ray_marched:
      return Marched{params.sampling, params.noise, params.marched};
  }
  return Ssao{params.sampling, params.bias, params.noise, params.ssao, params.kernel};
}

Parameters describe(AoTechnique& technique) {
  return std::visit([](auto& each) { return describe(each); }, technique);
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

std::string_view title_of(const AoTechnique& technique) {
  return std::visit([](const auto& each) { return each.title; }, technique);
}

}  // namespace umbrameter
