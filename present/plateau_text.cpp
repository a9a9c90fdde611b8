#include "present/plateau_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/digits.h"
#include "core/jackknife.h"
#include "present/plot_axes.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

// "no counted pixel is lit, so a small bias costs nothing", "only 12 of 5184 counted pixels are lit, too few to show
// what a small bias costs".
std::string few_text(std::uint64_t pixels, std::uint64_t counted, const char* what, const char* bias) {
  if (pixels == 0) return fmt::format("no counted pixel is {}, so a {} bias costs nothing", what, bias);
  return fmt::format("only {} of {} counted pixels {} {}, too few to show what a {} bias costs", pixels, counted,
                     pixels == 1 ? "is" : "are", what, bias);
}

}  // namespace

RoundedRange rounded_inwards(double first, double last, double inside) {
  constexpr double slack = 1e-6;  // a bias of three digits is one, whatever its last bits
  constexpr int most_digits = 6;
  for (int digits = 3; digits <= most_digits; ++digits) {
    const double of_first = step_of_last_digit(first, digits);
    const double of_last = step_of_last_digit(last, digits);
    const double up = of_first * std::ceil(first / of_first - slack);
    const double down = of_last * std::floor(last / of_last + slack);
    if (up <= inside + slack * of_first && down >= inside - slack * of_last) return {up, down, digits};
  }
  return {first, last, most_digits};
}

std::string tolerance_text(bool is_by_pixels) {
  return is_by_pixels ? fmt::format("{} wrong pixels", chance_pixels) : "5 %";
}

std::string times_text(double factor) { return fmt::format("{:.3g} times", factor); }

std::string good_error_text() {
  return fmt::format("error is at most {} the least (or {} more than the least, where that is larger)",
                     times_text(1.0 + plateau_tolerance), tolerance_text(true));
}

std::string rule_text() {
  return "'Recommended' is the smallest bias with acne of at most 0.1 % whose " + good_error_text() +
         "; if no bias has both, it is the bias of least error.";
}

std::string range_text(const BiasPlateau& plateau, LengthUnit unit, const std::string& what, const std::string& least,
                       const char* only, const std::vector<double>& axis, const std::string& tolerance) {
  const RoundedRange rounded = rounded_inwards(plateau.first.constant, plateau.last.constant, plateau.least.constant);
  const double first = axis.empty() ? rounded.first : plateau.first.constant;
  const double last = axis.empty() ? rounded.last : plateau.last.constant;
  const auto number = [&](double bias) {
    const int digits = axis.empty() ? rounded.digits : digits_on_axis(axis, bias);
    return unit == LengthUnit::metres ? metres_text(bias, digits) : with_minus(fmt::format("{:.{}g}", bias, digits));
  };
  const std::string of_unit = unit == LengthUnit::metres ? "" : fmt::format(" {}", unit_name(unit));
  const bool is_only = first == last;
  const bool has_none = plateau.least.mae == 0.0 && tolerance.empty();
  const bool counts_pixels = plateau.is_by_pixels && tolerance.empty();
  const bool is_factor = plateau.least.mae > 0.0 && tolerance.empty();
  const std::string by_pixels = tolerance_text(true);
  const std::string of_least = what + (least.empty() ? "" : " (" + least + ")");
  const std::string good =
      has_none ? (counts_pixels ? "at most " + by_pixels : "no " + what)
      : is_factor
          ? fmt::format("at most {} the least {}",
                        counts_pixels ? by_pixels + " more than" : times_text(1.0 + plateau_tolerance), of_least)
          : fmt::format("at most {} above the least {}", tolerance.empty() ? tolerance_text(false) : tolerance,
                        of_least);
  const char* verb = is_factor || has_none ? (is_only ? "has" : "have") : is_only ? "is" : "are";
  if (is_only) return fmt::format("{} {} {}", only, verb, good);
  return fmt::format("{} to {}{} {} {}", number(first), number(last), of_unit, verb, good);
}

