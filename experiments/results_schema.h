// The tables of a results store and what its database's errors mean. Internal to the store.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "experiments/results_store.h"

namespace umbrameter {

/// What a user can do about a store that cannot be used.
inline constexpr const char* store_remedy = "choose another folder with -o, or replace it with --force";

[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& why);
[[noreturn]] void throw_store_error(const std::filesystem::path& path, const SQLite::Exception& problem);

/// Turns what the database throws into Error, and what only we can cause into std::logic_error.
template <class Action>
auto guarded(const std::filesystem::path& path, const Action& action) {
  try {
    return action();
  } catch (const SQLite::Exception& problem) {
    throw_store_error(path, problem);
  }
}

/// A name for SQL.
std::string identifier(std::string_view name);

Value value_of(const SQLite::Column& column, ValueKind kind);

/// Whether the database holds nothing yet. Throws Error (usage) when it is another program's or of another format.
bool is_empty_store(SQLite::Database& database, const std::filesystem::path& path);

/// Growing: rows in the order of arrival, which costs no more the further apart their cells are, and the groups that
/// are whole. Finished: rows by their cell.
enum class StoreForm { growing, finished };
/// To be called within a transaction.
void create_tables(SQLite::Database& database, const StoreDescription& description, StoreForm form);
/// All that create_tables() made of a growing store. To be called within a transaction.
void drop_tables(SQLite::Database& database);
/// For all columns of the table of cells.
SQLite::Statement make_insert(SQLite::Database& database, const StoreDescription& description);
void insert_row(SQLite::Database& database, SQLite::Statement& insert, std::size_t cell, std::span<const Value> values);

/// Throws Error (unreadable_input) when the file is damaged.
StoreDescription read_description(SQLite::Database& database, const std::filesystem::path& path);

/// Of two stores that are not the same, in words; else empty.
std::string first_difference(const StoreDescription& there, const StoreDescription& here);

/// Throws Error (usage) with the first difference.
void require_same(const std::filesystem::path& path, const StoreDescription& there, const StoreDescription& here);

}  // namespace umbrameter
