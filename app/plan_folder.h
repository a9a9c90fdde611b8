// The folder of a new plan: emptied, and filled with the scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/settings/shard_cuts.h"
#include "store/shard_plan.h"

namespace umbrameter {

/// Throws Error (usage) unless the folder is missing or empty, or holds a plan and `force` is given.
void require_free(const std::filesystem::path& folder, bool force);

/// Makes the folder, and removes an earlier plan with its results.
void prepare_plan_folder(const std::filesystem::path& folder);

/// What a plan calls a scene: the path of its copy in `subfolder`, or with `by_reference` of the file itself, relative
/// to the plan, which is added to plan.scene_files; the name of a built-in scene as it is. Throws Error (partial) if it
/// cannot be copied.
std::string store_scene(const std::filesystem::path& folder, ShardPlan& plan, const std::string& scene,
                        const std::filesystem::path& subfolder, bool by_reference);

/// The shards of `groups` groups, of which the first one is `first` in the plan.
std::vector<PlannedShard> planned_shards(const ShardCuts& cuts, std::size_t first, std::size_t groups);

}  // namespace umbrameter
