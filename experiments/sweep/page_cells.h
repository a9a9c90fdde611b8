// The cells of a sweep whose images its page has.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/measure/measure.h"
#include "results/page_cell.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// The cells whose images the page has, and how to measure them.
struct PageCells {
  std::vector<PageCell> cells;  ///< the cell of least error is the first
  std::function<Measurement(const PageCell&)> measure;
};

/// Reference, technique and error of one quantity at an experiment in metres; of visibility that of the selected light,
/// with its errors at every bias, also at those of `further`, where one pass gives them.
Measurement measure_swept(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                          const std::vector<double>& further = {});

/// At most `most` cells of an experiment in metres, at least one, in this order: the cell of least error; the cell
/// without varied parameters, which has the values of `sweep.parameters`; for each axis, with the other values of the
/// cell of least error, both ends, or every value of an axis of words; the cells of `best`, one for each line of the
/// figures; cells at even steps through the sweep. Cells that differ only in the constant bias count once if the images
/// at every bias are exact.
PageCells choose_page_cells(Stages& stages, const SweepResults& sweep, const Experiment& experiment, const Table& best,
                            std::size_t most);

}  // namespace umbrameter
