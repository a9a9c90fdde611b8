// Budget files: the bounds that statistics of a run must keep. store/gate.h checks them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/condition.h"

namespace umbrameter {

/// One bound. An empty scene, kind or light means all of them.
struct BudgetEntry {
  std::string statistic;      ///< as described: "acne"; any image metric
  bool is_magnitude = false;  ///< |statistic|
  Bound bound;
  std::string scene;  ///< as summary.json names it
  std::string kind;   ///< "shadow", "ao" or "image"
  std::string light;  ///< name or index
  std::string place;  ///< file and line, for messages
};

/// Reads [[budget]] tables with the keys statistic, bound, scene, kind and light. Throws Error: usage with file and
/// line for anything else, for a bound that is no number, and for a file without a budget; unreadable_input where the
/// file cannot be read.
std::vector<BudgetEntry> read_budget(const std::filesystem::path& path);

/// Replaces the file, whole or not at all.
void write_budget(const std::filesystem::path& path, const std::vector<BudgetEntry>& entries);

}  // namespace umbrameter
