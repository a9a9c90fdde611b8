// Checksums of a results store: SQLite checks its own structure, not the values between. Internal to the store.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/content_hash.h"
#include "store/results_store.h"

namespace umbrameter {

/// Of a group's first cell and of its rows in the order in which they are stored, as the database gives them back.
class GroupChecksum {
 public:
  GroupChecksum(const std::vector<StoredColumn>& columns, std::size_t first_cell);
  void add(std::size_t cell, std::span<const Value> values);
  std::string text() const { return hash_.hex(); }

 private:
  const std::vector<StoredColumn>* columns_;
  ContentHash hash_;
};

/// Of all members.
std::string checksum_of(const StoreDescription& description);

/// A group of the store: its rows are consecutive in the table of cells.
struct StoredGroup {
  std::int64_t first_cell = 0;
  std::int64_t cells = 0;
  std::int64_t first_row = 0;  ///< its rowid
  std::string checksum{};
};

/// To be called within a transaction. Throws SQLite::Exception if the group is stored already.
void insert_group(SQLite::Database& database, const StoredGroup& group);

/// The groups whose rows are not those that were stored.
std::vector<StoredGroup> damaged_groups(SQLite::Database& database, const StoreDescription& description);

/// Removes these groups, and the rows that belong to none of the others. To be called within a transaction.
void remove_groups(SQLite::Database& database, const std::vector<StoredGroup>& groups);

}  // namespace umbrameter
