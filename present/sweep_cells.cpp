#include "present/sweep_cells.h"

#include <algorithm>
#include <utility>

#include "present/plot_axes.h"
#include "present/presentation.h"
#include "results/known_statistics.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_table_cells = 20'000;

std::string head_of(const std::string& name, std::string_view kind) {
  for (const auto& [end, words] : {std::pair{lower_name(""), ", lower end"}, {upper_name(""), ", upper end"}}) {
    if (name.ends_with(end)) return head_words(name.substr(0, name.size() - end.size()), kind) + words;
  }
  return head_words(name, kind);
}

}  // namespace

ReportCells report_cells(const SweepResults& sweep, const Experiment& experiment, const std::vector<PageCell>& shown) {
  ReportCells cells;
  cells.axes = sweep.plan.axes.size();
  cells.count = sweep.plan.cells;
  std::vector<std::size_t> numbers = thin(cells.count, max_table_cells).indices;
  if (numbers.size() < cells.count) {
    for (const PageCell& cell : shown) numbers.push_back(cell.cell.number);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    cells.numbers = numbers;
  }
  std::vector<std::string> names;
  for (const StoredColumn& stored : sweep.store.description().columns) {
    cells.table.columns.push_back(stored.column);
    const bool is_axis = names.size() < cells.axes;
    cells.heads.push_back(is_axis ? stored.column.name : head_of(stored.column.name, kind_of(sweep.quantity())));
    names.push_back(stored.column.name);
  }
  cells.table.rows = sweep.store.rows(numbers, names).rows;
  cells.command = "umbrameter compare -c experiment.toml";
  cells.command_end = "-o CELL";
  if (sweep.quantity() == SweptQuantity::image && experiment.run.measure != SweepMeasure::image) {
    cells.command += " --run.measure image";
  }
  // A sweep keeps the reference's distance limit when the technique's radius varies; compare would follow the radius.
  const bool is_limit_fixed = !varies_group(sweep.plan.axes, "truth.ao-distance");
  if (varies_group(sweep.plan.axes, "ao.radius") && is_limit_fixed) {
    Experiment fixed = shown.front().experiment;
    const Parameters parameters = describe(fixed);
    cells.command += " --truth.ao-distance " + to_string(require(parameters, "truth.ao-distance").value());
  }
  for (const SweepAxis& axis : sweep.plan.axes) {
    const Parameter& parameter = require(sweep.parameters, axis.key);
    cells.units.push_back(std::holds_alternative<Length*>(parameter.field) ? std::string(unit_name(axis.length_unit))
                                                                           : "");
  }
  return cells;
}

}  // namespace umbrameter
