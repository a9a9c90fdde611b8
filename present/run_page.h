// From the results of a run to its page and figures, for the command that ran and for `report`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "present/presentation.h"
#include "present/summary.h"
#include "reports/files/console.h"
#include "reports/page/viewer_data.h"
#include "results/run_results.h"
#include "store/stored_run.h"
#include "store/sweep_results.h"

namespace umbrameter {

struct PageOptions {
  FigureStyle style{};
  bool with_figures = true;  ///< else no figures/ folder, and the page says so
};

/// The parts of a run in the order of its page, without figures if the options say so.
struct RunPage {
  std::vector<Presentation> parts;
  std::optional<SweepSummary> sweep{};
  ViewerPack viewer{};
};

/// `rows` are those of a sweep, else null.
RunPage present_run(const RunResults& results, const SweepResults* rows, const PageOptions& options);

/// Removes all figures from the parts.
void leave_out_figures(RunPage& page);

/// "figures/error_ao.svg" and so on, of the figures that the sections show.
std::vector<std::string> figure_files(const std::vector<ReportSection>& sections);
std::vector<std::string> figure_files(const RunPage& page);

/// Whether it is a sweep that kept its cells.
bool has_stored_cells(const std::filesystem::path& folder, const StoredRun& run);

/// What a finished run shows: "1280×720 pixels, camera overview, 95,204 triangles". Empty of a tuning, and of a run
/// that another version stored. Throws Error as read_run_value() does.
std::string stored_view(const std::filesystem::path& folder);

/// The figures of a finished run, drawn again from what it stored; no cell is measured and no scene is read. Of
/// images.exr, as compare draws them: reference, technique, error and causes of each light, ambient occlusion and its
/// stages, the error of the shaded image. Of summary.json: the stages as a sum. Of a sweep that kept its cells: its
/// plots and heat maps; of another version's sweep without the fits that need facts of the scene. Captions name
/// technique and settings as those of the run do, unless another version stored it. Throws Error as FinishedSweep and
/// read_run_value() do.
std::vector<Figure> stored_figures(const std::filesystem::path& folder, const StoredRun& run);

/// Draws the figures into DIR/figures, in parallel, and completes their captions. Returns a line for each that could
/// not be made.
std::vector<std::string> draw_figures(const std::filesystem::path& folder, const Console& console,
                                      const RunResults& results, RunPage& page, const PageOptions& options);

/// Writes DIR/index.html from the figures in DIR/figures.
void write_run_page(const std::filesystem::path& folder, const RunResults& results, const SweepResults* rows,
                    const RunPage& page, const std::vector<std::string>& problems, const PageOptions& options);

}  // namespace umbrameter
