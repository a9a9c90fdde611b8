// summary.json: the numbers of a run for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/measure.h"

namespace umbrameter {

/// Everything that summary.json is made from; empty parts are left out.
struct SummaryInput {
  std::string command;
  Experiment experiment;
  const Workbench* workbench = nullptr;
  const Measurement* measurement = nullptr;
  const Table* sweep = nullptr;
  std::vector<std::size_t> best_rows;  ///< of the sweep
  std::string gl_renderer;             ///< empty when OpenGL was not used
  std::vector<std::string> files;      ///< written, relative to the output folder
  std::vector<std::string> problems;   ///< what could not be made
};

/// The JSON text. Holds no times or paths, so that equal runs give equal bytes.
std::string to_summary_json(const SummaryInput& input);

}  // namespace umbrameter
