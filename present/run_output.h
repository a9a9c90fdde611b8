// The files of a run, by the contract: experiment.toml, images.exr, sweep.csv, figures, run.bin, summary.json,
// index.html.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "present/run_page.h"
#include "reports/files/console.h"
#include "reports/files/exr.h"
#include "results/costs.h"
#include "results/run_results.h"
#include "store/run_folder.h"

namespace umbrameter {

/// What is written and said besides the results themselves.
struct RunOutput {
  PageOptions page{};
  std::string experiment_toml;
  const SweepResults* rows = nullptr;  ///< of a sweep: sweep.csv is a view of its store
  /// Further files: shadow maps, what the technique of ambient occlusion reads, the table of a tuning.
  std::vector<std::pair<std::string, LayeredImage>> images{};
  std::vector<std::pair<std::string, std::string>> texts{};
  std::string costs{};                 ///< for --verbose
  std::vector<std::string> closing{};  ///< lines before the one that names the page
  std::filesystem::path journal{};     ///< of a search: not needed once all is written
};

/// The complete experiment file.
std::string experiment_text(Experiment experiment);

/// The costs of a run in one line: triangles, build time, rays, ray rates and memory. Empty if nothing was traced.
std::string costs_text(const Costs& costs, std::uint64_t peak_resident_bytes);

/// What write_run() writes besides figures; `with_rows` for a sweep.
std::vector<std::string> run_files(bool with_rows);

/// Ends a run or a report whose page is written: prints where that is, and a line on stderr for each problem, which
/// makes ExitCode::partial.
ExitCode finish_run(RunFolder& folder, const Console& console, const std::vector<std::string>& problems);

/// Prints the lines of each part, then writes the files into the folder, the page last, and prints where the page is.
/// ExitCode::partial, with a line on stderr for each, when a figure could not be made.
ExitCode write_run(RunFolder& folder, const Console& console, RunResults results, RunOutput output);

}  // namespace umbrameter
