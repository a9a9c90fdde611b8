// Where plots have the ticks of scales that Vega-Lite has no good ticks for: logarithms and square roots.
#pragma once

#include <vector>

namespace umbrameter {

/// Ticks of a logarithmic axis within the range: 1, 2 and 5 times powers of ten, the powers alone where these are too
/// many, and closer ones where they are fewer than three.
std::vector<double> log_ticks(double lowest, double highest);

/// Of a scale that ends at ticks.
struct TickedRange {
  double first = 0.0;
  double last = 0.0;
  std::vector<double> ticks;  ///< ascending, from `first` to `last`
};

/// A logarithmic scale that holds the range, which is positive and not empty.
TickedRange log_range(double lowest, double highest);

/// A scale of square roots from 0 to at least `highest`, which is positive: 0 and 1, 2 and 5 times powers of ten, as
/// many as have room for their labels on an axis of this length [units].
TickedRange square_root_range(double highest, double length, bool is_horizontal);

/// How the ticks of a logarithmic axis are labelled: with as many digits as they need, or all with a power of ten,
/// "1e-5", where some would have more than three decimals or six digits before them.
const char* log_tick_label(const std::vector<double>& ticks);

}  // namespace umbrameter
