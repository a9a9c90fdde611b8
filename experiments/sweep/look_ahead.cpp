#include "experiments/sweep/look_ahead.h"

#include <algorithm>

#include "experiments/sweep/sweep_evaluator.h"

namespace umbrameter {
namespace {

// The visibility of one pass takes at most this, unless one image is larger.
constexpr std::size_t most_bytes = std::size_t{256} << 20;

std::size_t images_per_pass(const Size& size) {
  const std::size_t bytes =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * sizeof(float);
  return std::clamp<std::size_t>(most_bytes / bytes, 1, max_lookups);
}

std::size_t index_of(const SweepAxis& axis, const Value& value) {
  const auto found = std::find(axis.values.begin(), axis.values.end(), value);
  return static_cast<std::size_t>(found - axis.values.begin());
}

}  // namespace

Image<float> LookAhead::visibility(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                   const std::vector<Value>& values) {
  Experiment cell = cell_in_metres(stages, experiment, axes, values);
  const std::uint32_t light = stages.lights(cell.view.light).front();
  const Parameters of_lookup = stages.has_engine() ? describe(cell.engine) : lookup_parameters(cell.shadow);
  std::vector<std::size_t> varied;
  std::string others;
  std::size_t cells = 1;
  std::size_t index = 0;  // of the cell among those that differ only in the look-up; the last axis varies fastest
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (find(of_lookup, axes[a].key) == nullptr) {
      others += to_string(values[a]) + "\n";
      continue;
    }
    varied.push_back(a);
    cells *= axes[a].values.size();
    index = index * axes[a].values.size() + index_of(axes[a], values[a]);
  }
  if (cells == 1) return stages.draw(cell, light, false).visibility;

  const std::size_t at_once = stages.has_engine() ? most_frames_at_once : images_per_pass(cell.view.size);
  const std::size_t first = index / at_once * at_once;
  if (others + std::to_string(first) != drawn_) {
    std::vector<Experiment> experiments;
    for (std::size_t i = first; i < std::min(first + at_once, cells); ++i) {
      std::vector<Value> of_cell = values;
      std::size_t rest = i;
      for (auto a = varied.rbegin(); a != varied.rend(); ++a) {
        of_cell[*a] = axes[*a].values[rest % axes[*a].values.size()];
        rest /= axes[*a].values.size();
      }
      experiments.push_back(cell_in_metres(stages, experiment, axes, of_cell));
    }
    images_ = stages.draw_lookups(experiments, light);
    drawn_ = others + std::to_string(first);
  }
  return images_[index - first];
}

}  // namespace umbrameter
