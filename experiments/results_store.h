// The rows of a sweep in a file that survives interruption: DIR/results.partial.sqlite while cells are missing, one
// transaction a group, and DIR/results.sqlite once all are there, packed and in the order of cells. The only door to
// the database: others ask by the functions below.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/table.h"

namespace umbrameter {

/// How a column is stored, in the order of Value's alternatives: truths as 0 and 1, numbers that are none as NULL.
enum class ValueKind : int { truth, integer, real, text };

struct StoredColumn {
  Column column;
  ValueKind kind = ValueKind::real;
};

/// What a store is about. Two stores are the same, and one can continue the other, when all but the experiment's text
/// is equal: that says the same once more, for people.
struct StoreDescription {
  std::string experiment;                                     ///< the complete experiment file
  std::vector<std::pair<std::string, std::string>> settings;  ///< name and value of all that the rows depend on
  std::vector<std::pair<std::string, std::string>> axes;      ///< full parameter name, axis text
  std::vector<StoredColumn> columns;                          ///< those of the axes, then the measured ones
  std::size_t cells = 0;                                      ///< when complete
};

/// Takes the values of all columns at a cell.
using CellSink = std::function<void(std::size_t cell, std::span<const Value> values)>;
/// Takes the values of the columns asked for. The values live until the next row.
using StoredRowSink = std::function<void(std::span<const Value> values)>;

class ResultsStore {
 public:
  /// Every name that a store's files may have in its folder, the database's own companions included.
  static std::vector<std::string> file_names();

  /// Continues what the folder holds of that description, or begins; `anew` removes what is there. Throws Error:
  /// usage when it holds another sweep, with the first difference, or another process works on it; unreadable_input
  /// when it is damaged; partial when it cannot be written.
  static ResultsStore open(const std::filesystem::path& folder, const StoreDescription& description, bool anew = false);

  /// Opens a complete store for reading. Throws as open() does.
  static ResultsStore load(const std::filesystem::path& folder);

  ~ResultsStore();
  ResultsStore(ResultsStore&&) noexcept;
  ResultsStore& operator=(ResultsStore&&) noexcept;

  const StoreDescription& description() const;
  const std::filesystem::path& path() const;
  /// Whether it is the finished file; nothing can then be added.
  bool complete() const;
  /// Number of cells that are there.
  std::size_t count() const;
  /// Whether the group that begins with that cell is there.
  bool has_group(std::size_t first_cell) const;

  /// All cells that fill() gives its sink in one transaction: none of them when it throws. A group that is there
  /// already is a std::logic_error. Throws Error (partial) when the disk is full; what was there before stays.
  void append(std::size_t first_cell, const std::function<void(const CellSink&)>& fill);

  /// Packs the rows, in the order of cells, into the finished file, whose bytes depend on nothing but description and
  /// rows. A cell that was given twice is a std::logic_error.
  void finish();

  /// All rows in the order of cells, of these columns; of all where none is named.
  void read(const std::vector<std::string>& columns, const StoredRowSink& sink) const;
  /// Some rows in the order asked for; cells that are missing are left out.
  Table rows(std::span<const std::size_t> cells, const std::vector<std::string>& columns) const;
  /// For each combination of values of the columns `per`, the row with the least `column`, the first of equals;
  /// ordered by that combination, at most `limit` rows. Without `per` the least row of all.
  Table least(const std::string& column, const std::vector<std::string>& per, std::size_t limit) const;

 private:
  struct State;
  explicit ResultsStore(std::unique_ptr<State> state);
  void pack(const std::filesystem::path& path) const;
  std::unique_ptr<State> state_;
};

}  // namespace umbrameter
