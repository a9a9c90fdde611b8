// An output folder that belongs to one run: locked while the run goes, recorded so that a later run can replace it, and
// removed when a failed run leaves it empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/run_record.h"

namespace umbrameter {

/// What a run is, and what it may write besides figures and a results store.
struct RunPlan {
  std::string command;             ///< "sweep"
  std::string experiment;          ///< text of its experiment.toml
  std::vector<std::string> files;  ///< "experiment.toml", "summary.json"
  bool resumes_store = false;      ///< a results store in the folder may be continued; the store decides which
};

/// Files are announced before they are written, so that the record is never behind the folder. Until begin() the
/// folder still belongs to the earlier run, and a run that fails leaves it as it was.
class RunFolder {
 public:
  /// Makes the folder where it is missing, and locks it until this object or the process ends. Throws Error (usage)
  /// when it cannot be written, when another run is writing to it, or, without `force`, when it holds another run's
  /// results or a file of the plan that no run recorded. An unfinished run of the same command with the same experiment
  /// may be repeated.
  RunFolder(std::filesystem::path folder, RunPlan plan, bool force);
  /// Of a run that did not get to finish(): removes what it announced and nobody needs, and folders that it made, where
  /// they are empty.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  /// Records files that are written next. Throws Error (partial) when the record cannot be written.
  void announce(const std::vector<std::string>& files);
  /// Throws Error (usage) when one of these files is there, no run recorded it, and `force` was not given.
  void require_free(const std::vector<std::string>& files) const;

  /// The folder is this run's from here on: removes what the earlier run wrote, except what this one announced, and
  /// announces the plan's files. The second call does nothing.
  void begin();
  /// Keeps in the record the files that are there. A run that is not complete may be repeated without `force`.
  void finish(bool complete);

 private:
  // An open and locked folder; the system lets go of the lock when the process ends, however that happens.
  struct Lock {
    int file = -1;
    ~Lock();
  };
  // Folders that this run made, outermost first. Those that are empty at the end are removed.
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
  Lock lock_;  // outlives the removal of folders
  MadeFolders made_;
  std::optional<RunRecord> earlier_;    // of the run that the folder holds; nothing once its files are removed
  RunRecord record_;                    // of this run
  std::vector<std::string> new_files_;  // announced before begin(), and not there then
  bool had_record_ = false;
  bool is_begun_ = false;
  bool is_finished_ = false;
};

}  // namespace umbrameter
