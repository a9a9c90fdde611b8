#include "compare/bias_plateau.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace umbrameter {
namespace {

double falling(const BiasCell& cell) { return cell.acne + cell.false_occlusion; }
double rising(const BiasCell& cell) { return cell.peter_panning + cell.leak; }

// No bias between two neighbouring cells has less error.
double bound_between(const BiasCell& below, const BiasCell& above) { return falling(above) + rising(below); }

[[maybe_unused]] bool is_ascending(std::span<const BiasCell> cells) {
  return std::adjacent_find(cells.begin(), cells.end(), [](const BiasCell& a, const BiasCell& b) {
           return !(a.constant < b.constant);
         }) == cells.end();
}

}  // namespace

double plateau_limit(double least) { return least + plateau_tolerance * std::abs(least); }

ConnectedRange connected_range(std::span<const double> values, std::size_t inside, double limit) {
  assert(inside < values.size());
  ConnectedRange range{inside, inside};
  while (range.first > 0 && values[range.first - 1] <= limit) --range.first;
  while (range.last + 1 < values.size() && values[range.last + 1] <= limit) ++range.last;
  return range;
}

PlateauLimit limit_of_plateau(double least, std::uint64_t pixels, std::optional<double> floor) {
  const double of_share = std::max(plateau_limit(floor.value_or(least)), least);
  const double of_pixels = pixels > 0 ? least + chance_pixels / static_cast<double>(pixels) : of_share;
  constexpr double rounding = 1e-12;  // 22/N + 3/N may be less than 25/N
  const double limit = std::max(of_share, of_pixels);
  return {limit + rounding * std::abs(limit), of_pixels > of_share};
}

std::optional<BiasPlateau> plateau_of(std::span<const BiasCell> cells, std::optional<double> floor,
                                      std::uint64_t pixels) {
  assert(is_ascending(cells));
  if (cells.empty()) return std::nullopt;
  std::vector<double> errors;
  for (const BiasCell& cell : cells) errors.push_back(cell.mae);
  const auto least = static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin());
  const PlateauLimit limit = limit_of_plateau(errors[least], pixels, floor);
  const ConnectedRange range = connected_range(errors, least, limit.error);
  BiasPlateau plateau{cells[least], cells[range.first], cells[range.last],
                      cells[least], range.first == 0,   range.last + 1 == cells.size(),
                      limit.error,  limit.is_by_pixels};
  for (std::size_t i = range.first; i <= range.last; ++i) {
    if (cells[i].acne > little_acne_share) continue;
    plateau.recommended = cells[i];
    break;
  }
  return plateau;
}

double least_possible_error(std::span<const BiasCell> cells) {
  if (cells.empty()) return 0.0;
  double least = std::min(falling(cells.front()), rising(cells.back()));
  for (const BiasCell& cell : cells) least = std::min(least, cell.mae);
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) least = std::min(least, bound_between(cells[i], cells[i + 1]));
  return least;
}

std::vector<std::size_t> intervals_below(std::span<const BiasCell> cells, double error) {
  std::vector<std::size_t> intervals;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    if (bound_between(cells[i], cells[i + 1]) < error) intervals.push_back(i);
  }
  return intervals;
}

std::optional<NoBias> reason_against(const BiasPlateau& plateau, const BiasEvidence& evidence) {
  if (evidence.pixels < enough_pixels) return NoBias::few_pixels;
  if (evidence.lit < enough_pixels) return NoBias::nothing_lit;
  if (evidence.blocked < enough_pixels) return NoBias::nothing_blocked;
  if (!evidence.has_receiver()) return NoBias::no_receiver;
  const bool is_lower_end = plateau.open_below && plateau.recommended.constant == plateau.first.constant;
  if (plateau.open_above || is_lower_end) return NoBias::unbounded;
  return std::nullopt;
}

std::optional<NoBias> reason_against_on_axis(const BiasPlateau& plateau, const BiasEvidence& evidence) {
  const std::optional<NoBias> reason = reason_against(plateau, evidence);
  return reason == NoBias::unbounded ? std::nullopt : reason;
}

}  // namespace umbrameter
