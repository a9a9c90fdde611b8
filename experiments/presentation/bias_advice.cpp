#include "experiments/presentation/bias_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/measure_biases.h"
#include "experiments/presentation/presentation.h"
#include "experiments/presentation/summary.h"

namespace umbrameter {
namespace {

// From a hundredth of a texel, which no acne notices, to a hundred, where contact shadows are long gone.
constexpr double min_texels = 0.01;
constexpr double max_texels = 100.0;

// Numbers with few digits in steps of 2 to 5 %, from `first` to the first one at or beyond `last`; 0 before them. What
// is printed is then the very bias whose error is printed.
std::vector<double> readable_axis(double first, double last) {
  std::vector<int> mantissas;
  for (int m = 100; m < 1000; m += m < 200 ? 5 : m < 500 ? 10 : 20) mantissas.push_back(m);
  std::vector<double> values = {0.0};
  for (int exponent = static_cast<int>(std::floor(std::log10(first))) - 2;; ++exponent) {
    for (const int mantissa : mantissas) {
      const double value = exponent < 0 ? mantissa / std::pow(10.0, -exponent)
                                        : static_cast<double>(mantissa) * std::pow(10.0, exponent);
      if (value < first) continue;
      values.push_back(value);
      if (value >= last) return values;
    }
  }
}

BiasCell cell_of(double constant, double slope, const VisibilityStatistics& s) {
  return {constant, slope, s.mae, s.acne, s.false_occlusion, s.peter_panning, s.leak};
}

// Ascending; each bias once, as single precision has it.
void sort_cells(std::vector<BiasCell>& cells) {
  const auto as_measured = [](const BiasCell& cell) { return static_cast<float>(cell.constant); };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const BiasCell& a, const BiasCell& b) { return as_measured(a) < as_measured(b); });
  const auto is_same = [&](const BiasCell& a, const BiasCell& b) { return as_measured(a) == as_measured(b); };
  cells.erase(std::unique(cells.begin(), cells.end(), is_same), cells.end());
}

std::array<double, cause_count> shares_of(const BiasCell& cell) {
  return {cell.acne, cell.false_occlusion, cell.peter_panning, cell.leak};
}

BiasInUnits in_units(const BiasAdvice& advice, const BiasCell& cell) {
  return in_units(Length{cell.constant, advice.unit}, advice.mean_texel, advice.depth_unit);
}

std::string short_bias_text(const BiasAdvice& advice, const BiasCell& cell) {
  return length_text(Length{cell.constant, advice.unit});
}

// In the unit in use first, then in texels or metres.
std::string bias_text(const BiasAdvice& advice, const BiasCell& cell) {
  const BiasInUnits bias = in_units(advice, cell);
  const std::string texels = fmt::format("{:.3g} texels", bias.texels);
  if (advice.unit == LengthUnit::texels) return fmt::format("{} ({})", texels, metres_text(bias.metres));
  const std::string own =
      advice.unit == LengthUnit::map_depth ? short_bias_text(advice, cell) : metres_text(bias.metres);
  return fmt::format("{} ({})", own, texels);
}

}  // namespace

bool is_best(const BiasAdvice& advice) { return advice.line.least_error->mae >= 0.99 * advice.used.mae; }

bool is_open_ended(const BiasAdvice& advice) { return advice.line.least_error->constant >= advice.largest; }

bool has_tap_flips(const Experiment& experiment) {
  const ShadowTechnique technique = make_technique(experiment.shadow);
  const auto* pcf = std::get_if<Pcf>(&technique);
  return pcf != nullptr && pcf->kernel.tap_count() == 1;
}

BiasAdvice advise_bias(Stages& stages, const Experiment& experiment, std::uint32_t light,
                       const std::vector<double>& further) {
  const CountedPixels& counted = stages.counted(experiment, light);
  const Length& used = experiment.shadow.bias.constant;
  BiasAdvice advice;
  advice.unit = used.unit;
  advice.mean_texel = counted.mean_texel;
  advice.depth_unit = mean_depth_unit(stages, experiment, light);
  const double texel = used.unit == LengthUnit::texels      ? 1.0
                       : used.unit == LengthUnit::map_depth ? advice.mean_texel / advice.depth_unit
                                                            : advice.mean_texel;
  const std::vector<double> biases = readable_axis(min_texels * texel, max_texels * texel);
  advice.largest = biases.back();

  std::vector<double> measured_biases = biases;
  measured_biases.push_back(used.number);
  measured_biases.insert(measured_biases.end(), further.begin(), further.end());
  const double slope = experiment.shadow.bias.slope;
  const std::vector<VisibilityStatistics> measured =
      measure_biases(stages, experiment, light, measured_biases, {slope}).front();
  advice.line.slope = slope;
  for (std::size_t i = 0; i < biases.size(); ++i) add(advice.line, cell_of(biases[i], slope, measured[i]));
  advice.used = cell_of(used.number, slope, measured[biases.size()]);
  if (used.number >= 0.0) add(advice.line, advice.used);
  advice.cells = {advice.used};  // the first of equal ones stays
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (i != biases.size()) advice.cells.push_back(cell_of(measured_biases[i], slope, measured[i]));
  }
  sort_cells(advice.cells);
  if (has_tap_flips(experiment)) {
    BiasAxes axes{{}, {static_cast<float>(slope)}, advice.unit};
    for (const BiasCell& cell : advice.cells) axes.constant.push_back(static_cast<float>(cell.constant));
    advice.flips = stages.tap_flips(experiment, light, axes);
  }
  return advice;
}

