// Numbers as people read them: with the digits that they deserve, in the unit that suits.
#pragma once

#include <string>

#include "compare/sampled_error.h"
#include "core/parameters.h"

namespace umbrameter {

/// "8.71 %", "0.0123 %": three significant digits; "—" for what was not measured.
std::string percent(double share);
/// "4.12 % [4.09, 4.15]": value and 95 % interval, as many decimals as give its half width two significant digits.
std::string percent(const Estimate& share);
/// In the unit that suits, three significant digits unless told otherwise: "12.5 mm", "1.2 m".
std::string metres_text(double metres, int digits = 3);
/// The same of a length in metres; "1.5 texels" of one in texels.
std::string length_text(const Length& any);

/// A share as a number in per cent with four decimals, for tables.
std::string share_text(double share);

}  // namespace umbrameter
