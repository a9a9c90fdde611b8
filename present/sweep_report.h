// How a sweep is shown: its best rows and its curves, read from the store by what each needs.
#pragma once

#include <string>
#include <vector>

#include "present/axis_ends.h"
#include "present/bias_report.h"
#include "present/presentation.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// For each line of the plots its row of least error, by the values that tell the lines apart; at most 1,000.
Table best_rows(const SweepResults& sweep);

/// Those of the axes whose parameters change something in the cell of a row: no size of a kernel that its filter lacks.
std::vector<std::size_t> read_axes(const SweepResults& sweep, const std::vector<Value>& row,
                                   std::vector<std::size_t> axes);
/// A value of an axis with its unit: "5 cm"; with fewer digits than sweep.csv.
std::string value_text(const SweepAxis& axis, const Value& value);
/// The values of those axes: "shadow.resolution 256 texels".
std::string row_text(const SweepResults& sweep, const std::vector<Value>& row, const std::vector<std::size_t>& axes);
/// Those of all axes that the cell reads, or of all where it reads none: "shadow.constant-bias 0.05 m,
/// shadow.resolution 256".
std::string cell_text(const SweepResults& sweep, const std::vector<Value>& row);

/// Whether every cell has the same value in each measured column, and there are several.
bool are_all_equal(const SweepResults& sweep);

/// The axes whose optimum lies at an end of theirs, of the rows of best_rows().
std::vector<OpenEnd> open_ends(const SweepResults& sweep, const Table& best);

/// `is_flat` is are_all_equal(), which reads every cell.
Presentation present_sweep(const SweepResults& sweep, const Table& best, const std::optional<BiasCurves>& curves,
                           const std::vector<OpenEnd>& open_ends, bool is_flat);

}  // namespace umbrameter
