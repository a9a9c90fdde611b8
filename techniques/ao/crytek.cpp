#include "techniques/ao/crytek.h"

namespace umbrameter {

shared::CrytekMethod::CrytekSettings settings_of(const Crytek& technique) {
  return {technique.sampling.samples, static_cast<float>(technique.sampling.radius.number),
          static_cast<float>(technique.bias.depth.number), technique.range.range_check ? 1 : 0};
}

}  // namespace umbrameter
