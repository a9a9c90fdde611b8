// The cells of a sweep as the page holds them, so that it can show the numbers of any cell.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/table.h"

namespace umbrameter {

struct ReportCells {
  Table table;                         ///< first the columns of the axes, then the measured ones
  std::size_t axes = 0;                ///< number of axes
  std::vector<std::string> heads{};    ///< the columns' names in words; empty: the names
  std::vector<std::size_t> numbers{};  ///< each row's index in sweep.csv; empty if the table has all cells
  std::size_t count = 0;               ///< cells of the sweep
  /// What repeats a cell: `command`, for each axis "--name value" with the value in `units`, then `command_end`.
  std::string command;
  std::vector<std::string> units{};
  std::string command_end;
};

/// Rounded to eight significant digits: shorter, and rounded again to five it is hardly ever another number.
double eight_digits(double value);

/// What the page's script reads (viewer/cells.ts). Measured values have eight significant digits.
nlohmann::ordered_json cells_json(const ReportCells& cells);

/// Which columns of a chart's points are columns of the cells, so that the page can tell which cell a point shows.
struct ChartCells {
  std::string stem;                                            ///< of the figure
  std::vector<std::pair<std::string, std::string>> columns{};  ///< of the chart, of the cells
  std::vector<std::pair<std::string, Value>> fixed{};          ///< what holds for all points
};

/// {"columns": {…}, "fixed": {…}}.
nlohmann::ordered_json chart_cells_json(const ChartCells& cells);

}  // namespace umbrameter
