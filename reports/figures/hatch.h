// Hatching tells areas apart where colour cannot: in grey print, and for readers who see few hues.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

enum class Hatch : int { none, rising, falling, horizontal, dots };

/// Of the lines on a ground of this colour: white on dark grounds, near black on light ones.
glm::u8vec3 hatch_ink(const glm::u8vec3& ground);

/// Whether this pixel belongs to a line of the hatching. `period` is the distance of its lines [px].
bool is_hatched(Hatch hatch, int x, int y, int period);

/// Where hatching can be recognised: pixels (1) of a square of side × side pixels of one category. On less, a line of
/// the hatching would hide the colour or miss it.
Image<std::uint8_t> hatchable(const Image<std::uint8_t>& category, int side);

/// An SVG pattern of this id.
std::string hatch_pattern(const std::string& id, Hatch hatch, const glm::u8vec3& ground, int period);

/// CIE L* of an sRGB colour, 0 to 100.
double lightness(const glm::u8vec3& color);

}  // namespace umbrameter
