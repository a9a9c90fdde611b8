#include "store/results_store.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/lists.h"
#include "reports/files/output.h"
#include "store/results_checksum.h"
#include "store/results_schema.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* finished_name = "results.sqlite";
constexpr const char* partial_name = "results.partial.sqlite";

// So that a message about damage names few cells; the groups of evaluation are not consecutive cells.
constexpr std::int64_t cells_of_finished_group = 1024;

// "a", "b".
std::string list_of(const std::vector<std::string>& names) {
  return joined(names, ", ", [](const std::string& name) { return identifier(name); });
}

// Of the database and of the files that it keeps beside itself.
constexpr std::array<const char*, 4> store_parts = {"", "-wal", "-shm", "-journal"};

void remove_store(const fs::path& path) {
  for (const char* part : store_parts) {
    std::error_code error;
    fs::remove(path.string() + part, error);
    if (error) throw Error(ExitCode::usage, "cannot remove " + path.string() + part, error.message(), store_remedy);
  }
}

// A lock for as long as the database is open: a second process is refused, and no file for shared memory is made.
SQLite::Database open_exclusively(const fs::path& path) {
  SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec("PRAGMA locking_mode = EXCLUSIVE");
  is_empty_store(database, path);
  // A transaction is lost with the power, never with the process; the rest stays whole in both cases.
  database.exec("PRAGMA journal_mode = WAL");
  database.exec("PRAGMA synchronous = NORMAL");
  // For sorting; KiB.
  database.exec("PRAGMA cache_size = -16384");
  database.exec("BEGIN EXCLUSIVE; COMMIT");
  return database;
}

SQLite::Database open_for_reading(const fs::path& path) {
  return SQLite::Database(path.string(), SQLite::OPEN_READONLY);
}

// What is damaged may be replaced, what another process writes may not.
void require_idle(const fs::path& path) {
  if (!is_there(path)) return;
  try {
    open_exclusively(path);
  } catch (const Error&) {
    return;
  } catch (const SQLite::Exception& problem) {
    if ((problem.getErrorCode() & 0xff) == SQLITE_BUSY) throw_store_error(path, problem);
  }
}

}  // namespace

struct ResultsStore::State {
  fs::path folder;
  fs::path path;
  bool complete;
  std::optional<SQLite::Database> database;
  StoreDescription description;
  std::size_t discarded = 0;
  // After the database: they go before it does.
  std::optional<SQLite::Statement> insert{};
  std::optional<SQLite::Statement> find{};

  std::vector<std::string> names() const {
    return mapped(description.columns, [](const StoredColumn& stored) { return stored.column.name; });
  }

  const StoredColumn& column(const std::string& name) const {
    for (const StoredColumn& stored : description.columns) {
      if (stored.column.name == name) return stored;
    }
    throw std::out_of_range("no column " + name);
  }

  std::vector<ValueKind> kinds(const std::vector<std::string>& columns) const {
    return mapped(columns, [&](const std::string& name) { return column(name).kind; });
  }

  Table table(const std::vector<std::string>& columns) const {
    Table table;
    for (const std::string& name : columns) table.columns.push_back(column(name).column);
    return table;
  }
};

