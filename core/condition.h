// Conditions on named values, as users write them: "acne < 0.1%", "|mean_error| <= 0.02", "ao.samples <= 16"; and
// weighted sums of values: "acne + 0.5*rmse". The one parser for --fail-if, constraints and budgets. What the names
// mean is left to the caller.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

enum class Relation { less, at_most, greater, at_least };
std::string_view relation_text(Relation relation);  ///< "<", "<=", ">", ">="
bool holds(double value, Relation relation, double bound);
/// Whether it bounds values from above.
inline bool is_upper(Relation relation) { return relation == Relation::less || relation == Relation::at_most; }

/// A number and the text after it: {0.1, "%"}, {30, "dB"}, {0.001, ""}.
struct Quantity {
  double number = 0.0;
  std::string unit;
};

struct Bound {
  Relation relation = Relation::at_most;
  Quantity quantity;
};

struct Condition {
  std::string name;
  bool is_magnitude = false;  ///< of the absolute value: |name|
  Bound bound;
  std::string text;  ///< as written
};

/// One term of a sum.
struct WeightedTerm {
  double weight = 1.0;
  std::string name;
  bool is_magnitude = false;
};

/// Parses "name relation number[unit]". Throws Error (usage) that names `option`.
Condition parse_condition(std::string_view text, const std::string& option);

/// Parses "relation number[unit]", or "number[unit]" for "at most". Throws Error (usage) that names `option`.
Bound parse_bound(std::string_view text, const std::string& option);

/// Parses "name", "2*name + |other|" or "0.5*name+name". Throws Error (usage) that names `option`.
std::vector<WeightedTerm> parse_weighted_sum(std::string_view text, const std::string& option);

/// The number in the unit of a value: per cent of a share (unit 1), a length in metres (unit m), else only that unit or
/// none. Throws Error (usage) that names `option` if the written unit does not fit.
double in_unit(const Quantity& quantity, std::string_view unit, std::string_view name, const std::string& option);

}  // namespace umbrameter
