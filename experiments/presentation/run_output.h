// The files of a run, by the contract: experiment.toml, images.exr, sweep.csv, figures, summary.json, index.html.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "experiments/console.h"
#include "experiments/presentation/page_cells.h"
#include "experiments/presentation/presentation.h"
#include "experiments/presentation/summary.h"
#include "experiments/results_store.h"
#include "experiments/run_folder.h"

namespace umbrameter {

/// Everything to write. summary.files and summary.problems are filled in on the way.
struct RunOutput {
  std::string title;
  std::string subtitle;
  std::vector<Presentation> parts;
  SummaryInput summary;
  const ResultsStore* results = nullptr;  ///< of a sweep: sweep.csv is a view of it
  std::vector<std::uint32_t> maps{};      ///< lights whose shadow maps are written
  bool with_ao_inputs = false;            ///< writes what the technique of ambient occlusion reads
  FigureStyle figure_style{};
  bool with_figures = true;           ///< else no figures/ folder, and the page says so
  bool with_full_images = false;      ///< the page's viewer gets every pixel of large images, too
  PageCells cells{};                  ///< of a sweep; the first cell is that of summary.measurement
  std::optional<ReportCells> rows{};  ///< of a sweep: the numbers of its cells
};

/// The complete experiment file.
std::string experiment_text(Experiment experiment);

/// What write_run() writes besides figures; `with_rows` for a sweep.
std::vector<std::string> run_files(bool with_rows);

/// Prints the lines of each part, then writes the files into the folder, the page last, and prints where the page is.
/// ExitCode::partial, with a line on stderr for each, when a figure could not be made.
ExitCode write_run(RunFolder& folder, const Console& console, RunOutput output);

/// "1280×720, camera overview, 95,204 triangles".
std::string subtitle_of(const Stages& stages, const View& view);

}  // namespace umbrameter
