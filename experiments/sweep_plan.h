// The cells of a sweep in groups that one pass can answer: each made from its number when its turn comes, in an order
// that reuses what is expensive. Holds the axes and nothing that grows with their product; keeps no results.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/sweep.h"

namespace umbrameter {

/// The inner axes: one pass answers all their combinations.
inline constexpr std::string_view constant_bias_key = "shadow.constant-bias";
inline constexpr std::string_view slope_bias_key = "shadow.slope-bias";

/// A group is stored in one transaction; a larger inner grid is split, the slope-scaled biases first.
inline constexpr std::size_t max_group_cells = 65'536;

/// Values of an inner axis; of the plan all, of a group its own.
struct InnerAxis {
  std::optional<std::size_t> axis{};  ///< its place among the axes; nothing where it is not varied
  std::vector<double> values{};       ///< never empty: the experiment's own value where it is not varied
  std::size_t stride = 0;             ///< cells from one value to the next
};

struct SweepPlan {
  std::vector<SweepAxis> axes;       ///< as given; a cell's index counts with the last one running fastest
  std::vector<std::size_t> strides;  ///< of each axis: cells from one of its values to the next
  std::vector<std::size_t> outer;    ///< the axes that are not inner, the most expensive to change first
  InnerAxis constant_bias;           ///< in constant_unit
  LengthUnit constant_unit = LengthUnit::metres;
  InnerAxis slope_bias;  ///< texels
  std::size_t cells = 1;
};

/// What changing the parameter of that full name costs, in any unit.
using CostOfChange = std::function<double(std::string_view parameter)>;

/// The axes that cost most to change come first. Throws Error (usage) for an empty or repeated axis or too many cells.
/// Values that are not varied are read off the parameters.
SweepPlan plan_sweep(const Parameters& parameters, std::vector<SweepAxis> axes, const CostOfChange& cost);

/// The values of all axes at a cell.
std::vector<Value> values_at(const SweepPlan& plan, std::size_t cell);

/// The outer axes in the order in which they were given.
std::vector<std::size_t> outer_axes_as_given(const SweepPlan& plan);

/// One combination of the outer values with all combinations of the inner ones, or a part of these.
struct CellGroup {
  std::size_t first_cell = 0;
  std::vector<Value> values;  ///< of all axes at the first cell
  InnerAxis constant_bias;    ///< in the plan's constant_unit
  InnerAxis slope_bias;       ///< texels

  std::size_t size() const { return constant_bias.values.size() * slope_bias.values.size(); }
  /// Index of the cell with these of the group's biases.
  std::size_t cell(std::size_t constant, std::size_t slope) const {
    return first_cell + constant * constant_bias.stride + slope * slope_bias.stride;
  }
};

std::size_t count_groups(const SweepPlan& plan);

/// The group of that number, below count_groups(), in the order of evaluation.
CellGroup group_at(const SweepPlan& plan, std::size_t index);

/// The values of all axes at a group's cell with these of its biases.
std::vector<Value> values_at(const CellGroup& group, std::size_t constant, std::size_t slope);

/// Takes the measured columns of the cell with the group's constant-th and slope-th bias.
using RowSink = std::function<void(std::size_t constant, std::size_t slope, std::span<const Value> measured)>;

/// Measures a group: gives the sink each of its cells once, in any order.
using EvaluateGroup = std::function<void(const CellGroup&, const RowSink&)>;

}  // namespace umbrameter
