// Sweeps: axes over described parameters, as users write them. What is measured where is in sweep_plan.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "core/table.h"

namespace umbrameter {

/// One varied parameter. text is what the user wrote: "0:0.2:129", "1:1000:4:log" or "256,512,1024".
struct SweepAxis {
  std::string key;
  std::string text;
  std::vector<Value> values;  ///< each accepted by the parameter; of lengths the numbers
  std::string unit{};         ///< of the values: the parameter's or, of lengths in another unit, that one
  LengthUnit length_unit = LengthUnit::metres;  ///< of lengths
};

/// Sets the axis's parameter to one of its values.
void set_value(const Parameters& parameters, const SweepAxis& axis, const Value& value);

/// Reads "first:last:count", "first:last:count:log" or a comma-separated list for the parameter of that key.
/// Lengths have a unit each, or none (metres); a 0 without a unit goes with any other: "0:4texels:33".
/// Throws Error (usage) that names the axis: unknown key, malformed text, a value out of the parameter's range,
/// lengths of several units, more than 10⁶ values.
SweepAxis parse_axis(const Parameters& parameters, std::string_view key, std::string_view text);

/// "key=text", as given to --vary.
SweepAxis parse_axis(const Parameters& parameters, std::string_view assignment);

/// Number of cells of the grid. Throws Error (usage) for more than 10⁹.
std::size_t count_cells(const std::vector<SweepAxis>& axes);

}  // namespace umbrameter
