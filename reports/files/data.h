// Rows and parameters as CSV, JSON and TOML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>

#include "core/parameters.h"
#include "core/table.h"

namespace umbrameter {

/// RFC 4180, header first, numbers in the shortest form that reads back the same.
std::string to_csv(const Table& table);

/// Gives each row to its argument, which takes them as they come.
using RowSource = std::function<void(const std::function<void(std::span<const Value>)>&)>;

/// The same into a file, whole or absent, without holding the rows. Throws what the source throws, and Error (partial).
void write_csv(const std::filesystem::path& path, std::span<const Column> columns, const RowSource& rows);

/// The parameters as an experiment file: one table a group, each value with unit and meaning as a comment.
/// `scene` is written as the key `source` of the table [scene], or as a top-level key where no parameter is in that
/// group; both are read.
std::string to_toml(const std::string& scene, const Parameters& parameters,
                    const std::vector<std::pair<std::string, std::string>>& axes);

/// What an experiment file says.
struct ExperimentFile {
  std::string scene;                                      ///< empty when the file names none
  std::vector<std::pair<std::string, Value>> values;      ///< full parameter name, value
  std::vector<std::pair<std::string, std::string>> axes;  ///< [vary]: full parameter name, axis text
  std::map<std::string, std::uint32_t> lines;             ///< of each value, and of each axis as "vary.<name>"
};
/// Throws Error (usage) with file and line when it is not TOML, Error (unreadable_input) when it is larger than
/// 1 MiB or read_input() refuses it.
ExperimentFile read_experiment(const std::filesystem::path& path);

}  // namespace umbrameter
