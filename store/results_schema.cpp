#include "store/results_schema.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "core/error.h"
#include "reports/files/text_layout.h"
#include "store/results_checksum.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// "umbr": tells the file from those of other programs.
constexpr int application_id = 0x756d6272;
constexpr int format_version = 3;  // 2: checksums, 3: makers

using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view kind_names[] = {"truth", "integer", "real", "text"};

// Only numbers can be missing: those that are none.
const char* declaration_of(ValueKind kind) {
  if (kind == ValueKind::real) return "REAL";
  return kind == ValueKind::text ? "TEXT NOT NULL" : "INTEGER NOT NULL";
}

void bind(SQLite::Statement& statement, int index, const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return statement.bindNoCopy(index, *text);
  if (const auto* truth = std::get_if<bool>(&value)) return statement.bind(index, *truth ? 1 : 0);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return statement.bind(index, *integer);
  statement.bind(index, std::get<double>(value));
}

Pairs read_pairs(SQLite::Database& database, const char* table) {
  Pairs pairs;
  SQLite::Statement rows(database, fmt::format("SELECT name, value FROM {} ORDER BY position", table));
  while (rows.executeStep()) pairs.emplace_back(rows.getColumn(0).getString(), rows.getColumn(1).getString());
  return pairs;
}

std::string difference(const Pairs& there, const Pairs& here) {
  for (std::size_t i = 0; i < std::max(there.size(), here.size()); ++i) {
    if (i >= here.size()) return there[i].first + " is set only in the folder";
    if (i >= there.size()) return here[i].first + " is set only in this command";
    if (there[i].first != here[i].first)
      return "the folder has " + there[i].first + ", this command has " + here[i].first;
    if (there[i].second == here[i].second) continue;
    constexpr std::size_t characters = 60;
    return fmt::format("{} is '{}' in the folder and '{}' in this command", there[i].first,
                       shortened(there[i].second, characters), shortened(here[i].second, characters));
  }
  return {};
}

Pairs column_pairs(const StoreDescription& description) {
  Pairs pairs;
  for (const auto& [column, kind] : description.columns) {
    pairs.emplace_back("column " + column.name, std::string(kind_names[static_cast<int>(kind)]) + " " + column.unit);
  }
  return pairs;
}

}  // namespace

[[noreturn]] void throw_damaged(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::unreadable_input, path.string(), "it is damaged: " + why,
              "restore the file from a copy, or run the sweep again with --force or in another folder with -o");
}

[[noreturn]] void throw_store_error(const fs::path& path, const SQLite::Exception& problem) {
  switch (problem.getErrorCode() & 0xff) {
    case SQLITE_FULL:
      throw Error(ExitCode::partial, "cannot write " + path.string(), "No space left on device",
                  "the stored results are kept; free some space and rerun the command to resume");
    case SQLITE_IOERR:
      throw Error(ExitCode::partial, "cannot write " + path.string(), problem.what(),
                  "the stored results are kept; check the folder and rerun the command to resume");
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_ERROR:  // a table or column that every store has is missing
      throw_damaged(path, problem.what());
    case SQLITE_BUSY:
      throw Error(ExitCode::usage, path.string(), "another sweep is using it",
                  "wait until it ends or choose another folder with -o");
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      throw Error(ExitCode::usage, "cannot use " + path.string(), problem.what(), store_remedy);
    default:
      throw std::logic_error(path.string() + ": " + problem.what());
  }
}

std::string identifier(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

Value value_of(const SQLite::Column& column, ValueKind kind) {
  switch (kind) {
    case ValueKind::truth:
      return column.getInt() != 0;
    case ValueKind::integer:
      return std::int64_t{column.getInt64()};
    case ValueKind::real:
      return column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
    case ValueKind::text:
      break;
  }
  return column.getString();
}

bool is_empty_store(SQLite::Database& database, const fs::path& path) {
  if (database.execAndGet("SELECT COUNT(*) FROM sqlite_schema").getInt() == 0) return true;
  if (database.execAndGet("PRAGMA application_id").getInt() != application_id) {
    throw Error(ExitCode::usage, path.string(), "it was not written by umbrameter", store_remedy);
  }
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version != format_version) {
    throw Error(ExitCode::usage, path.string(),
                fmt::format("{} version of umbrameter wrote it: schema version {}, this program's is {}",
                            version > format_version ? "a later" : "an earlier", version, format_version),
                store_remedy);
  }
  return false;
}

void drop_tables(SQLite::Database& database) {
  for (const char* table : {"experiment", "settings", "axes", "makers", "columns", "groups", "cells"}) {
    database.exec(fmt::format("DROP TABLE {}", table));
  }
}