namespace {

std::vector<Value> row_of(SQLite::Statement& statement, const std::vector<ValueKind>& kinds) {
  std::vector<Value> row;
  row.reserve(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    row.push_back(value_of(statement.getColumn(static_cast<int>(i)), kinds[i]));
  }
  return row;
}

void pack(const fs::path& path, const StoreDescription& description, const std::vector<std::string>& makers,
          const RowsOfCells& rows) {
  SQLite::Database packed(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  // The file is new, and flushed before it gets its name.
  packed.exec("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");
  SQLite::Transaction transaction(packed);
  create_tables(packed, description, StoreForm::finished);
  for (const std::string& maker : makers) add_maker(packed, maker);
  SQLite::Statement insert = make_insert(packed, description);
  std::optional<GroupChecksum> checksum;
  StoredGroup group;
  const auto close_group = [&] {
    if (!checksum) return;
    group.checksum = checksum->text();
    insert_group(packed, group);
    checksum.reset();
  };
  rows([&](std::size_t cell, std::span<const Value> values) {
    throw_if_interrupted();
    insert_row(packed, insert, cell, values);
    if (group.cells == cells_of_finished_group) close_group();
    if (!checksum) {
      checksum.emplace(description.columns, cell);
      const auto number = static_cast<std::int64_t>(cell);
      group = {number, 0, number};  // the cell's number is its rowid
    }
    checksum->add(cell, values);
    ++group.cells;
  });
  close_group();
  transaction.commit();
}

void write_finished(const fs::path& folder, const StoreDescription& description, const std::vector<std::string>& makers,
                    const RowsOfCells& rows) {
  const fs::path path = folder / finished_name;
  write_whole(path,
              [&](const fs::path& temporary) { guarded(path, [&] { pack(temporary, description, makers, rows); }); });
}

}  // namespace

ResultsStore::ResultsStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
ResultsStore::~ResultsStore() = default;
ResultsStore::ResultsStore(ResultsStore&&) noexcept = default;
ResultsStore& ResultsStore::operator=(ResultsStore&&) noexcept = default;

const StoreDescription& ResultsStore::description() const { return state_->description; }
const fs::path& ResultsStore::path() const { return state_->path; }
bool ResultsStore::complete() const { return state_->complete; }
std::size_t ResultsStore::discarded() const { return state_->discarded; }

std::vector<std::string> ResultsStore::file_names() {
  std::vector<std::string> names;
  for (const char* name : {finished_name, partial_name}) {
    for (const char* part : store_parts) names.push_back(std::string(name) + part);
  }
  return names;
}

ResultsStore ResultsStore::load(const fs::path& folder) {
  const fs::path path = folder / finished_name;
  return guarded(path, [&] {
    auto state = std::make_unique<State>(State{folder, path, true, open_for_reading(path), {}});
    SQLite::Database& database = *state->database;
    state->description = read_description(database, path);
    ResultsStore store(std::move(state));
    const auto cells = static_cast<std::int64_t>(store.description().cells);
    for (const char* count : {"SELECT COUNT(*) FROM cells", "SELECT SUM(cells) FROM groups"}) {
      if (database.execAndGet(count).getInt64() != cells) throw_damaged(path, "cells are missing");
    }
    const std::vector<StoredGroup> damaged = damaged_groups(database, store.description());
    if (!damaged.empty()) {
      throw_damaged(path, fmt::format("cells {} to {} do not match their checksum", damaged.front().first_cell,
                                      damaged.front().first_cell + damaged.front().cells - 1));
    }
    return store;
  });
}

ResultsStore ResultsStore::open(const fs::path& folder, const StoreDescription& description, bool overwrite) {
  const fs::path finished = folder / finished_name;
  const fs::path partial = folder / partial_name;
  if (overwrite) {
    require_idle(partial);
    remove_store(finished);
    remove_store(partial);
  }
  if (is_there(finished)) {
    ResultsStore store = load(folder);
    require_same(finished, store.description(), description);
    remove_store(partial);
    return store;
  }
  return guarded(partial, [&] {
    auto state = std::make_unique<State>(State{folder, partial, false, open_exclusively(partial), description});
    SQLite::Database& database = *state->database;
    bool is_empty = is_empty_store(database, partial);
    SQLite::Transaction transaction(database);
    if (!is_empty) {
      const StoreDescription there = read_description(database, partial);
      // Another sweep that was begun and holds no group is in nobody's way.
      is_empty = !first_difference(there, description).empty() &&
                 database.execAndGet("SELECT EXISTS (SELECT 1 FROM groups)").getInt() == 0;
      if (is_empty) drop_tables(database);
      if (!is_empty) {
        require_same(partial, there, description);
        const std::vector<StoredGroup> damaged = damaged_groups(database, description);
        for (const StoredGroup& group : damaged) state->discarded += static_cast<std::size_t>(group.cells);
        if (!damaged.empty()) remove_groups(database, damaged);
      }
    }
    if (is_empty) create_tables(database, description, StoreForm::growing);
    add_maker(database, description.maker);
    transaction.commit();
    return ResultsStore(std::move(state));
  });
}

std::size_t ResultsStore::count() const {
  const char* query = state_->complete ? "SELECT COUNT(*) FROM cells" : "SELECT COALESCE(SUM(cells), 0) FROM groups";
  return guarded(state_->path,
                 [&] { return static_cast<std::size_t>(state_->database->execAndGet(query).getInt64()); });
}

std::vector<std::string> ResultsStore::makers() const {
  return guarded(state_->path, [&] { return read_makers(*state_->database); });
}

bool ResultsStore::has_group(std::size_t first_cell) const {
  if (state_->complete) return true;
  return guarded(state_->path, [&] {
    if (!state_->find) state_->find.emplace(*state_->database, "SELECT 1 FROM groups WHERE first_cell = ?");
    SQLite::Statement& find = *state_->find;
    find.bind(1, static_cast<std::int64_t>(first_cell));
    const bool found = find.executeStep();
    find.reset();
    return found;
  });
}

void ResultsStore::append(std::size_t first_cell, const std::function<void(const CellSink&)>& fill) {
  guarded(state_->path, [&] {
    SQLite::Database& database = *state_->database;
    if (!state_->insert) state_->insert.emplace(make_insert(database, state_->description));
    SQLite::Transaction transaction(database);
    GroupChecksum checksum(state_->description.columns, first_cell);
    StoredGroup group{static_cast<std::int64_t>(first_cell)};
    fill([&](std::size_t cell, std::span<const Value> values) {
      if (values.size() != state_->description.columns.size()) throw std::logic_error("a row of another length");
      insert_row(database, *state_->insert, cell, values);
      checksum.add(cell, values);
      if (group.cells++ == 0) group.first_row = database.getLastInsertRowid();
    });
    group.checksum = checksum.text();
    insert_group(database, group);
    transaction.commit();
  });
}

void ResultsStore::finish() {
  if (state_->complete) return;
  const State& state = *state_;
  const fs::path folder = state.folder;
  const fs::path partial = state.path;
  std::vector<ValueKind> kinds = {ValueKind::integer};
  for (const StoredColumn& stored : state.description.columns) kinds.push_back(stored.kind);
  write_finished(folder, state.description, makers(), [&](const CellSink& add) {
    SQLite::Statement rows(*state.database, "SELECT * FROM cells ORDER BY cell");
    while (rows.executeStep()) {
      const std::vector<Value> row = row_of(rows, kinds);
      add(static_cast<std::size_t>(std::get<std::int64_t>(row.front())), std::span(row).subspan(1));
    }
  });
  *this = load(folder);  // until then the growing store counts
  remove_store(partial);
}

ResultsStore ResultsStore::write(const fs::path& folder, const StoreDescription& description,
                                 const std::vector<std::string>& makers, const RowsOfCells& rows) {
  write_finished(folder, description, makers, rows);
  const fs::path path = folder / finished_name;
  // What was written a moment ago is not read back.
  return guarded(path, [&] {
    return ResultsStore(std::make_unique<State>(State{folder, path, true, open_for_reading(path), description}));
  });
}

void ResultsStore::read(const std::vector<std::string>& columns, const StoredRowSink& sink) const {
  const std::vector<std::string> names = columns.empty() ? state_->names() : columns;
  const std::vector<ValueKind> kinds = state_->kinds(names);
  guarded(state_->path, [&] {
    SQLite::Statement rows(*state_->database, "SELECT " + list_of(names) + " FROM cells ORDER BY cell");
    while (rows.executeStep()) sink(row_of(rows, kinds));
  });
}

Table ResultsStore::rows(std::span<const std::size_t> cells, const std::vector<std::string>& columns) const {
  Table table = state_->table(columns);
  const std::vector<ValueKind> kinds = state_->kinds(columns);
  guarded(state_->path, [&] {
    SQLite::Statement row(*state_->database, "SELECT " + list_of(columns) + " FROM cells WHERE cell = ?");
    for (const std::size_t cell : cells) {
      row.bind(1, static_cast<std::int64_t>(cell));
      if (row.executeStep()) table.rows.push_back(row_of(row, kinds));
      row.reset();
    }
  });
  return table;
}

Table ResultsStore::least(const std::string& column, const std::vector<std::string>& per, std::size_t limit) const {
  const std::vector<std::string> names = state_->names();
  const std::vector<ValueKind> kinds = state_->kinds(names);
  state_->kinds(per);
  Table table = state_->table(names);
  const std::string order = identifier(state_->column(column).column.name) + " NULLS LAST, cell";
  const std::string groups = list_of(per);
  std::string query = "SELECT " + list_of(names) + " FROM cells ORDER BY " + order + " LIMIT 1";
  if (!per.empty()) {
    query = "SELECT " + list_of(names) + " FROM (SELECT *, ROW_NUMBER() OVER (PARTITION BY " + groups + " ORDER BY " +
            order + ") AS place FROM cells) WHERE place = 1 ORDER BY " + groups + " LIMIT " + std::to_string(limit);
  }
  guarded(state_->path, [&] {
    SQLite::Statement rows(*state_->database, query);
    while (rows.executeStep()) table.rows.push_back(row_of(rows, kinds));
  });
  return table;
}

}  // namespace umbrameter
