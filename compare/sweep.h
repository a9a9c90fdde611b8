// Sweeps: the cells of a grid over described parameters, in groups that an evaluator can answer together.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/table.h"
#include "core/parallel.h"
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

/// The values of every axis at one cell, one for each axis.
struct SweepCell {
  std::size_t index = 0;  ///< row of the result: the last axis runs fastest
  std::vector<Value> values;
};

/// Measures a group of cells that differ only in the inner axes: one row of measured columns for each cell.
using EvaluateGroup = std::function<std::vector<std::vector<Value>>(std::span<const SweepCell>)>;

/// Runs all cells, grouped by the values of the axes whose key is not among inner_keys, so that an evaluator can keep
/// what those cells share. The rows come in grid order whatever the order of evaluation: axis columns, then measured.
/// Throws Error (usage) for an empty or repeated axis or more than 10⁷ cells, and what the evaluator throws.
Table run_sweep(const Parameters& parameters, const std::vector<SweepAxis>& axes,
                std::span<const std::string_view> inner_keys, const std::vector<Column>& measured,
                const EvaluateGroup& evaluate, const Progress& progress = {});

/// Number of cells of the grid.
std::size_t count_cells(const std::vector<SweepAxis>& axes);

/// The row with the least value of a numeric column, the first of equals. Throws std::out_of_range for an unknown
/// column. Rows must not be empty.
std::size_t least_row(const Table& table, std::string_view column);

/// Index of a column. Throws std::out_of_range when there is none of that name.
std::size_t column_index(const Table& table, std::string_view name);

/// A numeric value as double.
double to_number(const Value& value);

}  // namespace umbrameter
