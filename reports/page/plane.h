// Images as the page's viewer reads them: the bytes of half floats or integers, deflated, in base64.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "core/image.h"

namespace umbrameter {

/// {"type", "data"} of every stride-th pixel in x and y. Type u8 if all values are integers from 0 to 255, otherwise
/// f16: half floats (IEEE 754), rounded to the nearest.
nlohmann::ordered_json plane_json(const Image<float>& image, int stride);
/// Type u8 or u16.
nlohmann::ordered_json plane_json(const Image<std::uint8_t>& image, int stride);
nlohmann::ordered_json plane_json(const Image<std::uint16_t>& image, int stride);

}  // namespace umbrameter
