#include "compare/bias_curves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

namespace umbrameter {
namespace {

bool has_less_error(const BiasCell& a, const BiasCell& b) {
  return std::tie(a.mae, a.constant, a.slope) < std::tie(b.mae, b.constant, b.slope);
}

bool has_less_bias(const BiasCell& a, const BiasCell& b) {
  return std::tie(a.constant, a.slope) < std::tie(b.constant, b.slope);
}

template <typename Less>
void keep_least(std::optional<BiasCell>& kept, const BiasCell& cell, Less less) {
  if (!kept || less(cell, *kept)) kept = cell;
}

void thin(ParetoFront& front) {
  front.thinned = true;
  auto cell = std::next(front.by_acne.begin());
  while (cell != front.by_acne.end() && std::next(cell) != front.by_acne.end()) {
    cell = front.by_acne.erase(cell);
    if (std::next(cell) != front.by_acne.end()) ++cell;
  }
}

}  // namespace

void add(BiasLine& line, const BiasCell& cell) {
  keep_least(line.least_error, cell, has_less_error);
  if (cell.acne == 0.0) {
    keep_least(line.acne_free, cell, has_less_bias);
    keep_least(line.best_without_acne, cell, has_less_error);
  }
  if (cell.acne <= little_acne_share) keep_least(line.little_acne, cell, has_less_bias);
}

void add(ParetoFront& front, const BiasCell& cell) {
  std::map<double, BiasCell>& cells = front.by_acne;
  auto after = cells.lower_bound(cell.acne);
  if (after != cells.begin() && std::prev(after)->second.peter_panning <= cell.peter_panning) return;
  if (after != cells.end() && after->first == cell.acne) {
    const BiasCell& same = after->second;
    if (same.peter_panning < cell.peter_panning) return;
    if (same.peter_panning == cell.peter_panning && !has_less_bias(cell, same)) return;
  }
  while (after != cells.end() && after->second.peter_panning >= cell.peter_panning) after = cells.erase(after);
  cells.emplace_hint(after, cell.acne, cell);
  if (cells.size() > ParetoFront::max_cells) thin(front);
}

std::optional<BiasCell> knee(const ParetoFront& front) {
  if (front.by_acne.size() < 3) return std::nullopt;
  const BiasCell& first = front.by_acne.begin()->second;
  const BiasCell& last = front.by_acne.rbegin()->second;
  const double acne_extent = last.acne - first.acne;
  const double panning_extent = first.peter_panning - last.peter_panning;
  // Shares and their differences are rounded to within an ulp of the largest share. A coordinate scaled to the extent
  // is a quotient of differences, so it errs by at most six such ulps, divided by the extent: three from its numerator
  // and three from its denominator. A cell counts as below the chord if it lies farther below than that.
  const double rounding =
      6.0 * std::numeric_limits<double>::epsilon() * (last.acne / acne_extent + first.peter_panning / panning_extent);
  // The chord runs from (0, 1) to (1, 0); the distance from it is (1 − sum) / √2.
  double least = 1.0 - rounding;
  std::optional<BiasCell> found;
  for (const auto& [acne, cell] : front.by_acne) {
    const double sum = (acne - first.acne) / acne_extent + (cell.peter_panning - last.peter_panning) / panning_extent;
    if (sum >= least) continue;
    least = sum;
    found = cell;
  }
  return found;
}

std::optional<BiasCell> least_error(const BiasOptima& optima) {
  std::optional<BiasCell> least;
  for (const BiasLine& line : optima.lines) {
    if (line.least_error) keep_least(least, *line.least_error, has_less_error);
  }
  return least;
}

std::optional<BiasCell> best_without_acne(const BiasOptima& optima) {
  std::optional<BiasCell> best;
  for (const BiasLine& line : optima.lines) {
    if (line.best_without_acne) keep_least(best, *line.best_without_acne, has_less_error);
  }
  return best;
}

const BiasLine& flattest(const BiasOptima& optima) {
  return *std::ranges::min_element(
      optima.lines, [](const BiasLine& a, const BiasLine& b) { return std::abs(a.slope) < std::abs(b.slope); });
}

}  // namespace umbrameter
