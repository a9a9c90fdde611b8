// Formats numbers for people: with as many digits as their precision justifies, in a suitable unit.
#pragma once

#include <string>
#include <string_view>

#include "compare/sampled_error.h"
#include "core/parameters.h"
#include "core/table.h"

namespace umbrameter {

/// Decimals with which a number shows that many significant digits; 0 for the number 0.
int decimals_of(double number, int digits);

/// "8.71 %", "0.0123 %": three significant digits; "—" if the share was not measured.
std::string percent(double share);
/// estimate_text() of a share, in per cent; without the interval if that has no width.
std::string percent(const Estimate& share);
/// "4.12 px [4.09, 4.15]": value and 95 % interval, with decimals so that the half width has two significant digits.
std::string estimate_text(const Estimate& estimate, std::string_view unit);
/// A length with a suitable unit and this number of significant digits: "12.5 mm", "1.2 m". Less than a nanometre is
/// rounding: "0 m".
std::string metres_text(double metres, int digits = 3);
/// metres_text() for a length in metres; "1.5 texels" for one in texels.
std::string length_text(const Length& any);

/// A share in per cent with four decimals, without the unit, for tables.
std::string share_text(double share);

/// A value for people: numbers with six significant digits.
std::string short_text(const Value& value);

}  // namespace umbrameter
