// Divides the cells of a sweep into groups that one pass can measure, in an order that reuses expensive results. Groups
// are computed on demand from their index, so memory does not grow with the number of cells. Stores no results.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/sweep.h"

namespace umbrameter {

/// The inner axes: one pass measures all their combinations.
inline constexpr std::string_view constant_bias_key = "shadow.constant-bias";
inline constexpr std::string_view slope_bias_key = "shadow.slope-bias";

/// Maximum number of cells in a group, which is stored in one transaction. A larger inner grid is split, first along
/// the slope-scaled biases.
inline constexpr std::size_t max_group_cells = 65'536;

/// Values of an inner axis: in a plan all values, in a group the values of that group.
struct InnerAxis {
  std::optional<std::size_t> axis{};  ///< index into SweepPlan::axes; empty if the bias is not varied
  std::vector<double> values{};       ///< never empty: the experiment's value if the bias is not varied
  std::size_t stride = 0;             ///< cells from one value to the next
};

struct SweepPlan {
  std::vector<SweepAxis> axes;       ///< in the user's order; in a cell's index the last axis varies fastest
  std::vector<std::size_t> strides;  ///< for each axis: cells from one of its values to the next
  std::vector<std::size_t> outer;    ///< the axes that are not inner, the most expensive to change first
  InnerAxis constant_bias;           ///< in constant_unit
  LengthUnit constant_unit = LengthUnit::metres;
  InnerAxis slope_bias;  ///< texels
  std::size_t cells = 1;
};

/// The cost of changing the parameter with this full name, in any unit.
using CostOfChange = std::function<double(std::string_view parameter)>;

/// Makes a plan in which the axes that cost most to change vary slowest. Biases that are not varied are taken from
/// `parameters`. Throws Error (usage) for an empty or repeated axis or too many cells.
SweepPlan plan_sweep(const Parameters& parameters, std::vector<SweepAxis> axes, const CostOfChange& cost);

/// The values of all axes at a cell.
std::vector<Value> values_at(const SweepPlan& plan, std::size_t cell);

/// The outer axes in the user's order.
std::vector<std::size_t> outer_axes_as_given(const SweepPlan& plan);

/// The cells with one combination of the outer values and all or some combinations of the inner ones.
struct CellGroup {
  std::size_t first_cell = 0;
  std::vector<Value> values;  ///< values of all axes at the first cell
  InnerAxis constant_bias;    ///< in the plan's constant_unit
  InnerAxis slope_bias;       ///< texels

  std::size_t size() const { return constant_bias.values.size() * slope_bias.values.size(); }
  /// Index of the cell with the group's constant-th and slope-th bias.
  std::size_t cell(std::size_t constant, std::size_t slope) const {
    return first_cell + constant * constant_bias.stride + slope * slope_bias.stride;
  }
};

std::size_t count_groups(const SweepPlan& plan);

/// The group with this index in the order of evaluation; index < count_groups().
CellGroup group_at(const SweepPlan& plan, std::size_t index);

/// The values of all axes at the cell with the group's constant-th and slope-th bias.
std::vector<Value> values_at(const CellGroup& group, std::size_t constant, std::size_t slope);

/// Receives the measured columns of the cell with the group's constant-th and slope-th bias.
using RowSink = std::function<void(std::size_t constant, std::size_t slope, std::span<const Value> measured)>;

/// Measures a group and passes each of its cells to the sink once, in any order.
using EvaluateGroup = std::function<void(const CellGroup&, const RowSink&)>;

}  // namespace umbrameter
