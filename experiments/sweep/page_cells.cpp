#include "experiments/sweep/page_cells.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "experiments/measure/bias_advice.h"
#include "experiments/measure/measure_image.h"
#include "experiments/sweep/sweep_evaluator.h"

namespace umbrameter {
namespace {

// Values of the bias axis that a bias slider takes, besides its own.
constexpr std::size_t max_slider_biases = 4'096;

bool is_word(const Value& value) {
  return std::holds_alternative<std::string>(value) || std::holds_alternative<bool>(value);
}

// Chooses cells one after the other, none twice.
class CellChoice {
 public:
  CellChoice(Stages& stages, const SweepResults& sweep, const Experiment& experiment, std::size_t most)
      : stages_(stages), sweep_(sweep), experiment_(experiment), most_(most) {
    const std::optional<std::size_t> constant = sweep.plan.constant_bias.axis;
    if (sweep.is_by_cause() && constant && axes()[*constant].values.size() <= max_slider_biases) bias_axis_ = constant;
  }

  bool is_full() const { return cells_.size() >= most_; }
  std::vector<PageCell> take() { return std::move(cells_); }

  /// Cells of which one is there already are left out.
  void add(const std::vector<std::size_t>& indices, const std::string& reason) {
    if (is_full()) return;
    std::size_t number = 0;
    for (std::size_t a = 0; a < indices.size(); ++a) number += indices[a] * sweep_.plan.strides[a];
    Experiment cell = cell_in_metres(stages_, experiment_, axes(), values_at(sweep_.plan, number));
    const bool is_exact = bias_axis_ && has_tap_flips(cell) && stages_.capabilities(cell).taps_independent_of_bias;
    std::vector<std::size_t> images = indices;
    if (is_exact) images[*bias_axis_] = 0;
    if (!images_.insert(std::move(images)).second) return;
    cells_.push_back({{number, reason, is_exact ? axes()[*bias_axis_].key : ""}, std::move(cell)});
  }

  /// Nothing if a value is not on its axis.
  std::optional<std::vector<std::size_t>> indices_of(const std::vector<Value>& row) const {
    std::vector<std::size_t> indices;
    for (std::size_t a = 0; a < axes().size(); ++a) {
      const std::vector<Value>& values = axes()[a].values;
      const auto found = std::ranges::find(values, row[a]);
      if (found == values.end()) return std::nullopt;
      indices.push_back(static_cast<std::size_t>(found - values.begin()));
    }
    return indices;
  }

  /// The indices of the values that are not varied; where the bias slider shows all biases, the nearest bias will do.
  std::optional<std::vector<std::size_t>> indices_without_axes() const {
    Experiment varied = experiment_;
    const Parameters parameters = describe(varied);
    std::vector<std::size_t> indices;
    for (std::size_t a = 0; a < axes().size(); ++a) {
      const Value given = require(sweep_.parameters, axes()[a].key).value();
      std::optional<std::size_t> found;
      for (std::size_t i = 0; i < axes()[a].values.size() && !found; ++i) {
        set_value(parameters, axes()[a], axes()[a].values[i]);
        if (require(parameters, axes()[a].key).value() == given) found = i;
      }
      if (!found && a == bias_axis_) found = nearest_bias(axes()[a]);
      if (!found) return std::nullopt;
      indices.push_back(*found);
    }
    return indices;
  }

 private:
  // The value of the axis that is nearest to the given bias; nothing where it is in another unit.
  std::optional<std::size_t> nearest_bias(const SweepAxis& axis) const {
    const Length given = experiment_.shadow.bias.constant;
    if (given.unit != axis.length_unit) return std::nullopt;
    const auto nearest = std::ranges::min_element(
        axis.values, {}, [&](const Value& value) { return std::abs(to_number(value) - given.number); });
    return static_cast<std::size_t>(nearest - axis.values.begin());
  }

  const std::vector<SweepAxis>& axes() const { return sweep_.plan.axes; }

  Stages& stages_;
  const SweepResults& sweep_;
  Experiment experiment_;
  std::size_t most_;
  std::optional<std::size_t> bias_axis_{};
  std::vector<PageCell> cells_{};
  std::set<std::vector<std::size_t>> images_{};  ///< without the axis that does not change them
};

Measurement measure_without_picture(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                                    const std::vector<double>& further) {
  Measurement measurement;
  measurement.experiment = experiment;
  measurement.surfels = *stages.surfels(experiment);
  if (quantity == SweptQuantity::ao) {
    measurement.ao = measure_ao(stages, experiment, {});
    return measurement;
  }
  const std::vector<std::uint32_t> lights = stages.lights(experiment.view.light);
  if (quantity == SweptQuantity::image) {
    measurement.image = measure_image(stages, experiment, lights, {});
    return measurement;
  }
  measurement.shadows.push_back(measure_shadow(stages, experiment, lights.front(), {}));
  ShadowMeasurement& shadow = measurement.shadows.front();
  const VisibilityStatistics* causes = by_cause(shadow);
  if (causes != nullptr && causes->pixels > 0 && stages.capabilities(experiment).taps_independent_of_bias) {
    shadow.advice = advise_bias(stages, experiment, shadow.light, further);
  }
  return measurement;
}

}  // namespace

Measurement measure_swept(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                          const std::vector<double>& further) {
  Measurement measurement = measure_without_picture(stages, experiment, quantity, further);
  measurement.picture = picture_of(stages, measurement);
  return measurement;
}

PageCells choose_page_cells(Stages& stages, const SweepResults& sweep, const Experiment& experiment, const Table& best,
                            std::size_t most) {
  CellChoice choice(stages, sweep, experiment, std::max<std::size_t>(most, 1));
  const std::vector<SweepAxis>& axes = sweep.plan.axes;
  const std::vector<std::size_t> least = choice.indices_of(least_row(sweep)).value();
  choice.add(least, "least error");
  if (const auto indices = choice.indices_without_axes()) choice.add(*indices, "nearest to the given settings");
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::size_t last = axes[a].values.size() - 1;
    const bool has_words = is_word(axes[a].values.front());
    for (std::size_t i = 0; i <= last; i += has_words ? 1 : std::max<std::size_t>(last, 1)) {
      std::vector<std::size_t> indices = least;
      indices[a] = i;
      choice.add(indices, has_words ? axes[a].key : "end of " + axes[a].key);
    }
  }
  for (const std::vector<Value>& row : best.rows) {
    if (const auto indices = choice.indices_of(row)) choice.add(*indices, "least error of one line of the figure");
  }
  // Cells at even steps may share their images with earlier ones; finer steps find others, if there are any.
  constexpr std::size_t finest = 16;
  for (std::size_t steps = most; steps <= finest * most && !choice.is_full(); steps *= 2) {
    for (std::size_t k = 0; k < steps && !choice.is_full(); ++k) {
      const std::size_t number = steps > 1 ? k * (sweep.plan.cells - 1) / (steps - 1) : 0;
      choice.add(choice.indices_of(values_at(sweep.plan, number)).value(), "further cell");
    }
  }
  return {choice.take(), [&stages, &sweep](const PageCell& cell) {
            const std::vector<double> none;
            return measure_swept(stages, cell.experiment, sweep.quantity(),
                                 cell.cell.bias_axis.empty() ? none : sweep.plan.constant_bias.values);
          }};
}

}  // namespace umbrameter
