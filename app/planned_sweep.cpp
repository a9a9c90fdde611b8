#include "app/planned_sweep.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/interrupt.h"
#include "store/shard_file.h"
#include "store/stored_sweep.h"

namespace umbrameter {

StoreDescription load_planned(const PlannedFolder& planned, SweepRun& sweep, const Console& console) {
  sweep.load(console);
  StoreDescription description = sweep.description();
  require_planned(planned.folder, planned.plan, portable_identity(description));
  return description;
}

Identity portable_identity(const StoreDescription& description) {
  Identity identity = description.settings;
  std::erase_if(identity, [](const auto& entry) { return entry.first == "scene"; });
  return identity;
}

std::vector<ValueKind> measured_kinds(const StoreDescription& description, const SweepPlan& plan) {
  std::vector<ValueKind> kinds;
  for (std::size_t i = plan.axes.size(); i < description.columns.size(); ++i) {
    kinds.push_back(description.columns[i].kind);
  }
  return kinds;
}

ShardMeasurer load_sweep_measurer(const PlannedFolder& planned, const Console& console) {
  const auto sweep = std::make_shared<SweepRun>(planned.line, planned.given);
  ShardMeasurer measurer;
  measurer.maker = load_planned(planned, *sweep, console).maker;
  Stages& stages = *sweep->stages;
  measurer.measured_by = measuring_identity(stages);
  measurer.notes = [sweep, loaded = static_cast<std::ptrdiff_t>(stages.notes().size())] {
    return std::vector<std::string>(sweep->stages->notes().begin() + loaded, sweep->stages->notes().end());
  };
  measurer.report_tracing = [sweep](const Progress& to) { sweep->stages->report_tracing(to); };
  SweepPlan cut = sweep->plan;
  cut_groups(cut, planned.plan.parts);
  const EvaluateGroup evaluate = make_evaluator(stages, sweep->experiment, sweep->axes, sweep->statistics);
  measurer.measure = [sweep, cut, evaluate](const PlannedShard& part, std::string& rows, const auto& report) {
    std::size_t cells = 0;
    const double all =
        static_cast<double>(cut.cells) * static_cast<double>(part.groups) / static_cast<double>(count_groups(cut));
    for_each_joined_group(cut, part.first_group, part.groups, [&](const CellGroup& group) {
      throw_if_interrupted("the shard starts over when it is run again");
      std::string of_group;
      evaluate_whole(group, evaluate, [&](std::size_t place, std::span<const Value> measured) {
        std::string row;
        append_values(row, measured);
        if (of_group.empty()) of_group.resize(group.size() * row.size());
        std::memcpy(of_group.data() + place * row.size(), row.data(), row.size());
      });
      rows += of_group;
      cells += group.size();
      report(cells, std::min(1.0, static_cast<double>(cells) / all));
    });
  };
  return measurer;
}

}  // namespace umbrameter
