#include "store/results_checksum.h"

#include <cmath>
#include <limits>

#include "store/results_schema.h"

namespace umbrameter {
namespace {

// The database keeps neither the sign of a zero nor the bits of a NaN.
double as_stored(double number) {
  if (std::isnan(number)) return std::numeric_limits<double>::quiet_NaN();
  return number == 0.0 ? 0.0 : number;
}

bool is_whole(SQLite::Statement& rows, const StoreDescription& description, const StoredGroup& group) {
  rows.reset();
  rows.bind(1, group.first_row);
  rows.bind(2, group.cells);
  GroupChecksum checksum(description.columns, static_cast<std::size_t>(group.first_cell));
  std::int64_t count = 0;
  std::vector<Value> values(description.columns.size());
  while (rows.executeStep()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = value_of(rows.getColumn(static_cast<int>(i) + 1), description.columns[i].kind);
    }
    checksum.add(static_cast<std::size_t>(rows.getColumn(0).getInt64()), values);
    ++count;
  }
  return count == group.cells && checksum.text() == group.checksum;
}

}  // namespace

GroupChecksum::GroupChecksum(const std::vector<StoredColumn>& columns, std::size_t first_cell) : columns_(&columns) {
  hash_.add(std::uint64_t{first_cell});
}

void GroupChecksum::add(std::size_t cell, std::span<const Value> values) {
  hash_.add(std::uint64_t{cell});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Value& value = values[i];
    switch ((*columns_)[i].kind) {
      case ValueKind::truth:
      case ValueKind::integer: {
        const auto* truth = std::get_if<bool>(&value);
        hash_.add(truth != nullptr ? std::int64_t{*truth} : std::get<std::int64_t>(value));
        break;
      }
      case ValueKind::real:
        hash_.add(as_stored(to_number(value)));
        break;
      case ValueKind::text:
        hash_.add(std::string_view(std::get<std::string>(value)));
        break;
    }
  }
}

std::string checksum_of(const StoreDescription& description) {
  ContentHash hash;
  hash.add(std::string_view(description.experiment)).add(std::uint64_t{description.cells});
  for (const auto* pairs : {&description.settings, &description.axes}) {
    hash.add(std::uint64_t{pairs->size()});
    for (const auto& [name, value] : *pairs) hash.add(std::string_view(name)).add(std::string_view(value));
  }
  for (const auto& [column, kind] : description.columns) {
    for (const std::string* text : {&column.name, &column.unit, &column.meaning}) hash.add(std::string_view(*text));
    hash.add(kind);
  }
  return hash.hex();
}

void insert_group(SQLite::Database& database, const StoredGroup& group) {
  SQLite::Statement insert(database, "INSERT INTO groups VALUES (?, ?, ?, ?)");
  insert.bind(1, group.first_cell);
  insert.bind(2, group.cells);
  insert.bind(3, group.first_row);
  insert.bind(4, group.checksum);
  insert.exec();
}

std::vector<StoredGroup> damaged_groups(SQLite::Database& database, const StoreDescription& description) {
  std::vector<StoredGroup> damaged;
  // By name, as they are read: for SQLite the quoted name of a column that is not there is a text.
  std::string names = "cell";
  for (const StoredColumn& stored : description.columns) names += ", " + identifier(stored.column.name);
  SQLite::Statement rows(database,
                         "SELECT " + names + " FROM cells WHERE rowid >= ?1 AND rowid < ?1 + ?2 ORDER BY rowid");
  SQLite::Statement groups(database, "SELECT first_cell, cells, first_row, checksum FROM groups ORDER BY first_cell");
  while (groups.executeStep()) {
    const StoredGroup group{groups.getColumn(0).getInt64(), groups.getColumn(1).getInt64(),
                            groups.getColumn(2).getInt64(), groups.getColumn(3).getString()};
    if (!is_whole(rows, description, group)) damaged.push_back(group);
  }
  return damaged;
}

void remove_groups(SQLite::Database& database, const std::vector<StoredGroup>& groups) {
  SQLite::Statement remove(database, "DELETE FROM groups WHERE first_cell = ?");
  for (const StoredGroup& group : groups) {
    remove.bind(1, group.first_cell);
    remove.exec();
    remove.reset();
  }
  SQLite::Statement gap(database, "DELETE FROM cells WHERE rowid >= ? AND rowid < ?");
  const auto remove_rows = [&](std::int64_t begin, std::int64_t end) {
    if (begin >= end) return;
    gap.bind(1, begin);
    gap.bind(2, end);
    gap.exec();
    gap.reset();
  };
  std::int64_t begin = std::numeric_limits<std::int64_t>::min();
  SQLite::Statement kept(database, "SELECT first_row, first_row + cells FROM groups ORDER BY first_row");
  while (kept.executeStep()) {
    remove_rows(begin, kept.getColumn(0).getInt64());
    begin = kept.getColumn(1).getInt64();
  }
  remove_rows(begin, std::numeric_limits<std::int64_t>::max());
}

}  // namespace umbrameter
