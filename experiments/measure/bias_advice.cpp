#include "experiments/measure/bias_advice.h"

#include <algorithm>
#include <cmath>

#include "experiments/measure/engine_advice.h"
#include "experiments/measure/measure_biases.h"

namespace umbrameter {
namespace {

// From a hundredth of a texel, which no acne notices, to a hundred, where contact shadows are long gone. Where the
// plateau reaches an end, the search goes on to a million: more than any map has texels.
constexpr int min_exponent = -2;
constexpr int max_exponent = 2;
constexpr int largest_exponent = 6;

// Every number of three significant digits on both sides of 0, and 0: from the power of ten at or below
// 10^min_exponent texels to the one at or beyond 10^last. What is printed is then the very bias whose error is printed.
std::vector<double> readable_axis(double texel, int last) {
  const int begin = static_cast<int>(std::floor(std::log10(texel))) + min_exponent;
  const int end = static_cast<int>(std::ceil(std::log10(texel))) + last;
  const double reach = std::pow(10.0, end);
  std::vector<double> values = {-reach, 0.0, reach};
  for (int exponent = begin - 2; exponent < end - 2; ++exponent) {
    for (int mantissa = 100; mantissa < 1000; ++mantissa) {
      const double value = exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
      values.insert(values.end(), {value, -value});
    }
  }
  std::ranges::sort(values);
  return values;
}

BiasCell cell_of(double constant, double slope, const VisibilityStatistics& s) {
  return {constant, slope, s.mae, s.acne, s.false_occlusion, s.peter_panning, s.leak};
}

// Ascending; each bias once, as single precision has it.
void sort_cells(std::vector<BiasCell>& cells) {
  const auto as_measured = [](const BiasCell& cell) { return static_cast<float>(cell.constant); };
  std::ranges::stable_sort(cells,
                           [&](const BiasCell& a, const BiasCell& b) { return as_measured(a) < as_measured(b); });
  const auto is_same = [&](const BiasCell& a, const BiasCell& b) { return as_measured(a) == as_measured(b); };
  cells.erase(std::unique(cells.begin(), cells.end(), is_same), cells.end());
}

// The errors at constant biases that replace the experiment's, ascending, each bias once.
class BiasCurveOfLight {
 public:
  BiasCurveOfLight(Stages& stages, const Experiment& experiment, std::uint32_t light)
      : stages_(stages), experiment_(experiment), light_(light) {}

  std::vector<BiasCell> measure(const std::vector<double>& biases) { return measure(experiment_, biases); }

  // An error that no bias is below, by least_possible_error(), or one a thousandth below the least that was found.
  // Searches the gaps between the cells that may hold less than the least of them, the most promising first: tenths of
  // these, and so on. The cause of an error does not matter here, so that no ray is traced. `best` becomes the bias of
  // least error.
  double least_possible(std::vector<BiasCell> cells, double& best) {
    Experiment fast = experiment_;
    fast.run.classes = ClassRule::fast;
    constexpr int max_rounds = 3;
    constexpr std::size_t max_gaps = 1'000;
    // So little moves the ends of a plateau of 5 % by nothing that one reads.
    constexpr double accuracy = 1e-3;
    for (int round = 0;; ++round) {
      const auto least =
          std::ranges::min_element(cells, [](const BiasCell& a, const BiasCell& b) { return a.mae < b.mae; });
      best = least->constant;
      const double floor = std::max(least_possible_error(cells), (1.0 - accuracy) * least->mae);
      std::vector<std::size_t> gaps = intervals_below(cells, (1.0 - accuracy) * least->mae);
      if (round == max_rounds || gaps.empty()) return floor;
      const auto bound = [&](std::size_t i) {
        return cells[i + 1].acne + cells[i + 1].false_occlusion + cells[i].peter_panning + cells[i].leak;
      };
      std::ranges::stable_sort(gaps, [&](std::size_t a, std::size_t b) { return bound(a) < bound(b); });
      gaps.resize(std::min(gaps.size(), max_gaps));
      std::vector<double> biases;
      for (const BiasCell& cell : cells) biases.push_back(cell.constant);
      for (const std::size_t gap : gaps) {
        const double from = cells[gap].constant;
        for (int k = 1; k < 10; ++k) biases.push_back(from + 0.1 * k * (cells[gap + 1].constant - from));
      }
      cells = measure(fast, biases);
    }
  }

 private:
  std::vector<BiasCell> measure(const Experiment& experiment, const std::vector<double>& biases) {
    const double slope = experiment.shadow.bias.slope;
    const std::vector<VisibilityStatistics> measured =
        measure_biases(stages_, experiment, light_, biases, {slope}).front();
    std::vector<BiasCell> cells;
    for (std::size_t i = 0; i < biases.size(); ++i) cells.push_back(cell_of(biases[i], slope, measured[i]));
    sort_cells(cells);
    return cells;
  }

