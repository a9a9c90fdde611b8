// Reads experiment.toml, the settings of a run.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/settings/experiment.h"

namespace umbrameter {

/// The experiment that a file describes; parameters that it does not name stay as they are. Throws Error, with file
/// and line, for what it names wrong, and as read_experiment() does.
Experiment load_experiment(const std::filesystem::path& path, Experiment experiment = {});

/// engine.adapter of a file; empty if it names none. Throws as read_experiment() does.
std::string engine_in(const std::filesystem::path& path);

}  // namespace umbrameter
