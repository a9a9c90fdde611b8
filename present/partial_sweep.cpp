#include "present/partial_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "present/sweep_report.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

constexpr std::size_t most_missing = 20;

// What present_sweep() says of all cells holds for those that are there.
Presentation present_rows_there(const PartialSweep& partial, const std::string& cells) {
  Table best = best_rows(partial.rows);
  const std::size_t error = column_index(best, error_statistic);
  std::erase_if(best.rows, [&](const std::vector<Value>& row) { return std::isnan(to_number(row[error])); });
  Presentation part = present_sweep(partial.rows, best, std::nullopt, {}, are_all_equal(partial.rows));
  part.section.title += " that are there";
  for (Headline& headline : part.section.headlines) {
    if (headline.label == "cells") headline = {"cells", cells, "one row each in sweep.partial.csv"};
  }
  return part;
}

void add_warnings(Report& report, const PartialSweep& partial, const std::string& cells) {
  report.warning_title = "Partial result: " + cells + " cells";
  report.warnings.push_back(
      "Numbers and figures cover the cells that are there; the least error may lie in a missing one. Missing:");
  const std::size_t listed = std::min(partial.missing.size(), most_missing);
  report.warnings.insert(report.warnings.end(), partial.missing.begin(),
                         partial.missing.begin() + static_cast<std::ptrdiff_t>(listed));
  if (listed < partial.missing.size()) {
    report.warnings.push_back(fmt::format("and {} more shards", grouped(partial.missing.size() - listed)));
  }
}

}  // namespace

std::vector<std::string> write_partial_page(RunFolder& folder, const Console& console, const PartialSweep& partial,
                                            const PageOptions& options) {
  const std::string cells = fmt::format("{} of {}", grouped(partial.count), grouped(partial.rows.plan.cells));
  Report report;
  add_warnings(report, partial, cells);
  RunPage page;
  if (partial.count > 0) page.parts.push_back(present_rows_there(partial, cells));
  if (!options.with_figures) leave_out_figures(page);
  folder.announce(figure_files(page));
  report.notes = draw_figures(folder.path(), console, partial.run, page, options);
  report.title = scene_title(partial.run.experiment) + ": partial sweep";
  report.subtitle = fmt::format("{}×{} pixels, {} triangles", partial.run.experiment.view.size.width,
                                partial.run.experiment.view.size.height, grouped(partial.run.scene.triangles));
  report.command_title = "Measure the missing cells";
  report.command = partial.command;
  for (Presentation& part : page.parts) {
    report.answers.insert(report.answers.end(), part.answers.begin(), part.answers.end());
    report.sections.push_back(std::move(part.section));
  }
  report.settings = settings_table(partial.run.experiment);
  write_page(folder.path(), report);
  return report.notes;
}

}  // namespace umbrameter
