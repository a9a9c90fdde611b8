// Whether the error of a sweep still falls at an end of an axis, so that no value on the axis is known to be the best.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "store/sweep_results.h"

namespace umbrameter {

enum class AxisEnd { none, lower, upper };

/// The end of an axis at which a value lies, where the axis could go on: nothing lies beyond a limit of the parameter,
/// nor beyond 0, but for a constant bias: where another bias is too large, it has to be negative. The values are in any
/// order; one alone has no ends.
AxisEnd end_of(std::span<const double> values, double value, const Parameter& parameter);

/// One axis whose end holds the least error while the neighbouring value has more; none of the reference's.
struct OpenEnd {
  std::string axis;
  AxisEnd end = AxisEnd::none;
  double value = 0.0;
  std::string unit;
  std::string setting;  ///< of the other axes: "resolution 512"; empty where there are none
};

/// The open ends of the axes over which each row of `best` is the least error: all axes but `listed_axes`, whose values
/// tell the rows apart. Reads at most 200 rows.
std::vector<OpenEnd> find_open_ends(const SweepResults& sweep, const Table& best,
                                    std::span<const std::size_t> listed_axes);

/// "ao.radius: the least error is at the upper end of the axis (2 m); extend it", one line an axis and end.
std::vector<std::string> to_lines(const std::vector<OpenEnd>& ends);

/// "open_ends" of summary.json.
nlohmann::ordered_json to_json(const std::vector<OpenEnd>& ends);

}  // namespace umbrameter
