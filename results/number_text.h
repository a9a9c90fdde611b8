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

/// The number, so that printing with fewer digits gives the larger of two equally near ones, as the page's script does.
double halves_up(double number);

/// A depth from 0 to 1, to three significant digits however small: "6.57e-05".
std::string depth_text(double depth);

/// "−0.5" of "-0.5", the minus sign of texts for people, and "0.0" of "-0.0".
std::string with_minus(std::string text);
/// The same with a plus sign where the number is above 0: "+0.5".
std::string with_sign(std::string text);

/// "8.71", "0.350", "−1250", "0": significant digits, zeros at the end included, which keeps columns even; a whole part
/// in full; one digit below 0.0001. "—" for what is no number.
std::string digits_text(double number, int digits = 3);

/// "8.71 %", "0.0123 %": three significant digits; "—" if the share was not measured.
std::string percent(double share);
/// estimate_text() of a share, in per cent.
std::string percent(const Estimate& share);
/// "4.12 ± 0.03 px": value and half of the 95 % interval, which has two significant digits. "4.09 to 4.18 px": the
/// interval alone, where its halves differ. The value alone if the interval has no width.
std::string estimate_text(const Estimate& estimate, std::string_view unit);
/// A length with a suitable unit and this number of significant digits: "12.5 mm", "1.2 m". Less than a nanometre is
/// rounding: "0 m".
std::string metres_text(double metres, int digits = 3);
/// "1.5 texels", "1 texel", "0.2": a number with its unit, which is left out if it is "" or "1".
std::string with_unit(std::string number, std::string_view unit);
/// metres_text() for a length in metres; "1.5 texels" for one in texels.
std::string length_text(const Length& any);

/// percent() without the unit, for tables whose head has it.
std::string share_text(double share);
std::string share_text(const Estimate& share);

/// A value for people: numbers with six significant digits.
std::string short_text(const Value& value);

}  // namespace umbrameter
