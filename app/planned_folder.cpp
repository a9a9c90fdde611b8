#include "app/planned_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/print_json.h"
#include "app/tune_job.h"
#include "core/standard_streams.h"
#include "reports/files/markup.h"
#include "store/experiment_file.h"

namespace umbrameter {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t default_array_size = 1001;  // of Slurm: the indices of an array are less

}  // namespace

PlannedFolder open_plan(const CommandLine& line) {
  PlannedFolder planned{line.plan.folder, read_plan(line.plan.folder), line, {}};
  planned.line.command = planned.plan.tuning ? "tune" : "sweep";
  planned.line.presets = planned.plan.presets;
  const fs::path file = planned.folder / "experiment.toml";
  if (const std::string engine = engine_in(file); !engine.empty()) {
    planned.line.engine = std::make_shared<Engine>(engine);
    use_engine(planned.line.engine->parameters());
  }
  planned.given = load_experiment(file, Experiment{});
  const auto resolve = [&](std::string& scene) {
    const std::vector<std::string>& files = planned.plan.scene_files;
    if (std::ranges::find(files, scene) == files.end()) return;
    scene = fs::absolute(planned.folder / scene).lexically_normal().string();
  };
  resolve(planned.given.scene);
  if (planned.plan.tuning) {
    planned.line.tune = tune_options(planned.plan.tuning->options);
    for (std::string& scene : planned.line.tune.scenes) resolve(scene);
    for (std::string& assignment : planned.line.tune.held_out) {
      if (!assignment.starts_with(held_out_scene)) continue;
      std::string scene = assignment.substr(held_out_scene.size());
      resolve(scene);
      assignment = std::string(held_out_scene) + scene;
    }
  }
  return planned;
}

void show_shards(const Console& console, const PlannedFolder& planned, const std::vector<std::size_t>& shards,
                 const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) write_to(stderr, "umbrameter: " + problem + "\n");
  print_json(console, {{"missing", shards}, {"problems", problems}});
  const std::string list = shards_text(shards);
  std::string numbers;
  for (const std::size_t shard : shards) numbers += " " + std::to_string(shard);
  if (shards.back() < default_array_size) {
    print_line(console, "Slurm:    --array=" + list);
  } else {
    print_line(console, fmt::format("Slurm:    integrations/slurm/umbrameter-slurm; task {} is beyond the default "
                                    "MaxArraySize of {}",
                                    shards.back(), default_array_size));
  }
  print_line(console, "numbers: " + numbers);
  print_line(console, "command:  " + command_of(planned.folder, list));
  print_line(console, "commands: umbrameter status " + shell_word(planned.folder) + " --commands");
}

Error missing_shards(const PlannedFolder& planned, const CollectedShards& collected, const char* remedy) {
  return {ExitCode::partial, planned.folder.string(),
          fmt::format("{} of {} shards are missing or broken", collected.missing.size(), planned.plan.shards.size()),
          remedy};
}

std::string shell_word(const fs::path& file) {
  const std::string path = file.string();
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./+:,@%").find(c) != std::string_view::npos;
  };
  if (!path.empty() && std::ranges::all_of(path, is_plain)) return path;
  return "'" + replace_all(path, "'", "'\\''") + "'";
}

std::string command_of(const fs::path& folder, const std::string& shards) {
  return "umbrameter run " + shell_word(folder) + " --shard " + shards;
}

}  // namespace umbrameter
