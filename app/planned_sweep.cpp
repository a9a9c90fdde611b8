#include "app/planned_sweep.h"

#include <algorithm>

#include "store/experiment_file.h"

namespace umbrameter {

namespace fs = std::filesystem;

PlannedSweepFolder open_plan(const CommandLine& line) {
  PlannedSweepFolder planned{line.plan.folder, read_plan(line.plan.folder), line, {}};
  planned.line.command = "sweep";
  planned.line.presets = planned.plan.presets;
  const fs::path file = planned.folder / "experiment.toml";
  if (const std::string engine = engine_in(file); !engine.empty()) {
    planned.line.engine = std::make_shared<Engine>(engine);
    use_engine(planned.line.engine->parameters());
  }
  planned.given = load_experiment(file, Experiment{});
  if (!planned.plan.scene_file.empty()) {
    planned.given.scene = fs::absolute(planned.folder / planned.plan.scene_file).lexically_normal().string();
  }
  return planned;
}

StoreDescription load_planned(const PlannedSweepFolder& planned, SweepRun& sweep, const Console& console) {
  sweep.load(console);
  StoreDescription description = sweep.description();
  require_planned(planned.folder, planned.plan, portable_identity(description));
  return description;
}

std::vector<std::pair<std::string, std::string>> portable_identity(const StoreDescription& description) {
  std::vector<std::pair<std::string, std::string>> identity = description.settings;
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

std::string shell_word(const fs::path& file) {
  const std::string path = file.string();
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./+:,@%").find(c) != std::string_view::npos;
  };
  if (!path.empty() && std::all_of(path.begin(), path.end(), is_plain)) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_of(const fs::path& folder, const std::string& shards) {
  return "umbrameter run " + shell_word(folder) + " --shard " + shards;
}

}  // namespace umbrameter
