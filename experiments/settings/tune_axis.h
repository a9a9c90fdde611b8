// The axes of a tuning: what each parameter may be. A superset of the axes of a sweep, because a tuning chooses the
// values between the ends by itself.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/sweep.h"

namespace umbrameter {

/// "0:8texels" and "0.1:2:log" vary continuously. "0:1:11", "1,2,4" and whole numbers take the values listed.
struct TuneAxis {
  SweepAxis axis;  ///< of a continuous one, `values` are its two ends
  bool is_continuous = false;
  bool is_logarithmic = false;

  const std::string& key() const { return axis.key; }
  std::size_t count() const { return axis.values.size(); }
  bool is_word() const;  ///< its values have no order
};

/// Parses "first:last", "first:last:log" or an axis of a sweep. Throws Error (usage) as parse_axis() does.
TuneAxis parse_tune_axis(const Parameters& parameters, std::string_view key, std::string_view text);

/// The value at a position from 0 to 1: the first end or value is at 0, the last at 1.
Value value_at(const TuneAxis& axis, double position);

/// The position of a value; outside 0 to 1 if it is beyond the ends; of a word its place in the list, −1 if not listed.
double position_of(const TuneAxis& axis, const Value& value);

/// The parameter's present value in the unit of the axis: the number of a Length, or "1.5texels" if it has another
/// unit.
Value present_value(const Parameters& parameters, const TuneAxis& axis);

}  // namespace umbrameter
