// The SQL tables of a results store, and the conversion of database errors to Error. Internal to the store.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/results_store.h"

namespace umbrameter {

/// The remedy in error messages about a store that cannot be used.
inline constexpr const char* store_remedy = "choose another folder with -o, or replace it with --force";

[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& why);
[[noreturn]] void throw_store_error(const std::filesystem::path& path, const SQLite::Exception& problem);

/// Runs `action` and converts exceptions of the database to Error, or to std::logic_error for a bug in the program.
template <class Action>
auto guarded(const std::filesystem::path& path, const Action& action) {
  try {
    return action();
  } catch (const SQLite::Exception& problem) {
    throw_store_error(path, problem);
  }
}

/// A name quoted as an SQL identifier.
std::string identifier(std::string_view name);

Value value_of(const SQLite::Column& column, ValueKind kind);

/// Whether the database is empty. Throws Error (usage) if it belongs to another program or has another format.
bool is_empty_store(SQLite::Database& database, const std::filesystem::path& path);

/// Growing: rows in the order of insertion, so that the cost does not depend on the order of cells. Finished: rows in
/// the order of cells.
enum class StoreForm { growing, finished };
/// To be called within a transaction.
void create_tables(SQLite::Database& database, const StoreDescription& description, StoreForm form);
/// Adds who measures, unless that is known; nothing if the text is empty.
void add_maker(SQLite::Database& database, const std::string& maker);
std::vector<std::string> read_makers(SQLite::Database& database);
/// Drops the tables that create_tables() made for a growing store. To be called within a transaction.
void drop_tables(SQLite::Database& database);
/// A statement that inserts a row with all columns into the table of cells.
SQLite::Statement make_insert(SQLite::Database& database, const StoreDescription& description);
void insert_row(SQLite::Database& database, SQLite::Statement& insert, std::size_t cell, std::span<const Value> values);

/// Throws Error (unreadable_input) when the file is damaged.
StoreDescription read_description(SQLite::Database& database, const std::filesystem::path& path);

/// The first difference of two stores, for an error message; empty if they are the same.
std::string first_difference(const StoreDescription& there, const StoreDescription& here);

/// Throws Error (usage) with the first difference.
void require_same(const std::filesystem::path& path, const StoreDescription& there, const StoreDescription& here);

}  // namespace umbrameter
