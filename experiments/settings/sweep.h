// The axes of a sweep and their parser. sweep_plan.h divides the sweep into cells and groups.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters.h"
#include "core/table.h"

namespace umbrameter {

/// One varied parameter. text is what the user wrote: "0:0.2:129", "1:1000:4:log" or "256,512,1024".
struct SweepAxis {
  std::string key;
  std::string text;
  std::vector<Value> values;  ///< each accepted by the parameter; for lengths the numbers, in length_unit
  std::string unit{};         ///< of the values: the parameter's unit, or length_unit if that differs
  LengthUnit length_unit = LengthUnit::metres;  ///< only for lengths
};

/// Sets the axis's parameter to one of its values.
void set_value(const Parameters& parameters, const SweepAxis& axis, const Value& value);

/// Parses "first:last:count", "first:last:count:log" or a comma-separated list for the parameter with this key.
/// Each length has a unit; without a unit it is in metres. A 0 needs no unit: "0:4texels:33".
/// Throws Error (usage) that names the axis: unknown key, malformed text, a value out of the parameter's range,
/// lengths of several units, more than 10⁶ values.
SweepAxis parse_axis(const Parameters& parameters, std::string_view key, std::string_view text);

/// Key and text of "key=text", the argument of --vary. Throws Error (usage) if there is no '='.
std::pair<std::string, std::string> split_assignment(const std::string& assignment);

/// Parses "key=text".
SweepAxis parse_axis(const Parameters& parameters, const std::string& assignment);

/// parse_axis() of each key and text.
std::vector<SweepAxis> parse_axes(const Parameters& parameters,
                                  const std::vector<std::pair<std::string, std::string>>& axes);

/// Number of cells of the grid. Throws Error (usage) for more than 10⁹.
std::size_t count_cells(const std::vector<SweepAxis>& axes);

}  // namespace umbrameter