  Stages& stages_;
  const Experiment& experiment_;
  std::uint32_t light_;
};

// Whether no tap flips beyond the last cell: every one is lit.
bool is_all_lit(const BiasCell& cell, const BiasEvidence& evidence) {
  return cell.acne + cell.false_occlusion == 0.0 &&
         cell.mae * static_cast<double>(evidence.pixels) >= static_cast<double>(evidence.blocked) * (1.0 - 1e-9);
}

// Whether a slider stops at the cell. Of three digits every fifth below 200, every tenth to 500, every twentieth above:
// steps of 1 to 5 %. Below 0 only as far as anything is named there.
bool is_slider_stop(const BiasAdvice& advice, const BiasCell& cell) {
  double lowest = 0.0;
  std::vector<const BiasCell*> named = {&advice.used, &advice.plateau.least, &advice.plateau.first,
                                        &advice.plateau.last, &advice.plateau.recommended};
  for (const std::optional<BiasCell>& each : {advice.line.little_acne, advice.line.acne_free}) {
    if (each && each->constant == cell.constant) return true;
  }
  for (const BiasCell* each : named) {
    if (each->constant == cell.constant) return true;
    lowest = std::min(lowest, each->constant);
  }
  if (cell.constant < lowest) return false;
  if (cell.constant == 0.0) return true;
  const double size = std::abs(cell.constant);
  const double mantissa = 100.0 * size / std::pow(10.0, std::floor(std::log10(size) + 1e-9));
  const long digits = std::lround(mantissa);
  const bool has_three_digits = std::abs(mantissa - static_cast<double>(digits)) < 1e-6 * mantissa;
  return has_three_digits && digits % (digits < 200 ? 5 : digits < 500 ? 10 : 20) == 0;
}

}  // namespace

bool has_tap_flips(const Experiment& experiment) {
  const ShadowTechnique technique = make_technique(experiment.shadow);
  const auto* pcf = std::get_if<Pcf>(&technique);
  return pcf != nullptr && pcf->kernel.tap_count() == 1;
}

BiasAdvice advise_bias(Stages& stages, const Experiment& experiment, std::uint32_t light,
                       const std::vector<double>& further) {
  const auto counted = stages.counted(experiment, light);
  const Length& used = experiment.shadow.bias.constant;
  BiasAdvice advice;
  advice.unit = used.unit;
  advice.mean_texel = counted->mean_texel;
  const auto layout = stages.layout(experiment, light);
  advice.texels_differ = texels_differ(*layout);
  advice.depth_unit = mean_depth_unit(stages, experiment, light);
  const double texel = used.unit == LengthUnit::texels      ? 1.0
                       : used.unit == LengthUnit::map_depth ? advice.mean_texel / advice.depth_unit
                                                            : advice.mean_texel;
  advice.evidence = measure_bias_evidence(stages, experiment, light);
  BiasCurveOfLight curve(stages, experiment, light);
  const auto measure = [&](int last, const std::vector<double>& more) {
    std::vector<double> biases = {used.number};  // the first of equal ones stays
    const std::vector<double> axis = readable_axis(texel, last);
    biases.insert(biases.end(), axis.begin(), axis.end());
    biases.insert(biases.end(), more.begin(), more.end());
    return curve.measure(biases);
  };
  std::vector<BiasCell> cells = measure(max_exponent, {});
  advice.plateau = *plateau_of(cells, {}, advice.evidence.pixels);
  const auto is_open = [&] {
    return advice.plateau.open_below || (advice.plateau.open_above && !is_all_lit(cells.back(), advice.evidence));
  };
  int last = max_exponent;
  if (is_open()) {
    last = largest_exponent;
    cells = measure(last, {});
    advice.plateau = *plateau_of(cells, {}, advice.evidence.pixels);
  }
  double best = 0.0;
  const double least_possible = curve.least_possible(cells, best);
  // Where three digits are too few to come near the least error, its own bias takes part.
  if (advice.plateau.least.mae > plateau_limit(least_possible)) cells = measure(last, {best});
  advice.plateau = *plateau_of(cells, least_possible, advice.evidence.pixels);
  advice.withheld = reason_against(advice.plateau, advice.evidence);
  advice.line.slope = experiment.shadow.bias.slope;
  // The run's own bias may lie beyond the search: what is least with little acne is not known from it.
  const auto add_up_to = [&](const std::vector<BiasCell>& more, int exponent) {
    const double reach = readable_axis(texel, exponent).back();
    for (const BiasCell& cell : more) {
      if (std::abs(cell.constant) <= reach) add(advice.line, cell);
    }
  };
  add_up_to(cells, last);
  for (const BiasCell& cell : cells) {
    if (cell.constant == used.number) advice.used = cell;
  }
  if (!advice.line.little_acne && last < largest_exponent) {
    add_up_to(measure(largest_exponent, {}), largest_exponent);
    if (advice.line.little_acne) cells.push_back(*advice.line.little_acne);
  }
  advice.cells = {advice.used};
  if (!further.empty()) {
    const std::vector<BiasCell> more = curve.measure(further);
    advice.cells.insert(advice.cells.end(), more.begin(), more.end());
  }
  for (const BiasCell& cell : cells) {
    if (is_slider_stop(advice, cell)) advice.cells.push_back(cell);
  }
  sort_cells(advice.cells);
  if (has_tap_flips(experiment)) {
    BiasAxes axes{{}, {static_cast<float>(advice.used.slope)}, advice.unit};
    for (const BiasCell& cell : advice.cells) axes.constant.push_back(static_cast<float>(cell.constant));
    advice.flips = stages.tap_flips(experiment, light, axes);
  }
  if (!advice.withheld) {
    Experiment recommended = experiment;
    recommended.shadow.bias.constant.number = named_bias(advice).constant;
    advice.engines = advise_engines(stages, recommended, light);
  }
  return advice;
}

}  // namespace umbrameter
