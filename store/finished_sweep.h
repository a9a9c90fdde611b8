// A finished sweep, opened from its folder: no cell is measured and no scene is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "store/sweep_results.h"

namespace umbrameter {

class FinishedSweep {
 public:
  /// Throws Error as load_experiment() and ResultsStore::load() do, and (unreadable_input) if both files belong to
  /// different sweeps or another version with other statistics wrote them.
  explicit FinishedSweep(const std::filesystem::path& folder);
  FinishedSweep(const FinishedSweep&) = delete;  // the parameters point into the experiment
  FinishedSweep& operator=(const FinishedSweep&) = delete;

  /// Refers to this object.
  SweepResults rows(const std::string& ao_limit = {}) const {
    return {parameters_, plan_, store_, statistics_, ao_limit, metrics_};
  }

 private:
  ResultsStore store_;
  Experiment experiment_;
  Parameters parameters_;
  SweepPlan plan_;
  CellStatistics statistics_;
  std::vector<MetricColumn> metrics_;
};

}  // namespace umbrameter
