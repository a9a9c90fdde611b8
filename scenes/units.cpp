#include "scenes/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace umbrameter {
namespace {

constexpr double least_side = 0.05;          // metres
constexpr double most_side = 20e3;           // metres
constexpr double most_height = 1000.0;       // metres
constexpr double mountain_steepness = 0.25;  // height by width
constexpr double usual_side = 20.0;          // metres

constexpr std::array<UnitCandidate, 5> units{
    {{"mm", 0.001, 0.0}, {"cm", 0.01, 0.0}, {"in", 0.0254, 0.0}, {"ft", 0.3048, 0.0}, {"km", 1000.0, 0.0}}};

double longest(const dvec3& extent) { return std::max({extent.x, extent.y, extent.z}); }

bool is_out_of_range(const dvec3& extent) { return longest(extent) < least_side || longest(extent) > most_side; }

bool is_too_high(const dvec3& extent) {
  return extent.y > most_height && extent.y > mountain_steepness * std::max(extent.x, extent.z);
}

double farness(const UnitCandidate& candidate) { return std::abs(std::log(candidate.longest_side / usual_side)); }

}  // namespace

UnitGuess guess_units(const Bounds& bounds) {
  UnitGuess guess;
  if (bounds.empty()) return guess;
  const dvec3 extent = bounds.extent();
  guess.longest_side = longest(extent);
  if (!is_out_of_range(extent) && !is_too_high(extent)) return guess;
  guess.verdict = is_out_of_range(extent) ? SizeVerdict::implausible : SizeVerdict::doubtful;
  guess.reason = guess.longest_side > most_side    ? "the longest side is more than 20 km"
                 : guess.longest_side < least_side ? "the longest side is less than 5 cm"
                                                   : "it is higher than any building, and too steep for land";
  for (UnitCandidate candidate : units) {
    const dvec3 scaled = extent * candidate.metres;
    if (is_out_of_range(scaled) || is_too_high(scaled)) continue;
    candidate.longest_side = longest(scaled);
    guess.candidates.push_back(candidate);
  }
  std::stable_sort(guess.candidates.begin(), guess.candidates.end(),
                   [](const UnitCandidate& a, const UnitCandidate& b) { return farness(a) < farness(b); });
  return guess;
}

}  // namespace umbrameter
