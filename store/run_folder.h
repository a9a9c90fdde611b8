// An output folder that belongs to one run. It is locked during the run, has a record so that a later run can replace
// its files, and is removed if a failed run leaves it empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "store/run_record.h"

namespace umbrameter {

/// Describes a run and lists the files that it may write besides figures and a results store.
struct RunPlan {
  std::string command;             ///< "sweep"
  std::string experiment;          ///< text of its experiment.toml
  std::vector<std::string> files;  ///< "experiment.toml", "summary.json"
  bool resumes_store = false;      ///< may resume a results store in the folder; the store checks whether it matches
};

/// Files are announced before they are written, so that the record always lists every file. Until begin() the folder
/// still belongs to the earlier run, and a run that fails leaves it unchanged.
class RunFolder {
 public:
  /// Creates the folder if it is missing, and locks it until this object or the process ends. Throws Error (usage) if
  /// it cannot be written, if another run is writing to it, or, without `force`, if it holds another run's results or a
  /// file of the plan that no run recorded. An unfinished run of the same command with the same experiment may be
  /// repeated.
  RunFolder(std::filesystem::path folder, RunPlan plan, bool force);
  /// Cleans up if finish() was not called. Before begin(): removes this run's new files and restores the earlier
  /// record. After begin(): removes the record if none of its files exists. In both cases removes the empty folders
  /// that this run created.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  /// Records files that will be written next. Throws Error (partial) if the record cannot be written.
  void announce(const std::vector<std::string>& files);
  /// Throws Error (usage) if one of these files exists, no run recorded it, and `force` was not given.
  void require_free(const std::vector<std::string>& files) const;

  /// Makes this run the owner of the folder: removes the earlier run's files, except those that this run announced, and
  /// announces the plan's files. A second call does nothing.
  void begin();
  /// Reduces the record to the files that exist. A run that is not complete may be repeated without `force`.
  void finish(bool complete);

 private:
  // An open and locked folder. The system releases the lock when the process ends, even if it is killed.
  struct Lock {
    int file = -1;
    ~Lock();
  };
  // Folders that this run created, outermost first. The destructor removes the empty ones.
  struct MadeFolders {
    std::vector<std::filesystem::path> paths;
    ~MadeFolders();
  };
  void lock();
  void require_own() const;
  void write_record() const;
  void take_back() noexcept;

  std::filesystem::path folder_;
  RunPlan plan_;
  bool force_;
  Lock lock_;  // before made_: released after the folders are removed
  MadeFolders made_;
  std::optional<RunRecord> earlier_;    // record of the earlier run; empty when its files have been removed
  RunRecord record_;                    // record of this run
  std::vector<std::string> new_files_;  // announced before begin() and did not exist then
  bool had_record_ = false;
  bool is_begun_ = false;
  bool is_finished_ = false;
};

}  // namespace umbrameter