void create_tables(SQLite::Database& database, const StoreDescription& description, StoreForm form) {
  database.exec(fmt::format("PRAGMA application_id = {}", application_id));
  database.exec(fmt::format("PRAGMA user_version = {}", format_version));
  database.exec(
      "CREATE TABLE experiment (toml TEXT NOT NULL, cells INTEGER NOT NULL, checksum TEXT NOT NULL) STRICT;"
      "CREATE TABLE settings (position INTEGER PRIMARY KEY, name TEXT NOT NULL, value TEXT NOT NULL) STRICT;"
      "CREATE TABLE axes (position INTEGER PRIMARY KEY, name TEXT NOT NULL, value TEXT NOT NULL) STRICT;"
      "CREATE TABLE makers (position INTEGER PRIMARY KEY, maker TEXT NOT NULL UNIQUE) STRICT;"
      "CREATE TABLE columns (position INTEGER PRIMARY KEY, name TEXT NOT NULL, kind TEXT NOT NULL, unit TEXT NOT NULL,"
      " meaning TEXT NOT NULL) STRICT;"
      "CREATE TABLE groups (first_cell INTEGER PRIMARY KEY, cells INTEGER NOT NULL, first_row INTEGER NOT NULL,"
      " checksum TEXT NOT NULL) STRICT;");
  SQLite::Statement experiment(database, "INSERT INTO experiment VALUES (?, ?, ?)");
  experiment.bind(1, description.experiment);
  experiment.bind(2, static_cast<std::int64_t>(description.cells));
  experiment.bind(3, checksum_of(description));
  experiment.exec();
  for (const auto& [table, pairs] : {std::pair{"settings", description.settings}, {"axes", description.axes}}) {
    SQLite::Statement insert(database, fmt::format("INSERT INTO {} (name, value) VALUES (?, ?)", table));
    for (const auto& [name, value] : pairs) {
      insert.bind(1, name);
      insert.bind(2, value);
      insert.exec();
      insert.reset();
    }
  }
  const bool growing = form == StoreForm::growing;
  std::string cells =
      growing ? "CREATE TABLE cells (cell INTEGER NOT NULL" : "CREATE TABLE cells (cell INTEGER PRIMARY KEY";
  SQLite::Statement insert(database, "INSERT INTO columns (name, kind, unit, meaning) VALUES (?, ?, ?, ?)");
  for (const auto& [column, kind] : description.columns) {
    insert.bind(1, column.name);
    insert.bind(2, std::string(kind_names[static_cast<int>(kind)]));
    insert.bind(3, column.unit);
    insert.bind(4, column.meaning);
    insert.exec();
    insert.reset();
    cells += fmt::format(", {} {}", identifier(column.name), declaration_of(kind));
  }
  database.exec(cells + ") STRICT");
}

void add_maker(SQLite::Database& database, const std::string& maker) {
  if (maker.empty()) return;
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO makers (maker) VALUES (?)");
  insert.bind(1, maker);
  insert.exec();
}

std::vector<std::string> read_makers(SQLite::Database& database) {
  std::vector<std::string> makers;
  SQLite::Statement rows(database, "SELECT maker FROM makers ORDER BY position");
  while (rows.executeStep()) makers.push_back(rows.getColumn(0).getString());
  return makers;
}

SQLite::Statement make_insert(SQLite::Database& database, const StoreDescription& description) {
  std::string places = "?";
  for (std::size_t i = 0; i < description.columns.size(); ++i) places += ", ?";
  return {database, "INSERT INTO cells VALUES (" + places + ")"};
}

void insert_row(SQLite::Database& database, SQLite::Statement& insert, std::size_t cell,
                std::span<const Value> values) {
  insert.bind(1, static_cast<std::int64_t>(cell));
  for (std::size_t i = 0; i < values.size(); ++i) bind(insert, static_cast<int>(i) + 2, values[i]);
  // Not exec(): the statement must be free again also after a row that is refused.
  const int result = insert.tryExecuteStep();
  if (result == SQLITE_DONE) return insert.reset();
  const std::string problem = database.getErrorMsg();  // before the reset, which clears it
  insert.tryReset();
  throw SQLite::Exception(problem, result);
}

StoreDescription read_description(SQLite::Database& database, const fs::path& path) {
  if (is_empty_store(database, path)) throw_damaged(path, "it is empty");
  const std::string state = database.execAndGet("PRAGMA integrity_check(1)").getString();
  if (state != "ok") throw_damaged(path, state);
  StoreDescription description;
  SQLite::Statement experiment(database, "SELECT toml, cells, checksum FROM experiment");
  if (!experiment.executeStep()) throw_damaged(path, "it contains no experiment");
  description.experiment = experiment.getColumn(0).getString();
  description.cells = static_cast<std::size_t>(experiment.getColumn(1).getInt64());
  const std::string checksum = experiment.getColumn(2).getString();
  description.settings = read_pairs(database, "settings");
  description.axes = read_pairs(database, "axes");
  SQLite::Statement columns(database, "SELECT name, kind, unit, meaning FROM columns ORDER BY position");
  while (columns.executeStep()) {
    const std::string kind = columns.getColumn(1).getString();
    const auto* found = std::ranges::find(kind_names, kind);
    if (found == std::end(kind_names)) throw_damaged(path, "a column's kind is '" + kind + "'");
    description.columns.push_back(
        {{columns.getColumn(0).getString(), columns.getColumn(2).getString(), columns.getColumn(3).getString()},
         static_cast<ValueKind>(found - std::begin(kind_names))});
  }
  if (checksum_of(description) != checksum) throw_damaged(path, "its settings do not match their checksum");
  return description;
}

std::string first_difference(const StoreDescription& there, const StoreDescription& here) {
  std::string first = difference(there.axes, here.axes);
  if (first.empty()) first = difference(there.settings, here.settings);
  if (first.empty()) first = difference(column_pairs(there), column_pairs(here));
  if (first.empty() && there.cells != here.cells) {
    first = fmt::format("it has {} cells in the folder and {} in this command", there.cells, here.cells);
  }
  return first;
}

void require_same(const fs::path& path, const StoreDescription& there, const StoreDescription& here) {
  const std::string first = first_difference(there, here);
  if (!first.empty()) throw Error(ExitCode::usage, path.string(), "it contains another sweep: " + first, store_remedy);
}

}  // namespace umbrameter
