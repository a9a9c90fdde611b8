// A finished run, read back from its folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/ao_stages.h"
#include "reports/files/exr.h"
#include "store/gate.h"

namespace umbrameter {

struct StoredRun {
  std::string name;  ///< of its folder, in tables
  std::string scene;
  std::string command;  ///< "compare" or "sweep"
  std::vector<MeasuredStatistic> statistics;
  std::vector<std::pair<std::string, std::string>> parameters;   ///< full name, value as in summary.json
  std::vector<std::pair<std::string, std::string>> environment;  ///< "OpenGL", "Mesa llvmpipe"
  std::map<std::string, std::string> layers;     ///< of each light, by its name: part of its layers' names
  LayeredImage images;                           ///< without channels if the run has no images.exr
  std::optional<AoStageStatistics> ao_stages{};  ///< if the run measured the stages of ambient occlusion
};

/// Throws Error (unreadable_input) if the folder holds no finished run that compared something, or a damaged one.
StoredRun read_stored_run(const std::filesystem::path& folder);

}  // namespace umbrameter
