// Images as the page's viewer reads them: the bytes of half floats or integers, predicted, deflated, in base64.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

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
/// rounded to the nearest, as differences to a prediction (plane_words.h).
nlohmann::ordered_json plane_json(const Image<float>& image, int stride, PlaneDigits digits = PlaneDigits::half);

/// The planes of a colour or vector: one item of type f16 with all of them if none is shorter alone.
std::vector<nlohmann::ordered_json> planes_json(const std::vector<Image<float>>& planes, int stride,
                                                PlaneDigits digits = PlaneDigits::half);

/// An error, predicted from what it is the difference of where that is shorter: then "predictor" is "difference", and
/// the reader needs both planes.
nlohmann::ordered_json difference_json(const Image<float>& error, const Image<float>& technique,
                                       const Image<float>& reference, int stride);

/// Type u8, or u16 if a number is larger than 255.
nlohmann::ordered_json plane_json(const Image<std::uint8_t>& image, int stride);
nlohmann::ordered_json plane_json(const Image<std::uint16_t>& image, int stride);

/// Numbers that are 0 where `category` is: type u16, the others in the order of their categories.
nlohmann::ordered_json plane_json(const Image<std::uint16_t>& image, const Image<std::uint8_t>& category, int stride);

}  // namespace umbrameter
