// The errors of a shadow technique over the reference's shadow, for a sheet of many techniques on one scene.
#pragma once

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// Half as wide and high. Light grey is lit in the reference and dark grey blocked; over it stand the errors in the
/// colours of the error maps: blue too dark, red too bright. truth: the reference's visibility, below 0 where nothing
/// is compared.
Image<glm::u8vec3> picture_of_errors(const Image<float>& truth, const Image<float>& visibility);

}  // namespace umbrameter