const char* reason_text(const BiasPlateau& plateau, bool is_for_acne) {
  const bool decides = is_for_acne || plateau.recommended.constant > plateau.first.constant;
  return decides && plateau.has_little_acne() ? " for acne of at most 0.1 %" : "";
}

const char* least_error_text(const BiasPlateau& plateau) {
  const bool decides = plateau.recommended.constant > plateau.first.constant;
  return decides && !plateau.has_little_acne() ? " for the least error" : "";
}

std::string less_acne_text(const std::optional<BiasCell>& little, const std::string& little_text, bool is_swept) {
  return little ? fmt::format("; acne is at most 0.1 % from {}{} on, where the error is {}",
                              is_swept ? "the swept bias " : "", little_text, percent(little->mae))
                : fmt::format("; acne is more than 0.1 % at every {}", is_swept ? "swept bias" : "bias");
}

std::string withheld_text(NoBias reason, const BiasEvidence& evidence) {
  const char* remedy = !evidence.has_floor     ? "--scene.ground adds a floor"
                       : evidence.blocked == 0 ? "choose a view with shadows"
                                               : "choose a view with more shadows";
  switch (reason) {
    case NoBias::few_pixels:
      return fmt::format("only {} counted pixel{}; choose a view in which the light reaches more", evidence.pixels,
                         evidence.pixels == 1 ? "" : "s");
    case NoBias::nothing_lit:
      return few_text(evidence.lit, evidence.pixels, "lit", "small") +
             (evidence.lit == 0 ? "; choose a view with lit surfaces" : "; choose a view with more light");
    case NoBias::nothing_blocked:
      return few_text(evidence.blocked, evidence.pixels, "in shadow", "large") + "; " + remedy;
    case NoBias::no_receiver:
      return std::string(
                 "the scene has no floor, and most shadows fall on the object that casts them, so a large bias "
                 "costs little; ") +
             remedy;
    case NoBias::unbounded:
      return "a bias that removes every shadow is among the best, because the map is too coarse, the filter too "
             "wide, or the casters are not in the map; raise --shadow.resolution, use a narrower filter, or look at "
             "what casts (--shadow.faces; with a perspective --shadow.depth-encoding --shadow.depth-far)";
  }
  return {};
}

std::string average_text(LengthUnit unit) {
  return fmt::format(
      "The errors belong to the bias in {0}. The map's texels differ in size: in the other units the table has "
      "averages "
      "over the pixels, and such an average, set as the bias, has another error.",
      unit == LengthUnit::metres   ? "metres"
      : unit == LengthUnit::texels ? "texels"
                                   : "the map's depth");
}

std::string few_pixels_text(std::uint64_t counted) {
  if (counted >= enough_pixels) return {};
  return fmt::format(" (only {} counted pixel{})", counted, counted == 1 ? "" : "s");
}

std::string few_blocks_text(std::size_t blocks, const char* where) {
  return fmt::format("counted pixels in {} block{} of {}, {} are needed", blocks, blocks == 1 ? "" : "s", where,
                     fewest_blocks);
}

void add_plateau(nlohmann::ordered_json& object, const BiasPlateau& plateau, const BiasEvidence& evidence,
                 std::optional<NoBias> withheld,
                 const std::function<nlohmann::ordered_json(const BiasCell&)>& cell_json) {
  using Json = nlohmann::ordered_json;
  object["recommended"] = withheld ? Json(nullptr) : cell_json(plateau.recommended);
  object["withheld"] = withheld ? Json(withheld_text(*withheld, evidence)) : Json(nullptr);
  object["range"] = {{"tolerance", plateau_tolerance},
                     {"smallest", cell_json(plateau.first).at("constant_bias")},
                     {"largest", cell_json(plateau.last).at("constant_bias")},
                     {"open_below", plateau.open_below},
                     {"open_above", plateau.open_above}};
}

}  // namespace umbrameter
