// The page of a sweep some of whose cells are missing: what is there, under a box that says what is not. It has no
// images of cells and recommends nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "present/run_page.h"
#include "store/run_folder.h"

namespace umbrameter {

struct PartialSweep {
  const SweepResults& rows;            ///< all cells; the missing ones have no error and count no pixel
  const RunResults& run;               ///< command, experiment and scene; nothing measured
  std::size_t count = 0;               ///< cells that are there
  std::vector<std::string> missing{};  ///< "shard 3, 8 cells: from … to …"
  std::string command{};               ///< that measures what is missing
};

/// Writes index.html and figures/. Returns a line for each figure that could not be made.
std::vector<std::string> write_partial_page(RunFolder& folder, const Console& console, const PartialSweep& partial,
                                            const PageOptions& options);

}  // namespace umbrameter
