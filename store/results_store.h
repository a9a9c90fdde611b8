// Stores the rows of a sweep in a file that survives interruption: DIR/results.partial.sqlite while cells are missing,
// with one transaction per group; DIR/results.sqlite when the sweep is complete, packed and in the order of cells.
// Other modules access the database only through this header.
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

/// How a column is stored, in the order of Value's alternatives. Truth values are stored as 0 and 1, NaN as NULL.
enum class ValueKind : int { truth, integer, real, text };

struct StoredColumn {
  Column column;
  ValueKind kind = ValueKind::real;
};

/// Identifies the sweep of a store. Two stores are the same, so that a sweep can resume, if all members except
/// `experiment` and `maker` are equal. `experiment` repeats the same information for people.
struct StoreDescription {
  std::string experiment;                                     ///< the complete experiment file
  std::vector<std::pair<std::string, std::string>> settings;  ///< name and value of all that rows depend on
  std::vector<std::pair<std::string, std::string>> axes;      ///< full parameter name, axis text
  std::vector<StoredColumn> columns;                          ///< those of the axes, then the measured ones
  std::size_t cells = 0;                                      ///< number of cells of the complete sweep
  std::string maker{};  ///< who measures now: program, processor and driver; not part of what the sweep is
};

/// Receives the values of all columns of a cell.
using CellSink = std::function<void(std::size_t cell, std::span<const Value> values)>;
/// Passes all cells to its argument, in the order of cells.
using RowsOfCells = std::function<void(const CellSink&)>;
/// Receives the values of the selected columns. The values are valid until the next row.
using StoredRowSink = std::function<void(std::span<const Value> values)>;

class ResultsStore {
 public:
  /// Every name that a store's files may have in its folder, including SQLite's journal files.
  static std::vector<std::string> file_names();

  /// Resumes the folder's store if it has the same description, or creates one. Groups of an unfinished store whose
  /// rows do not match their checksum are removed, so that they are measured again. With `overwrite`, removes an
  /// existing store first. Throws Error: usage if the folder holds another sweep, with the first difference, or if
  /// another process is writing to it; unreadable_input if the store is damaged; partial if it cannot be written.
  static ResultsStore open(const std::filesystem::path& folder, const StoreDescription& description,
                           bool overwrite = false);

  /// Opens a complete store for reading and checks all of its rows. Throws as open() does.
  static ResultsStore load(const std::filesystem::path& folder);

  /// Writes the finished store of rows that are at hand, in the order of cells, and opens it without
  /// reading it back. Its bytes are those of a store that grew. Throws as finish() does, and what `rows` throws.
  static ResultsStore write(const std::filesystem::path& folder, const StoreDescription& description,
                            const std::vector<std::string>& makers, const RowsOfCells& rows);

  ~ResultsStore();
  ResultsStore(ResultsStore&&) noexcept;
  ResultsStore& operator=(ResultsStore&&) noexcept;

  const StoreDescription& description() const;
  const std::filesystem::path& path() const;
  /// Whether this is the finished file, to which nothing can be added.
  bool complete() const;
  /// Number of stored cells.
  std::size_t count() const;
  /// Number of cells that open() removed because they did not match their checksum.
  std::size_t discarded() const;
  /// Everyone who measured cells, the first one first.
  std::vector<std::string> makers() const;
  /// Whether the group that begins with this cell is stored.
  bool has_group(std::size_t first_cell) const;

  /// Stores all cells that fill() passes to its sink in one transaction, or none if fill() throws. Throws
  /// std::logic_error if the group is already stored, Error (partial) if the disk is full; earlier groups stay.
  void append(std::size_t first_cell, const std::function<void(const CellSink&)>& fill);

  /// Packs the rows, in the order of cells, into the finished file. Its bytes depend only on description and rows.
  /// Throws std::logic_error if a cell was stored twice.
  void finish();

  /// Passes these columns of all rows to the sink, in the order of cells; all columns if `columns` is empty.
  void read(const std::vector<std::string>& columns, const StoredRowSink& sink) const;
  /// The rows of these cells, in this order. Missing cells are omitted.
  Table rows(std::span<const std::size_t> cells, const std::vector<std::string>& columns) const;
  /// For each combination of values of the columns `per`, the row with the smallest `column` (the first one of
  /// several), ordered by combination, at most `limit` rows. If `per` is empty, the row with the smallest `column`.
  Table least(const std::string& column, const std::vector<std::string>& per, std::size_t limit) const;

 private:
  struct State;
  explicit ResultsStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace umbrameter
