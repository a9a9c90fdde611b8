#include "app/plan_folder.h"

#include <algorithm>

#include "core/error.h"
#include "reports/files/output.h"
#include "scenes/gltf.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Also what is left of a plan when an engine has removed plan.json to have it made again.
bool holds_plan(const fs::path& folder) {
  return is_there(folder / "plan.json") || (is_there(folder / "experiment.toml") && is_there(folder / "shards"));
}

// Copies the file and what it refers to; returns its path relative to the plan.
fs::path copy_scene(const fs::path& scene, const fs::path& folder, const fs::path& subfolder) {
  std::vector<fs::path> files = files_of_gltf(scene);
  files.push_back(scene.filename());
  for (const fs::path& file : files) {
    const fs::path to = folder / subfolder / file;
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (error) throw_write_error(to.parent_path(), error.value());
    copy_whole(scene.parent_path() / file, to);
  }
  return subfolder / scene.filename();
}

}  // namespace

void require_free(const fs::path& folder, bool force) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  const bool is_plan = holds_plan(folder);
  if (is_plan && force) return;
  throw Error(ExitCode::usage, folder.string(), is_plan ? "it holds a plan" : "the folder is not empty",
              is_plan ? "choose another one with -o, or replace the plan and its results with --force"
                      : "choose another one with -o");
}

void prepare_plan_folder(const fs::path& folder) {
  prepare_output_folder(folder);
  if (!holds_plan(folder)) return;
  for (const char* name : {"plan.json", "experiment.toml", "scene", "shards"}) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw_write_error(folder / name, error.value());
  }
}

std::string store_scene(const fs::path& folder, ShardPlan& plan, const std::string& scene, const fs::path& subfolder,
                        bool by_reference) {
  if (!fs::is_regular_file(scene)) return scene;
  const fs::path path = fs::absolute(scene).lexically_normal();
  const std::string stored = by_reference ? path.lexically_relative(fs::absolute(folder).lexically_normal()).string()
                                          : copy_scene(path, folder, subfolder).string();
  plan.scene_files.push_back(stored);
  return stored;
}

std::vector<PlannedShard> planned_shards(const ShardCuts& cuts, std::size_t first, std::size_t groups) {
  std::vector<PlannedShard> shards;
  for (std::size_t i = 0; i < cuts.first.size(); ++i) {
    const std::size_t end = i + 1 < cuts.first.size() ? cuts.first[i + 1] : groups;
    shards.push_back({first + cuts.first[i], end - cuts.first[i], cuts.seconds[i]});
  }
  return shards;
}

}  // namespace umbrameter
