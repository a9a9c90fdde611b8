// The evaluations of a tuning on disk: one line each, written when it is done. A rerun finds them and goes on; because
// the search is deterministic, it then ends as if it had not been interrupted.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/table.h"
#include "results/tune_results.h"

namespace umbrameter {

/// Name of the file in the output folder; removed when the tuning is complete.
inline constexpr const char* tune_journal_name = "tuning.partial.jsonl";

/// What one evaluation found.
struct TuneRecord {
  std::vector<Value> point;       ///< a value for each axis
  std::vector<CaseValues> cases;  ///< for each case the goal's columns
};

/// The point with its score.
TunePoint scored(const TuneRecord& record, const TuneGoal& goal);

class TuneJournal {
 public:
  /// Reads the evaluations of an earlier run and continues its file, or begins one. Throws Error (usage) if the file is
  /// of another tuning, with the first setting that differs.
  TuneJournal(const std::filesystem::path& path, const std::vector<std::pair<std::string, std::string>>& settings);

  std::size_t count() const { return records_.size(); }
  const TuneRecord* find(const std::string& key) const;
  /// Throws Error (partial) if it cannot be written.
  const TuneRecord& add(const std::string& key, TuneRecord record);

 private:
  std::filesystem::path path_;
  std::map<std::string, TuneRecord> records_;
  std::ofstream file_;
};

}  // namespace umbrameter
