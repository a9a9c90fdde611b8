#include "store/stored_sweep.h"

#include <stdexcept>

#include "core/interrupt.h"

namespace umbrameter {
namespace {

void store_group(const CellGroup& group, ResultsStore& store, const EvaluateGroup& evaluate) {
  store.append(group.first_cell, [&](const CellSink& keep) {
    evaluate_whole(group, evaluate, [&](std::size_t place, std::span<const Value> measured) {
      std::vector<Value> row = values_at(group, place);
      row.insert(row.end(), measured.begin(), measured.end());
      keep(group.cell(place), row);
    });
  });
}

}  // namespace

void evaluate_whole(const CellGroup& group, const EvaluateGroup& evaluate, const RowSink& keep) {
  std::vector<bool> seen(group.size());
  std::size_t rows = 0;
  evaluate(group, [&](std::size_t place, std::span<const Value> measured) {
    if (seen.at(place)) throw std::logic_error("the evaluator gave a cell twice");
    seen[place] = true;
    keep(place, measured);
    ++rows;
  });
  if (rows != group.size()) throw std::logic_error("the evaluator left cells out");
}

std::vector<StoredColumn> stored_columns(const Parameters& parameters, const SweepPlan& plan,
                                         const std::vector<Column>& measured, std::span<const Value> sample) {
  const auto kind_of = [](const Value& value) { return static_cast<ValueKind>(value.index()); };
  std::vector<StoredColumn> columns;
  for (const SweepAxis& axis : plan.axes) {
    const FieldDescription& description = require(parameters, axis.key).description;
    columns.push_back({{axis.key, axis.unit, description.meaning}, kind_of(axis.values.front())});
  }
  for (std::size_t i = 0; i < measured.size(); ++i) columns.push_back({measured[i], kind_of(sample[i])});
  return columns;
}

void run_sweep(const SweepPlan& plan, ResultsStore& store, const EvaluateGroup& evaluate, const Progress& progress) {
  std::size_t done = store.count();
  const auto tell = [&] {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(plan.cells));
  };
  tell();
  const std::size_t groups = done < plan.cells ? count_groups(plan) : 0;
  for (std::size_t g = 0; g < groups; ++g) {
    throw_if_interrupted();
    const CellGroup group = group_at(plan, g);
    if (store.has_group(group.first_cell)) continue;
    store_group(group, store, evaluate);
    done += group.size();
    tell();
  }
  store.finish();
}

}  // namespace umbrameter
