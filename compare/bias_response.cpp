#include "compare/bias_response.h"

#include <algorithm>
#include <cassert>

namespace umbrameter {
namespace {

constexpr std::size_t lit_truth = 0;
constexpr std::size_t blocked_truth = 1;

// Where the truth is lit a tap is wrong while it is blocked, which it is at the biases below its bin.
constexpr bool is_wrong_when_blocked(std::size_t cause) {
  return cause == static_cast<std::size_t>(Cause::acne) || cause == static_cast<std::size_t>(Cause::false_occlusion);
}

void add(VisibilitySums& sums, const BiasHistogram::Bin& bin, std::size_t truth) {
  for (std::size_t c = 0; c < cause_count; ++c) {
    if (is_wrong_when_blocked(c) == (truth == lit_truth)) sums.wrong[c] += bin.weights[c];
  }
  sums.squares += bin.squares[truth];
  sums.largest = std::max(sums.largest, bin.largest[truth]);
}

}  // namespace

std::vector<VisibilitySums> sums_at_biases(const BiasHistogram& histogram, std::size_t slope) {
  const std::vector<BiasHistogram::Bin>& bins = histogram.by_slope.at(slope);
  const std::size_t biases = histogram.axes.constant.size();
  assert(bins.size() == biases + 1);
  VisibilitySums none;
  none.weight_sum = histogram.weight_sum;
  std::vector<VisibilitySums> at(biases, none);
  // At bias k the taps of bins 0 to k are lit, those of the bins above are blocked.
  VisibilitySums running = none;
  for (std::size_t k = 0; k < biases; ++k) {
    add(running, bins[k], blocked_truth);
    at[k] = running;
  }
  running = none;
  for (std::size_t k = biases; k-- > 0;) {
    add(running, bins[k + 1], lit_truth);
    for (std::size_t c = 0; c < cause_count; ++c) at[k].wrong[c] += running.wrong[c];
    at[k].squares += running.squares;
    at[k].largest = std::max(at[k].largest, running.largest);
  }
  return at;
}

std::vector<VisibilityStatistics> statistics_at_biases(const BiasHistogram& histogram, std::size_t slope,
                                                       const TruthCounts& truth) {
  std::vector<VisibilityStatistics> at;
  for (const VisibilitySums& sums : sums_at_biases(histogram, slope)) at.push_back(to_statistics(sums, truth));
  return at;
}

}  // namespace umbrameter