std::string advice_text(const BiasAdvice& advice) {
  const BiasCell& used = advice.used;
  const BiasCell& best = *advice.line.least_error;
  std::string text;
  const std::array<double, cause_count> shares = shares_of(used);
  const auto largest = static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
  if (is_best(advice)) {
    text =
        fmt::format("error {} at {}, within 1 % of the best constant bias", percent(used.mae), bias_text(advice, used));
    if (shares[largest] > 0.0) {
      text += fmt::format("; mostly {} ({})", cause_title(static_cast<Cause>(largest)), percent(shares[largest]));
    }
  } else {
    text = fmt::format("{} {} at {}; use {}: total error {} → {}", cause_title(static_cast<Cause>(largest)),
                       percent(shares[largest]), bias_text(advice, used), bias_text(advice, best), percent(used.mae),
                       percent(best.mae));
  }
  if (is_open_ended(advice)) text += " (the error still falls there)";
  const BiasLine& line = advice.line;
  if (used.acne == 0.0 && best.acne == 0.0) return text;
  const bool is_far =
      line.little_acne && (!line.acne_free || line.acne_free->constant > 2.0 * line.little_acne->constant);
  if (is_far) text += "; acne below 0.1 % from " + short_bias_text(advice, *line.little_acne);
  if (line.acne_free)
    return text + (is_far ? ", none from " : "; no acne from ") + short_bias_text(advice, *line.acne_free);
  return text + fmt::format("; some acne remains even at {}", short_bias_text(advice, {advice.largest}));
}

ReportTable advice_table(const BiasAdvice& advice) {
  Table table{{{"constant bias", "", "all other parameters as in this run"},
               {"along the light", "m", "length along the light; texels are converted at their mean size"},
               {"in texels", "texels", "in texels of mean size over the counted pixels"},
               {"in depth", "1", "of the depth that the map stores, from 0 to 1"},
               {"error", "%", "mean absolute error of visibility"}},
              {}};
  for (std::size_t c = 0; c < cause_count; ++c) {
    const auto cause = static_cast<Cause>(c);
    table.columns.push_back({std::string(cause_title(cause)), "%", std::string(cause_meaning(cause))});
  }
  const auto add_row = [&](const char* name, const BiasCell& cell) {
    const BiasInUnits bias = in_units(advice, cell);
    std::vector<Value> row = {std::string(name), fmt::format("{:.3g}", bias.metres), fmt::format("{:.3g}", bias.texels),
                              fmt::format("{:.2e}", bias.depth), share_text(cell.mae)};
    for (const double share : shares_of(cell)) row.emplace_back(share_text(share));
    table.rows.push_back(std::move(row));
  };
  add_row("in this run", advice.used);
  add_row(is_open_ended(advice) ? "lowest error tested; it still falls" : "least error", *advice.line.least_error);
  if (advice.line.little_acne) add_row("smallest bias with acne below 0.1 %", *advice.line.little_acne);
  if (advice.line.acne_free) add_row("smallest bias without acne", *advice.line.acne_free);
  return {"Recommended bias", std::move(table), {"in texels", "in depth"}};
}

nlohmann::ordered_json to_json(const BiasAdvice& advice) {
  using Json = nlohmann::ordered_json;
  const auto cell_json = [&](const BiasCell& cell) {
    Json object = {{"constant_bias", to_json(in_units(advice, cell))}, {"mae", cell.mae}};
    const std::array<double, cause_count> shares = shares_of(cell);
    for (std::size_t c = 0; c < cause_count; ++c) object[std::string(cause_names[c])] = shares[c];
    return object;
  };
  Json object = {{"used", cell_json(advice.used)}, {"least_error", cell_json(*advice.line.least_error)}};
  object["error_falls_at_upper_end"] = is_open_ended(advice);
  object["acne_at_most_0.1_percent"] = advice.line.little_acne ? cell_json(*advice.line.little_acne) : Json(nullptr);
  object["acne_free"] = advice.line.acne_free ? cell_json(*advice.line.acne_free) : Json(nullptr);
  return object;
}

}  // namespace umbrameter
