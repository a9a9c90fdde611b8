// Images as the page's viewer reads them: the bytes of half floats or integers, deflated, in base64.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "core/image.h"

namespace umbrameter {

/// How exact the numbers of a plane are.
enum class PlaneDigits {
  half,  ///< half floats: 11 bits
  few,   ///< half floats of 7 bits
  byte,  ///< multiples of 1/255 between 0 and 1
};

/// {"type", "data"} of every stride-th pixel in x and y. Type u8 if all values are integers from 0 to 255; pal, with
/// "palette", the bits of half floats to which the bytes refer, if there are at most 256 different ones; share if
/// `digits` is byte and no value is below 0 or above 1: bytes divided by 255; otherwise f16: half floats (IEEE 754),
/// rounded to the nearest.
nlohmann::ordered_json plane_json(const Image<float>& image, int stride, PlaneDigits digits = PlaneDigits::half);
/// Type u8 or u16.
nlohmann::ordered_json plane_json(const Image<std::uint8_t>& image, int stride);
nlohmann::ordered_json plane_json(const Image<std::uint16_t>& image, int stride);

}  // namespace umbrameter
