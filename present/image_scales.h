// One range for every picture of a kind, so that two runs can be compared.
#pragma once

#include "reports/figures/figures.h"

namespace umbrameter {

inline const ColorScale visibility_scale{ColorMap::visibility, 0.0, 1.0, "visibility: 0 blocked, 1 lit"};
inline const ColorScale visibility_error_scale{ColorMap::error, -1.0, 1.0,
                                               "technique − reference: below 0 is too dark"};
inline const ColorScale ao_scale{ColorMap::visibility, 0.0, 1.0, "accessibility: 1 open"};
inline const ColorScale ao_error_scale{ColorMap::error, -0.5, 0.5, "technique − reference: below 0 is too dark"};
inline const ColorScale image_error_scale{ColorMap::error, -0.25, 0.25,
                                          "technique − reference [luminance, 1 is white]: below 0 is too dark"};

}  // namespace umbrameter
