// What one run writes into its output folder, kept in the folder itself, so that a later run can remove exactly that.
// Of names and folders only: who may write when is decided in experiments/run_folder.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace umbrameter {

/// In each output folder.
inline constexpr const char* run_record_name = ".umbrameter-run.json";

struct RunRecord {
  std::string command;             ///< "sweep"
  bool complete = false;           ///< everything that the run wanted to write is there
  std::vector<std::string> files;  ///< relative to the folder: "summary.json", "figures/truth_ao.svg"
};

/// The bytes of a file; nothing when it is no regular file or cannot be read.
std::optional<std::string> text_of_file(const std::filesystem::path& path);

/// Whether a record may name this file: one in the folder or in its folder "figures", and not the record.
bool is_recordable(const std::string& file);

/// What the folder's record says. Without a record, what the files of versions that kept none say: summary.json lists
/// its files and index.html its figures, and a results store belongs to a sweep. Nothing when no run wrote there.
/// Throws Error (unreadable_input) when the record is damaged or from a later version.
std::optional<RunRecord> read_run_record(const std::filesystem::path& folder);

/// Replaces the folder's record. Throws Error (partial).
void write_run_record(const std::filesystem::path& folder, const RunRecord& record);

/// Adds the files that are not in the list yet.
void add_files(std::vector<std::string>& list, const std::vector<std::string>& files);

/// Removes these files where they are there, and the folder "figures" when that leaves it empty. Throws Error (usage)
/// naming a file that cannot be removed.
void remove_files(const std::filesystem::path& folder, const std::vector<std::string>& files);

}  // namespace umbrameter
