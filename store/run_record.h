// The record of a run: a file in the output folder that lists the files which the run wrote, so that a later run can
// remove exactly these. store/run_folder.h decides which run may write to a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace umbrameter {

/// Name of the record in each output folder.
inline constexpr const char* run_record_name = ".umbrameter-run.json";

struct RunRecord {
  std::string command;             ///< "sweep"
  bool complete = false;           ///< the run wrote all of its files
  std::vector<std::string> files;  ///< relative to the folder: "summary.json", "figures/truth_ao.svg"
};

/// Whether a record may list this file: it is in the folder or its subfolder "figures", and is not the record.
bool is_recordable(const std::string& file);

/// Reads the folder's record. Earlier versions wrote no record; for their folders it is derived from the files:
/// summary.json lists files, index.html figures, and a results store means a sweep. Empty if no run wrote there.
/// Throws Error (unreadable_input) if the record is damaged or from a later version.
std::optional<RunRecord> read_run_record(const std::filesystem::path& folder);

/// Replaces the folder's record. Throws Error (partial) if it cannot be written.
void write_run_record(const std::filesystem::path& folder, const RunRecord& record);

/// Adds the files that are not in the list yet.
void add_files(std::vector<std::string>& list, const std::vector<std::string>& files);

/// Removes those of these files that exist, and the subfolder "figures" if it is then empty. Throws Error (usage)
/// naming a file that cannot be removed.
void remove_files(const std::filesystem::path& folder, const std::vector<std::string>& files);

}  // namespace umbrameter
