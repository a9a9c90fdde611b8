#include "techniques/shading/read_parameters.h"

namespace umbrameter {

Parameters read_parameters(ShadingParams& p) {
  Parameters read = describe(p);
  const Parameters deferred = gbuffer_parameters(p);
  std::erase_if(read, [&](const Parameter& each) {
    const bool is_deferred = each.key == "shading.volume-faces" || find(deferred, each.key) != nullptr;
    const bool is_polynomial =
        each.key == "shading.constant" || each.key == "shading.linear" || each.key == "shading.quadratic";
    return (is_deferred && p.path == ShadingPath::forward) ||
           (is_polynomial && p.attenuation == Attenuation::inverse_square);
  });
  return read;
}

}  // namespace umbrameter
