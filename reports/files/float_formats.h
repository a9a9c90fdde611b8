// Readers of two plain formats for linear float images.
#pragma once

#include <string_view>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// Radiance HDR (.hdr, RGBE), flat or run-length encoded, top row first. The header's EXPOSURE is divided out.
/// Throws std::runtime_error that says what is wrong.
Image<vec3> from_radiance(std::string_view bytes);
/// Its width and height, by the header. Throws as from_radiance() does.
ivec2 size_of_radiance(std::string_view bytes);

/// Portable float map (.pfm) with one ("Pf") or three ("PF") channels, in either byte order.
/// Throws std::runtime_error that says what is wrong.
Image<vec3> from_pfm(std::string_view bytes);
/// Its width and height, by the header. Throws as from_pfm() does.
ivec2 size_of_pfm(std::string_view bytes);

}  // namespace umbrameter
