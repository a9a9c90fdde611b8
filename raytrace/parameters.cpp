#include "raytrace/parameters.h"

#include <array>

namespace umbrameter {

Parameters describe(TruthParams& params) {
  static constexpr std::array<std::string_view, 2> weights = {"cosine", "uniform"};
  return Description("truth")
      .field("spp", params.spp, {"rays", "hemisphere rays for each pixel", 1, 65536})
      .choice("ao-weight", params.ao_weight, weights, {"", "how directions count: by their cosine, or evenly"})
      .field("ao-distance", params.ao_distance, {"m", "hits farther than this do not occlude; 0 for no limit", 0.0})
      .take();
}

}  // namespace umbrameter
