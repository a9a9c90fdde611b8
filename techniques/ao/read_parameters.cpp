#include "techniques/ao/read_parameters.h"

#include <utility>

#include "core/parameter_selection.h"

namespace umbrameter {
namespace {

// `kind` is the blur that runs: the technique's own where the parameter says so.
Parameters read_by_blur(AoBlurParams& params, AoBlur kind) {
  const Parameters all = describe(params);
  switch (kind) {
    case AoBlur::none:
      return select(all, {"ao.blur"});
    case AoBlur::xegtao:
      return select(all, {"ao.blur", "ao.blur-passes"});
    case AoBlur::box:
    case AoBlur::gaussian:
      return select(all, {"ao.blur", "ao.blur-passes", "ao.blur-size"});
    case AoBlur::bilateral:
    case AoBlur::own:
      break;
  }
  return all;
}

Parameters read_by_upsampling(AoResolutionParams& params) {
  const Parameters all = describe(params);
  return params.kind == AoResolution::full ? select(all, {"ao.resolution"}) : all;
}

Parameters read_by_tone(AoToneParams& params) {
  Parameters read = describe(params);
  std::erase_if(read, [&](const Parameter& each) {
    return (!params.multi_bounce && each.key.starts_with("ao.multi-bounce-")) ||
           (params.albedo_source != AoAlbedo::constant && each.key == "ao.multi-bounce-albedo");
  });
  return read;
}

Parameters read_by_alchemy(AlchemyParams& params) {
  Parameters read = describe(params);
  std::erase_if(read, [&](const Parameter& each) {
    return !params.mip_chain && (each.key == "ao.alchemy-mip-offset" || each.key == "ao.alchemy-mip-levels");
  });
  return read;
}

}  // namespace

Parameters read_parameters(AoParams& params) {
  AoTechnique technique = make_technique(params);
  const Parameters of_technique = describe(technique);
  const Parameters all = describe(params);
  // Bound to `params`, not to the copy that the technique holds.
  Parameters read = select(all, {"ao.technique"});
  for (const Parameter& each : of_technique) read.push_back(require(all, each.key));
  const Parameters of_alchemy = describe(params.alchemy);
  const Parameters used = read_by_alchemy(params.alchemy);
  std::erase_if(read, [&](const Parameter& each) {
    return find(of_alchemy, each.key) != nullptr && find(used, each.key) == nullptr;
  });
  return concatenate({std::move(read), describe(params.inputs), read_by_blur(params.blur, blur_of(params).kind),
                      read_by_upsampling(params.resolution), read_by_tone(params.tone)});
}

}  // namespace umbrameter
