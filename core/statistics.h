// The one description of every measured quantity. Columns of CSV and SQLite, keys of JSON, tables and the curves of a
// sweep all come from it.
//
// A statistics struct holds plain values; a free function describe(Struct&) beside it lists each of them once and
// returns the list bound to that object, for reading and for writing.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/table.h"

namespace umbrameter {

/// A statistic and its 95 % interval from the reference's sampling, or bounds that hold in at least 95 %.
struct Estimate {
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// The figure that shows a statistic against the axis of a sweep. Without a title there is none.
struct CurveDescription {
  std::string title{};  ///< "Mean absolute error of visibility"
  std::string label{};  ///< of the value axis: "mean absolute error [% of counted pixels]"
  bool logarithmic = false;
};

/// One described value of one object. An Estimate makes three columns: name, name_lo and name_hi.
struct Statistic {
  std::string name;     ///< as columns and keys write it: "mae"
  std::string unit;     ///< "m", "px"; "1" for shares
  std::string meaning;  ///< one sentence, no full stop
  CurveDescription curve{};
  std::variant<std::uint64_t*, double*, Estimate*> field;
  bool is_share = false;  ///< a mean over the counted pixels of values from 0 to 1, such as the share that is so

  bool has_interval() const { return std::holds_alternative<Estimate*>(field); }
};

using Statistics = std::vector<Statistic>;

/// Collects the values of one struct.
class StatisticsDescription {
 public:
  template <class Field>
  StatisticsDescription& field(const char* name, Field& member, const char* unit, std::string meaning,
                               CurveDescription curve = {}) {
    statistics_.push_back({name, unit, std::move(meaning), std::move(curve), &member});
    return *this;
  }
  template <class Field>
  StatisticsDescription& share(const char* name, Field& member, std::string meaning, CurveDescription curve = {}) {
    statistics_.push_back({name, "1", std::move(meaning), std::move(curve), &member, true});
    return *this;
  }
  Statistics take() { return std::move(statistics_); }

 private:
  Statistics statistics_;
};

/// Names that other code relies on; every statistics struct describes both.
inline constexpr std::string_view pixels_statistic = "pixels";  ///< how many pixels were measured
inline constexpr std::string_view error_statistic = "mae";      ///< what a sweep minimises

std::string lower_name(std::string_view statistic);  ///< "mae_lo"
std::string upper_name(std::string_view statistic);  ///< "mae_hi"

std::vector<Column> columns_of(const Statistics& statistics);

/// The names under which these members of the described object are listed: names_of(describe(s), {&s.mae}).
std::vector<std::string> names_of(const Statistics& statistics, std::initializer_list<const void*> members);

/// The values in the order of columns_of(). Over no pixels there is no error: real numbers become NaN, which files
/// write as nan or null, so that nothing measured never looks like a perfect score.
std::vector<Value> row_of(const Statistics& statistics);

/// The same of a struct with a describe().
template <class Struct>
requires requires(Struct& object) { describe(object); }
std::vector<Column> columns_of(Struct object) { return columns_of(describe(object)); }
template <class Struct>
requires requires(Struct& object) { describe(object); }
std::vector<Value> row_of(Struct object) { return row_of(describe(object)); }

/// Reads rows with these columns into an object, by name. Columns that the object does not describe are ignored.
class RowReader {
 public:
  using Target = std::variant<std::monostate, std::uint64_t*, double*>;
  RowReader(const Statistics& statistics, std::span<const std::string> columns);
  void read(std::span<const Value> row) const;

 private:
  std::vector<Target> targets_;
};

}  // namespace umbrameter
