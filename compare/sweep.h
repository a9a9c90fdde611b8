// Sweeps: axes over described parameters, as users write them. What is measured where is in sweep_plan.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/table.h"
#include "core/parameters.h"

namespace umbrameter {

/// One varied parameter. text is what the user wrote: "0:0.2:129", "1:1000:4:log" or "256,512,1024".
struct SweepAxis {
  std::string key;
  std::string text;
  std::vector<Value> values;  ///< each accepted by the parameter
};

/// Reads "first:last:count", "first:last:count:log" or a comma-separated list for the parameter of that key.
/// Throws Error (usage) that names the axis: unknown key, malformed text, a value out of the parameter's range,
/// more than 10⁶ values.
SweepAxis parse_axis(const Parameters& parameters, std::string_view key, std::string_view text);

/// "key=text", as given to --vary.
SweepAxis parse_axis(const Parameters& parameters, std::string_view assignment);

/// Number of cells of the grid. Throws Error (usage) for more than 10⁹.
std::size_t count_cells(const std::vector<SweepAxis>& axes);

}  // namespace umbrameter
