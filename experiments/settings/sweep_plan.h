// Divides the cells of a sweep into groups that one pass can measure, in an order that reuses expensive results. Groups
// are computed on demand from their index, so memory does not grow with the number of cells. Stores no results.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/settings/sweep.h"

namespace umbrameter {

/// The inner axes of a sweep of shadows: one pass measures all their combinations.
inline constexpr std::string_view constant_bias_key = "shadow.constant-bias";
inline constexpr std::string_view slope_bias_key = "shadow.slope-bias";

/// Maximum number of cells in a group, which is stored in one transaction. A larger inner grid is split, first along
/// its last axis, into equal parts.
inline constexpr std::size_t max_group_cells = 65'536;

/// number / by, rounded up.
constexpr std::size_t divide_up(std::size_t number, std::size_t by) { return (number + by - 1) / by; }

/// Values of an inner axis: in a plan all values, in a group the values of that group.
struct InnerAxis {
  std::optional<std::size_t> axis{};  ///< index into SweepPlan::axes; empty if the bias is not varied
  std::vector<double> values{};       ///< never empty: the experiment's value if the bias is not varied
  std::size_t stride = 0;             ///< cells from one value to the next
  std::size_t parts = 1;              ///< in a plan: each group has one of so many parts of the values
};

struct SweepPlan {
  std::vector<SweepAxis> axes;       ///< in the user's order; in a cell's index the last axis varies fastest
  std::vector<std::size_t> strides;  ///< for each axis: cells from one of its values to the next
  std::vector<std::size_t> outer;    ///< the axes that are not inner, the most expensive to change first
  std::vector<InnerAxis> inner;      ///< one for each inner key, in that order
  InnerAxis constant_bias;           ///< in constant_unit; also if it is no inner axis
  LengthUnit constant_unit = LengthUnit::metres;
  InnerAxis slope_bias;  ///< texels
  std::size_t cells = 1;
};

/// The cost of changing the parameter with this full name, in any unit.
using CostOfChange = std::function<double(std::string_view parameter)>;

/// The full names of parameters whose combinations one pass measures.
using InnerKeys = std::vector<std::string_view>;

/// Makes a plan in which the axes that cost most to change vary slowest. Inner parameters that are not varied have
/// their value in `parameters`. Throws Error (usage) for an empty or repeated axis or too many cells.
SweepPlan plan_sweep(const Parameters& parameters, std::vector<SweepAxis> axes, const CostOfChange& cost,
                     const InnerKeys& inner = {constant_bias_key, slope_bias_key});

/// The values of all axes at a cell.
std::vector<Value> values_at(const SweepPlan& plan, std::size_t cell);

/// The outer axes in the user's order.
std::vector<std::size_t> outer_axes_as_given(const SweepPlan& plan);

/// The cells with one combination of the outer values and all or some combinations of the inner ones. The place of a
/// cell in its group counts these combinations; the last inner axis varies fastest.
struct CellGroup {
  std::size_t first_cell = 0;
  std::vector<Value> values;     ///< values of all axes at the first cell
  std::vector<InnerAxis> inner;  ///< as in the plan, with the values of this group

  std::size_t size() const;
  /// Index of the cell at a place of the group.
  std::size_t cell(std::size_t place) const;
};

/// Cuts each combination of outer values into at least so many groups, or into its cells if there are fewer.
void cut_groups(SweepPlan& plan, std::size_t parts);

/// The number of groups with the same outer values, one after the other.
std::size_t parts_of_group(const SweepPlan& plan);

std::size_t count_groups(const SweepPlan& plan);

/// The group with this index in the order of evaluation; index < count_groups().
CellGroup group_at(const SweepPlan& plan, std::size_t index);

/// Passes the cells of `count` groups from `first` on, in as few groups of at most max_group_cells as the order of
/// evaluation gives: groups that were cut from one are joined again.
void for_each_joined_group(const SweepPlan& plan, std::size_t first, std::size_t count,
                           const std::function<void(const CellGroup&)>& take);

/// The values of all axes at the cell at a place of the group.
std::vector<Value> values_at(const CellGroup& group, std::size_t place);

/// Receives the measured columns of the cell at a place of the group.
using RowSink = std::function<void(std::size_t place, std::span<const Value> measured)>;

/// Measures a group and passes each of its cells to the sink once, in any order.
using EvaluateGroup = std::function<void(const CellGroup&, const RowSink&)>;

}  // namespace umbrameter
