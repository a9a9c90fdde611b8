// RunResults as a file: DIR/run.bin, whose layers stand in DIR/images.exr.
#pragma once

#include <filesystem>
#include <optional>

#include "results/run_results.h"

namespace umbrameter {

inline constexpr const char* run_value_file = "run.bin";

/// Not const: the layers are set aside while the rest is written. Throws Error (partial) if the file cannot be written.
void write_run_value(const std::filesystem::path& folder, RunResults& results);

/// Nothing if the folder has no such file, or that of another version of umbrameter. Throws Error (unreadable_input) if
/// it is damaged, or if its layers are.
std::optional<RunResults> read_run_value(const std::filesystem::path& folder, bool with_layers = true);

}  // namespace umbrameter
