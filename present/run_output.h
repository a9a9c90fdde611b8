// The files of a run, by the contract: experiment.toml, images.exr, sweep.csv, figures, summary.json, index.html.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "present/presentation.h"
#include "present/summary.h"
#include "reports/files/console.h"
#include "reports/files/exr.h"
#include "reports/page/cells.h"
#include "reports/page/viewer_data.h"
#include "results/costs.h"
#include "store/results_store.h"
#include "store/run_folder.h"

namespace umbrameter {

/// Everything to write. summary.files and summary.problems are filled in on the way.
struct RunOutput {
  std::string title;
  std::string subtitle;
  std::vector<Presentation> parts;
  SummaryInput summary;
  const ResultsStore* results = nullptr;  ///< of a sweep: sweep.csv is a view of it
  /// Further files: shadow maps, and what the technique of ambient occlusion reads.
  std::vector<std::pair<std::string, LayeredImage>> images{};
  std::vector<std::pair<std::string, std::string>> texts{};
  Costs costs{};
  std::uint64_t peak_resident_bytes = 0;
  FigureStyle figure_style{};
  bool with_figures = true;          ///< else no figures/ folder, and the page says so
  bool with_full_images = false;     ///< the page's viewer gets every pixel of large images, too
  std::optional<ViewerCell> cell{};  ///< of a sweep: that of summary.measurement
  /// Of a sweep: adds the images of further cells to the page's.
  std::function<void(ViewerPack& pack)> add_cells{};
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
std::string subtitle_of(const SceneFacts& scene, const View& view);

}  // namespace umbrameter
