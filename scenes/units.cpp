#include "scenes/units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/short_number.h"

namespace umbrameter {
namespace {

constexpr double min_side = 0.01;           // metres
constexpr double small_side = 0.5;          // metres
constexpr double large_side = 5e3;          // metres
constexpr double max_side = 20e3;           // metres
constexpr double high = 200.0;              // metres
constexpr double hill_steepness = 0.1;      // height by width
constexpr double slender_height = 50.0;     // metres
constexpr double usual_side = 20.0;         // metres
constexpr double thing_side = 100.0;        // metres
constexpr double equal_to_rounding = 1e-9;  // of two lengths

constexpr std::array<UnitCandidate, 6> units{{{"mm", 0.001, 0.0},
                                              {"cm", 0.01, 0.0},
                                              {"m", 1.0, 0.0},
                                              {"km", 1000.0, 0.0},
                                              {"inch", 0.0254, 0.0},
                                              {"foot", 0.3048, 0.0}}};

double longest(const dvec3& extent) { return std::max({extent.x, extent.y, extent.z}); }

// Empty where the size is credible.
std::string doubt(const dvec3& extent, bool is_surrounding) {
  const double side = longest(extent);
  if (side < min_side) return "it is shorter than 1 cm";
  if (side < small_side) return "it is shorter than 0.5 m, smaller than furniture";
  if (side > max_side) return "it is longer than 20 km";
  if (side > large_side) return "it is longer than 5 km, and a texel of its shadow map larger than a room";
  if (extent.y > high && extent.y > hill_steepness * std::max(extent.x, extent.z)) {
    return "it is higher than 200 m, as few buildings are, and too steep for land";
  }
  if (extent.y > slender_height && extent.y > std::sqrt(extent.x * extent.z)) {
    return "it is higher than 50 m and slender, as only towers are";
  }
  if (side > thing_side && !is_surrounding) {
    return "it is longer than 100 m, but the file has no camera or lamp inside it: perhaps one object in another unit";
  }
  return {};
}

bool is_usual(const UnitCandidate& candidate) { return candidate.unit == "mm" || candidate.unit == "cm"; }

double farness(const UnitCandidate& candidate) { return std::abs(std::log(candidate.longest_side / usual_side)); }

bool is_likelier(const UnitCandidate& a, const UnitCandidate& b) {
  if (is_usual(a) != is_usual(b)) return is_usual(a);
  return farness(a) < farness(b);
}

}  // namespace

UnitGuess guess_units(const Bounds& bounds, double metres, bool is_surrounding) {
  UnitGuess guess;
  if (bounds.empty()) return guess;
  const dvec3 extent = bounds.extent();
  guess.longest_side = longest(extent);
  guess.metres = metres;
  guess.reason = doubt(extent, is_surrounding);
  if (guess.reason.empty()) return guess;
  const bool is_out_of_range = guess.longest_side < min_side || guess.longest_side > max_side;
  guess.verdict = is_out_of_range ? SizeVerdict::implausible : SizeVerdict::doubtful;
  const bool is_thing = doubt(extent, true).empty();
  for (UnitCandidate candidate : units) {
    const dvec3 scaled = extent * (candidate.metres / metres);
    if (std::abs(candidate.metres - metres) < equal_to_rounding * metres) continue;
    candidate.longest_side = longest(scaled);
    const bool is_small_thing = is_thing && is_usual(candidate) && candidate.longest_side >= min_side;
    if (!is_small_thing && !doubt(scaled, is_surrounding).empty()) continue;
    guess.candidates.push_back(candidate);
  }
  std::ranges::stable_sort(guess.candidates, is_likelier);
  if (guess.longest_side > 0.0) {
    guess.power_of_ten = std::pow(10.0, std::round(std::log10(usual_side * metres / guess.longest_side)));
  }
  return guess;
}

std::string size_remark(const UnitGuess& guess) {
  if (guess.verdict == SizeVerdict::credible) return {};
  std::string text = "the scene's longest side is " + text_of(guess.longest_side) + " m: " + guess.reason;
  if (std::abs(guess.metres - 1.0) > equal_to_rounding) {
    return text + "; without --scene.unit, in metres, it is " + text_of(guess.longest_side / guess.metres) + " m";
  }
  text += "; if its unit is another, ";
  // Kilometres are a guess for towns, not for toys.
  const bool is_small = guess.longest_side < usual_side;
  if (guess.candidates.empty() || (is_small && guess.candidates.front().unit == "km")) {
    return text + "set --scene.unit to its length in metres, such as " + text_of(guess.power_of_ten);
  }
  const UnitCandidate& likely = guess.candidates.front();
  text += "set --scene.unit " + std::string(likely.unit) + ", which makes it " + text_of(likely.longest_side) + " m";
  // Of a thing, the size does not say which of two units is the likelier.
  const bool has_second = guess.candidates.size() > 1 && is_usual(guess.candidates[1]);
  if (!has_second || guess.candidates[1].longest_side >= small_side) return text;
  const UnitCandidate& second = guess.candidates[1];
  return text + ", or " + std::string(second.unit) + ", which makes it " + text_of(second.longest_side) + " m";
}

bool is_surrounding(const Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const auto is_within = [&](const dvec3& place) {
    return glm::all(glm::lessThanEqual(bounds.min, place)) && glm::all(glm::lessThanEqual(place, bounds.max));
  };
  return std::ranges::any_of(scene.cameras,
                             [&](const Camera& camera) { return is_within(dvec3(camera.world_from_camera[3])); }) ||
         std::ranges::any_of(scene.lights, [&](const Light& light) {
           return !std::holds_alternative<DirectionalLight>(light.shape) && is_within(light.position());
         });
}

}  // namespace umbrameter
