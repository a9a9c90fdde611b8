// The cells of a sweep on its page: the numbers of all cells, and the images of a few.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/measure.h"
#include "experiments/sweep_results.h"
#include "reports/page/cells.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {

/// A cell whose images the page has.
struct PageCell {
  ViewerCell cell;        ///< its number and why it was chosen
  Experiment experiment;  ///< lengths of ambient occlusion in metres
};

/// The cells whose images the page has, and how to measure them.
struct PageCells {
  std::vector<PageCell> cells;  ///< the cell of least error is the first
  std::function<Measurement(const PageCell&)> measure;
};

/// Reference, technique and error of one quantity at an experiment whose lengths of ambient occlusion are in metres; of
/// visibility that of the selected light, with its errors at every bias, also at those of `further`, where one pass
/// gives them.
Measurement measure_swept(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                          const std::vector<double>& further = {});

/// At most `most` cells, at least one, in this order: the cell of least error; the cell without varied parameters,
/// which has the values of `experiment`; for each axis, with the other values of the cell of least error, both ends, or
/// every value of an axis of words; the cells of `best`, one for each line of the figures; cells at even steps through
/// the sweep. Cells that differ only in the constant bias count once if the images at every bias are exact.
PageCells choose_page_cells(Stages& stages, const SweepResults& sweep, const Experiment& experiment, const Table& best,
                            std::size_t most);

/// The rows of the sweep, at most 20,000 at even steps and those of `shown`, and what repeats a cell with `compare`.
ReportCells report_cells(const SweepResults& sweep, const Experiment& experiment, const PageCells& shown);

}  // namespace umbrameter
