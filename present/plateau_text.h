// The rule of compare/bias_plateau.h in words and in summary.json, the same for every command.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/bias_plateau.h"
#include "core/parameters.h"

namespace umbrameter {

inline constexpr const char* only_of_axis = "only this bias of the axis";

struct RoundedRange {
  double first = 0.0;
  double last = 0.0;
  int digits = 3;
};
/// The ends of a range, rounded to values within it, with `inside` between them: to three digits, or to as many more as
/// that takes.
RoundedRange rounded_inwards(double first, double last, double inside);

/// How much more than the least error is as good: "5 %", or "3 wrong pixels".
std::string tolerance_text(bool is_by_pixels);

/// "1.05 times".
std::string times_text(double factor);

/// "error is at most 1.05 times the least (or 3 wrong pixels more than the least, where that is larger)": of a good
/// bias.
std::string good_error_text();

/// What 'recommended' means, for tables.
std::string rule_text();

/// "2.2 to 18 texels have at most 1.05 times the least error (0.271 %)". The biases are in `unit`; `what` is "error" or
/// "cost", and `least` its least value as text, which may be empty. `only` begins the text of a single bias. Values of
/// an axis that is given are printed as it has them. `tolerance` takes the place of tolerance_text().
std::string range_text(const BiasPlateau& plateau, LengthUnit unit, const std::string& what, const std::string& least,
                       const char* only = "only this bias", const std::vector<double>& axis = {},
                       const std::string& tolerance = {});

/// " for acne of at most 0.1 %" where that decides which bias is recommended: between those of the range, or, with
/// `is_for_acne`, against the bias in use.
const char* reason_text(const BiasPlateau& plateau, bool is_for_acne = false);

/// " for the least error" where no bias of the range has little acne and a smaller one is in the range.
const char* least_error_text(const BiasPlateau& plateau);

/// "; acne is at most 0.1 % from 2.5 texels on, where the error is 2.29 %": beside a bias with more. `little` is the
/// smallest bias with so little acne, of the swept ones or of all, and `little_text` its text.
std::string less_acne_text(const std::optional<BiasCell>& little, const std::string& little_text,
                           bool is_swept = false);

/// Why no bias is recommended and what to do: "no counted pixel is in shadow, so a large bias costs nothing;
/// --scene.ground adds a floor".
std::string withheld_text(NoBias reason, const BiasEvidence& evidence);

/// Remark below a table of biases in several units whose texels differ from pixel to pixel, where the axis has `unit`.
std::string average_text(LengthUnit unit);

/// " (only 12 counted pixels)" where one pixel is more than 1 % of them; else nothing.
std::string few_pixels_text(std::uint64_t counted);

/// "counted pixels in 12 blocks of the image, 20 are needed": why there is no interval. `where` is "the image".
std::string few_blocks_text(std::size_t blocks, const char* where = "the image");

/// Adds "recommended", "withheld" and "range" to an object; `cell_json` gives a cell with its "constant_bias".
void add_plateau(nlohmann::ordered_json& object, const BiasPlateau& plateau, const BiasEvidence& evidence,
                 std::optional<NoBias> withheld,
                 const std::function<nlohmann::ordered_json(const BiasCell&)>& cell_json);

}  // namespace umbrameter
