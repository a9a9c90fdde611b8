// Pictures made by code: what an alpha mask cuts out, and woven stripes. Internal to scenes/builtin*.
#pragma once

#include "scenes/scene.h"

namespace umbrameter::builtin {

/// One panel of a wrought-iron fence: bars, rails, rings and spear heads; clear between them.
Texture wrought_iron();
/// A spray of pointed leaves on clear ground; the stem rises from the middle of the lower edge.
Texture leaf_spray();
/// Two stripes across u, repeating.
Texture cloth_stripes(const glm::u8vec4& first, const glm::u8vec4& second);

}  // namespace umbrameter::builtin
