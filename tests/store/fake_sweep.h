// A sweep whose evaluator only adds up, and can be told to fail.
#pragma once

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/settings/stage_inputs.h"
#include "store/stored_sweep.h"

namespace umbrameter {

struct FakeParameters {
  int resolution = 256;
  double constant_bias = 0.02;
  double slope_bias = 0.0;
  std::string filter = "nearest";
};

inline Parameters describe(FakeParameters& s) {
  return Description("shadow")
      .field("resolution", s.resolution, {"texels", "resolution"})
      .field("constant-bias", s.constant_bias, {"m", "constant bias"})
      .field("slope-bias", s.slope_bias, {"texels", "slope-scaled bias"})
      .field("filter", s.filter, {"", "filter"})
      .take();
}

inline const std::vector<Column> measured = {{"pixels", "px", "counted"}, {"mae", "1", "error"}};

struct FakeSweep {
  explicit FakeSweep(const std::vector<std::string>& assignments) {
    const Parameters parameters = describe(sample);
    std::vector<SweepAxis> axes;
    for (const std::string& assignment : assignments) axes.push_back(parse_axis(parameters, assignment));
    plan = plan_sweep(parameters, axes, cost_of_change);
    const std::vector<Value> row = {std::int64_t{0}, 0.0};
    description.columns = stored_columns(parameters, plan, measured, row);
    for (const SweepAxis& axis : axes) description.axes.emplace_back(axis.key, axis.text);
    description.cells = plan.cells;
  }

  void evaluate(const CellGroup& group, const RowSink& keep) {
    ++groups;
    const std::vector<double>& constant = group.inner[0].values;
    const std::vector<double>& slope = group.inner[1].values;
    for (std::size_t s = 0; s < slope.size(); ++s) {
      for (std::size_t c = 0; c < constant.size(); ++c) {
        if (rows == fail_after_rows) throw std::runtime_error("evaluator");
        ++rows;
        const std::size_t place = c * slope.size() + s;
        keep(place, std::vector<Value>{static_cast<std::int64_t>(group.cell(place)), constant[c] + 10 * slope[s]});
      }
    }
  }

  void run(const std::filesystem::path& folder, const Progress& progress = {}) {
    ResultsStore store = ResultsStore::open(folder, description);
    run_sweep(
        plan, store, [this](const CellGroup& group, const RowSink& keep) { evaluate(group, keep); }, progress);
  }

  FakeParameters sample;
  SweepPlan plan;
  StoreDescription description;
  std::size_t groups = 0;
  std::size_t rows = 0;
  std::size_t fail_after_rows = std::numeric_limits<std::size_t>::max();
};

}  // namespace umbrameter
